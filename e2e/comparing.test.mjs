// The result beside the one before, and what stays of it when another is cancelled or refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, choosePoint, clickPhoto, figure, go, idle, notice, number, sample, showPhoto } from './desk.mjs';

const longer = { timeout: 600_000 };

/** Rows of the table of points: name, length of the movement, ratio. */
const movements = (page) =>
  page.$$eval('.compared-points tbody tr.data', (rows) => rows.map((row) => [row.dataset.key, row.cells[4].textContent, row.cells[6].textContent]));

test('a point that was moved stands first in the comparison, and nothing else moved as much', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const before = await figure(page, 'sigma0');
    // There is nothing to compare the first result with.
    assert.equal(await page.locator('[data-shown=compared]').count(), 0);
    await go(page, 'adjust');
    const photos = await page.locator('[data-photo-residuals]').count();
    assert.equal(photos, 8);
    const rms = (await page.$$eval('[data-photo-residuals] td:nth-child(3)', (all) => all.map((cell) => cell.textContent))).map(number);
    assert.ok(rms.every((value) => value > 0 && value < 1), `${rms}`);

    await go(page, 'identities');
    const places = await choosePoint(page, '11');
    await showPhoto(page, 'sample-1');
    await clickPhoto(page, [places['sample-1'].u, places['sample-1'].v]);
    // Not so far that the orientation would set the measurement aside.
    for (let k = 0; k < 3; k++) await page.keyboard.press('ArrowRight');
    await adjust(page);
    const after = await figure(page, 'sigma0');
    assert.ok(after > before, `${before} ${after}`);
    await page.click('[data-shown=compared]');
    await page.waitForSelector('.compared-points tbody tr.data');
    const rows = await movements(page);
    const ratios = rows.map(([, , ratio]) => number(ratio));
    assert.equal(rows[0][0], '11');
    assert.ok(ratios[0] > 0 && ratios.slice(1).every((ratio) => ratio <= ratios[0]), `${ratios.slice(0, 5)}`);
    const words = await page.textContent('[data-compared=figures]');
    assert.ok(words.includes(after.toFixed(3)) && words.includes(before.toFixed(3)), words);
    assert.match(await page.textContent('[data-compared=alignment]'), /same control points|was transformed to this one/);
    assert.ok((await page.locator('.compared tr[data-parameter]').count()) > 2);
    // A row chooses its point everywhere.
    await page.locator('.compared-points tr[data-key="11"]').click();
    assert.equal(await page.textContent('.foot .chosen b'), '11');

    // Undone, the first result is the present one again, and has none before it.
    await page.keyboard.press('Control+z');
    assert.ok((await page.locator('[data-step=results] .stale').count()) > 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a cancelled adjustment leaves the last result with its iterations, and says so', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const sigma0 = await figure(page, 'sigma0');
    await go(page, 'adjust');
    const iterations = () => page.$$eval('.iterations tbody tr', (rows) => rows.map((row) => row.textContent));
    const before = await iterations();
    assert.ok(before.length > 0);
    /** Starts the adjustment and cancels it as soon as the page lets anybody. */
    const cancelled = () =>
      page.evaluate(async () => {
        document.querySelector('.action .button').click();
        for (;;) {
          const button = document.querySelector('.slot.busy > .button');
          if (button) return button.click();
          await new Promise((done) => setTimeout(done, 0));
        }
      });
    await cancelled();
    await idle(page);
    assert.match(await notice(page), /Cancelled\. The previous result is unchanged/);
    assert.deepEqual(await iterations(), before);
    assert.equal(await page.locator('[data-step=results] .stale').count(), 0);
    await go(page, 'results');
    assert.equal(await figure(page, 'sigma0'), sigma0);
    // Of a project that has changed since, the last result is kept for undoing, and no number of it is shown.
    await go(page, 'adjust');
    await page.fill('[name=unmodelled]', '0.07');
    await page.press('[name=unmodelled]', 'Tab');
    await cancelled();
    await idle(page);
    assert.match(await notice(page), /belongs to an earlier state of the project/);
    await page.locator('.bar h1').click();
    await page.keyboard.press('Control+z');
    assert.equal(await page.locator('[data-step=results] .stale').count(), 0);
    await go(page, 'results');
    assert.equal(await figure(page, 'sigma0'), sigma0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
