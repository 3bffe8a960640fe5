// What the lens does otherwise to red and blue: measured in a RAW, held by its camera, taken back.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { detect, go, number, photos } from './desk.mjs';

test('a camera holds what its photos tell of red and blue, and gives it back', { timeout: 180_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-written-'));
  execFileSync(join(process.env.SIGHTLINE_EXAMPLES, 'written'), [folder]);
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, [join(folder, 'photo.dng')]);
    for (const [field, value] of [['pitch', 4.5], ['c', 8]]) {
      await page.fill(`[data-field=${field}]`, String(value));
      await page.press(`[data-field=${field}]`, 'Tab');
    }
    await detect(page, {});
    await page.locator('.strip [data-photo]').first().click();
    await page.click('[data-action=colours-apart]');
    await page.waitForSelector('.apart-words li');
    // All three colours of this photo are of one picture: what is told of them is no more than its noise.
    for (const words of await page.locator('.apart-words li').allTextContents()) {
      const [, pixels, sigma] = /: (\S+) px .*\(standard error (\S+) px\)/.exec(words);
      assert.ok(Math.abs(number(pixels)) < 4 * number(sigma) + 0.0005, words);
    }
    await page.click('[data-action=hold-colours]');
    const holds = () => page.waitForFunction(() => /uses differences/.test(document.querySelector('.apart')?.textContent));
    await holds();
    await go(page, 'adjust');
    await page.$$eval('details', (all) => all.forEach((one) => (one.open = true)));
    const rows = page.locator('[data-held-colours] tbody tr');
    assert.ok((await rows.count()) >= 2, 'red and blue');
    const held = await rows.allTextContents();
    await page.keyboard.press('Control+z');
    await page.waitForSelector('[data-held-colours]', { state: 'detached' });
    await page.keyboard.press('Control+Shift+Z');
    await page.waitForSelector('[data-held-colours]');
    assert.deepEqual(await rows.allTextContents(), held);
    // A reloaded page has them still.
    await page.waitForFunction(() => /^saved \d/.test(document.querySelector('.project span')?.textContent));
    await page.goto(page.url().split('#')[0]);
    await page.click('[data-project] .do .button');
    await page.waitForSelector('.project-name');
    await go(page, 'adjust');
    await page.$$eval('details', (all) => all.forEach((one) => (one.open = true)));
    assert.deepEqual(await rows.allTextContents(), held);
    await page.click('[data-action=forget-colours]');
    await page.waitForSelector('[data-held-colours]', { state: 'detached' });
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
