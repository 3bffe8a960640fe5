// The first time: from nothing to coordinates by the one primary button of each page.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads, idle, photos, sample, scratch, unzipped } from './desk.mjs';

test('the sample opens in one click, and dropped coded photos become results in at most eight', { timeout: 900_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await page.waitForSelector('[data-result=sigma0]');
    const saved = await downloads(page, 1, () => page.getByRole('button', { name: 'Save with photos', exact: true }).click());
    await idle(page);
    const entries = unzipped(Object.values(saved)[0]);
    const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
    await page.waitForTimeout(300);
    await page.reload();
    await photos(page, names.map((name) => scratch(name.slice(7), entries[name])));
    const way = [];
    while (!(await page.locator('[data-result=sigma0]').count())) {
      assert.ok(way.length < 8, `${way}`);
      await page.click('.bar .primary:visible');
      await idle(page);
      way.push(await page.evaluate(() => location.hash));
    }
    assert.equal(way.at(-1), '#results');
    assert.match(await page.textContent('.hero'), /Global test passed/);
    console.log(`${way.length} clicks: ${way.join(' ')}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
