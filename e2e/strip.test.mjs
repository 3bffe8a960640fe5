// The photos at the side: made once, and not with every change of the document.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { go, idle, sample } from './desk.mjs';

test('thumbnails of the strip stay what they are while targets are found, so that detection grows with the photos and no faster', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await idle(page);
    await go(page, 'targets');
    await page.waitForSelector('.strip canvas.thumbnail');
    // Each would be measured and drawn again if it was made anew: with every photo that is done, all of them.
    const marked = await page.$$eval('.strip canvas.thumbnail', (all) => all.map((one, i) => (one.sign = i)).length);
    assert.equal(marked, 8);
    await page.evaluate(() => {
      self.measured = 0;
      const { get } = Object.getOwnPropertyDescriptor(Element.prototype, 'clientWidth');
      Object.defineProperty(Element.prototype, 'clientWidth', { get() { self.measured += Number(this.matches('.thumbnail')); return get.call(this); } });
    });
    await page.click('[data-action=detect]');
    await idle(page);
    assert.deepEqual(await page.$$eval('.strip canvas.thumbnail', (all) => all.map((one) => one.sign)), [...Array(8).keys()]);
    assert.equal(await page.evaluate(() => self.measured), 0);
    // A count that changes is shown, another photo is chosen, and undoing shows what was.
    const counts = await page.$$eval('.strip u', (all) => all.map((one) => one.textContent));
    assert.ok(counts.every((count) => Number(count) > 0), counts.join());
    await page.locator('.strip [data-photo]').nth(3).click();
    assert.equal(await page.locator('.strip li.chosen').count(), 1);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
