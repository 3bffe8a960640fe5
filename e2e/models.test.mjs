// Camera models on the page: another one chosen with its conversion stated, undone; all compared, the best taken with one click.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { figure, go, idle, number, sample } from './desk.mjs';

const models = (page) => page.$$eval('[data-result=models] tr[data-model]', (rows) => rows.map((row) => ({ model: row.dataset.model, verdict: row.dataset.verdict, cells: [...row.cells].map((cell) => cell.textContent) })));
const chosen = (page) => page.inputValue('select[name=camera-model]');
const shot = async (page, name) => {
  if (!process.env.SIGHTLINE_SHOTS) return;
  mkdirSync(process.env.SIGHTLINE_SHOTS, { recursive: true });
  await page.screenshot({ path: `${process.env.SIGHTLINE_SHOTS}/${name}.png` });
};

/** Opens the camera on the step of the adjustment. */
async function camera(page) {
  await go(page, 'adjust');
  await page.$eval('.adjust details', (details) => (details.open = true));
}

test('the model of a camera is chosen, its conversion is stated, and it is undone', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const sigma0 = await figure(page, 'sigma0');
    await camera(page);
    const before = await chosen(page);
    assert.equal(before, 'brown');
    await page.selectOption('select[name=camera-model]', 'opencv_rational');
    await page.waitForSelector('[data-result=conversion]');
    assert.equal(await chosen(page), 'opencv_rational');
    assert.match(await page.textContent('[data-result=conversion]'), /^Converted from Brown: image points differ by at most 0\.\d+ px \(rms 0\.\d+ px\)\.$/);
    await shot(page, 'converted-1366');
    // The table lists the parameters of the other model; those that correspond to estimated ones are estimated.
    assert.ok(await page.isChecked('.adjust input[data-parameter=k4]'));
    await page.click('.action .button.primary');
    await idle(page);
    await go(page, 'results');
    assert.ok(Math.abs((await figure(page, 'sigma0')) - sigma0) < 0.1);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    await camera(page);
    assert.equal(await chosen(page), 'brown');
    assert.equal(await page.locator('[data-result=conversion]').count(), 0);
    await go(page, 'results');
    assert.equal(await figure(page, 'sigma0'), sigma0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('all models are compared and the best is taken with one click', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await camera(page);
    await page.click('[data-action=compare-models]');
    await page.waitForSelector('[data-result=models]', { timeout: 120_000 });
    const rows = await models(page);
    assert.deepEqual(rows.map(({ model }) => model), ['brown', 'opencv', 'opencv_rational', 'opencv_rational', 'opencv_fisheye']);
    assert.equal(rows.filter(({ verdict }) => verdict === 'best').length, 1);
    const best = rows.find(({ verdict }) => verdict === 'best');
    assert.equal(number(best.cells[4]), 0, JSON.stringify(rows));
    assert.ok(number(best.cells[1]) < 1.5 && number(best.cells[3]) < 0.5, JSON.stringify(best));
    await page.locator('[data-result=models]').scrollIntoViewIfNeeded();
    await shot(page, 'compared-1366');
    const other = rows.find(({ model, verdict }) => model !== 'brown' && verdict !== 'failed');
    await page.click(`[data-take=${best.model === 'brown' ? other.model : best.model}]`);
    await page.waitForFunction((model) => document.querySelector('select[name=camera-model]')?.value !== model, 'brown');
    // It is of another document now.
    assert.equal(await page.locator('[data-result=models]').count(), 0);
    await page.keyboard.press('Control+z');
    await page.waitForSelector('[data-result=models]');
    assert.equal(await chosen(page), 'brown');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('on a phone, in Korean, the comparison keeps to the page', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844 });
  try {
    await page.evaluate(() => localStorage.setItem('sightline.language', 'ko'));
    await page.reload();
    await sample(page);
    assert.equal(await page.getAttribute('html', 'lang'), 'ko');
    await camera(page);
    await page.click('[data-action=compare-models]');
    await page.waitForSelector('[data-result=models]', { timeout: 120_000 });
    await page.locator('[data-result=models]').scrollIntoViewIfNeeded();
    await shot(page, 'compared-390');
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(wide <= 0, `${wide} px beside the page`);
    const box = await page.locator('[data-result=models]').boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= 390, JSON.stringify(box));
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
