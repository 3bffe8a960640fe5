// The first time: from nothing to coordinates by the one primary button of each page.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, downloads, idle, photos, sample, save, scratch, unzipped } from './desk.mjs';

let made;
/** The sample's photos as files. */
async function coded() {
  if (made) return made;
  const { page, close } = await open();
  try {
    await sample(page);
    const saved = await downloads(page, 1, () => save(page));
    const entries = unzipped(Object.values(saved)[0]);
    const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
    made = names.map((name) => scratch(name.slice(7), entries[name]));
    return made;
  } finally {
    await close();
  }
}

const DEVICES = [
  ['a laptop', { width: 1366, height: 768 }, (page, what) => page.click(what)],
  ['a phone, by touch', { width: 390, height: 844, hasTouch: true, isMobile: true }, (page, what) => page.tap(what)],
];

for (const [device, options, press] of DEVICES) test(`on ${device} the sample opens at once, and dropped coded photos become a report in at most eight steps`, { timeout: 900_000 }, async () => {
  const { page, errors, close } = await open(options);
  try {
    const all = await coded();
    await press(page, '.sample');
    await page.waitForFunction(() => location.hash === '#results', undefined, { timeout: 300_000 });
    await page.waitForSelector('[data-result=sigma0]');
    await afresh(page);
    await photos(page, all);
    const way = [];
    while (!(await page.locator('[data-result=sigma0]').count())) {
      assert.ok(way.length < 8, `${way}`);
      await press(page, '.bar .primary:visible');
      await idle(page);
      way.push(await page.evaluate(() => location.hash));
    }
    assert.equal(way.at(-1), '#results');
    assert.match(await page.textContent('.hero'), /Global test passed/);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, 'the results are wider than the screen');
    await press(page, '.hero-action .primary');
    await page.waitForSelector('.paper[data-ready=true]', { timeout: 60_000 });
    console.log(`${device}: ${way.length} steps: ${way.join(' ')}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
