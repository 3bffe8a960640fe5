// The adjustment laid open: matrices, steps, datums, a planted error, weights; every number is the engine's.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads, unzipped } from './desk.mjs';

const inside = async (page) => {
  await page.evaluate(() => (location.hash = '#inside'));
  await page.waitForSelector('.steps-taken [data-step-number]', { timeout: 60_000 });
};
const number = (text) => {
  const [, mantissa, exponent] = /(-?[\d.]+)(?:×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?/.exec(text.replaceAll('−', '-').replaceAll(/\s/g, ''));
  const digits = [...(exponent ?? '⁰')].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('');
  return Number(mantissa) * 10 ** Number(digits);
};

test('the lab net is stepped to its end, an observation is explained, and the matrices are saved', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await inside(page);
    assert.equal(await page.locator('[data-matrix] canvas').count(), 4);
    // What the order of elimination does to the Cholesky factor.
    const filled = async () => number((await page.textContent('[data-matrix=L] .aside')).split(',')[1]);
    await page.waitForFunction(() => document.querySelector('[data-matrix=L] .aside').textContent !== '');
    const [pointsFirst, said] = [await filled(), await page.textContent('[data-matrix=L] .aside')];
    await page.click('[data-elimination=photos]');
    await page.waitForFunction((before) => ![before, ''].includes(document.querySelector('[data-matrix=L] .aside').textContent), said);
    assert.ok((await filled()) > pointsFirst, `${await filled()} ${pointsFirst}`);
    await page.click('[data-elimination=points]');
    const sigma0 = async () => number(await page.textContent('.steps-taken li.now b'));
    const first = await sigma0();
    await page.click('[data-action=step]');
    await page.waitForSelector('li.now[data-step-number="1"]');
    assert.ok((await sigma0()) < first);
    // Points and residuals move with the step: before the first one there is nothing to draw.
    await page.click('[data-pane=movement]');
    await page.waitForSelector('.plan[data-factor]');
    const vectors = () => page.$eval('.plan .vectors', (path) => path.getAttribute('d'));
    const residuals = () => page.$eval('[data-residuals="2"] .vectors', (path) => path.getAttribute('d'));
    assert.equal(await page.locator('.plan [data-place]').count(), 19);
    assert.equal(await page.locator('[data-residuals]').count(), 5);
    const [moved, off] = [await vectors(), await residuals()];
    assert.ok(moved.split('M').length > 19 && off.length > 0);
    await page.click('[data-action=step-back]');
    await page.waitForSelector('li.now[data-step-number="0"]');
    assert.equal(await vectors(), '');
    assert.notEqual(await residuals(), off);
    await page.click('[data-step-number="1"] button');
    assert.equal(await vectors(), moved);
    await page.click('[data-pane=matrices]');
    await page.click('[data-action=run]');
    await page.waitForSelector('[data-ended]', { timeout: 60_000 });
    const last = await sigma0();
    assert.ok(last > 0.5 && last < 1.6, `sigma0 ${last}`);
    await page.click('[data-action=step-back]');
    assert.ok((await sigma0()) >= last * 0.999);

    // Standard errors of the unknowns follow the step.
    await page.waitForFunction(() => [...document.querySelectorAll('.unknowns [data-sigma]')].every((cell) => cell.textContent !== ''));
    // Only the rows in sight are drawn: the last of 76 after scrolling.
    assert.ok((await page.locator('.unknowns [data-sigma]').count()) < 76);
    await page.$eval('.unknowns-frame', (frame) => (frame.scrollTop = frame.scrollHeight));
    await page.waitForSelector('.unknowns [data-unknown="75"]');
    assert.notEqual(await page.textContent('.unknowns [data-unknown="75"] [data-sigma]'), '');

    await page.fill('[name=observation]', '2 7 x');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.formula');
    await page.waitForFunction(() => [...document.querySelectorAll('.derivatives tbody tr')].every((row) => row.cells[2].textContent !== ''));
    const rows = await page.$$eval('.derivatives tbody tr', (all) => all.map((row) => [row.cells[1].textContent, row.cells[2].textContent]));
    assert.ok(rows.length >= 9);
    for (const [analytic, numerical] of rows) assert.ok(Math.abs(number(analytic) - number(numerical)) <= 2e-3 * Math.abs(number(analytic)) + 1e-6, `${analytic} ${numerical}`);

    const heights = await page.$$eval('.observed tr', (all) => all.map((row) => row.offsetHeight));
    assert.ok(Math.max(...heights) < 50, `figures are broken into letters: ${heights}`);

    const given = await downloads(page, 1, () => page.click('[data-action=export-inside]'));
    const files = unzipped(given['equations.zip']);
    assert.ok(['A.mtx', 'N.mtx', 'S.mtx', 'Qxx.npy', 'rows.csv', 'columns.csv'].every((name) => name in files), Object.keys(files).join());
    assert.doesNotMatch(await page.textContent('main'), /NaN|Infinity|undefined/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('three datums, a planted error and weights stand beside each other', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await inside(page);
    await page.click('[data-inside=datum]');
    await page.waitForSelector('[data-trace]', { timeout: 60_000 });
    assert.equal(await page.locator('.datums svg').count(), 3);
    assert.deepEqual(await page.$$eval('[data-equal]', (all) => all.map((one) => one.dataset.equal)), ['false', 'true']);
    const traces = await page.$$eval('[data-trace]', (all) => all.map((one) => one.textContent));
    assert.ok(number(traces[2]) < number(traces[1]) && number(traces[2]) < number(traces[0]), traces.join());
    assert.equal(await page.locator('[data-motion]').count(), 7);
    await page.click('[data-motion=rotation_z]');
    await page.waitForSelector('line.arrow');

    // The S-transformation gives what the adjustment under the other datum gives; control adds observations.
    for (const [pair, same] of [['minimal-free', 'true'], ['free-minimal', 'true'], ['control-free', 'false']]) {
      await page.click(`[data-transform=${pair}]`);
      await page.waitForSelector(`[data-transform=${pair}][aria-pressed=true]`);
      await page.waitForSelector(`[data-same=${same}]`, { timeout: 60_000 });
    }
    assert.equal(await page.locator('[data-transformed]').count(), 14);

    await page.click('[data-inside=errors]');
    await page.waitForSelector('[data-said=planted]', { timeout: 60_000 });
    const share = async (name) => number(await page.textContent(`[data-${name}]`));
    // 2000 draws: four standard errors of a share are at most 4.5 %.
    assert.ok(Math.abs((await share('power')) - (await share('detected'))) < 4.5);
    assert.equal(await page.locator('.estimates thead th').count(), 5);

    await page.click('[data-inside=weights]');
    await page.waitForSelector('[data-weighted=sigma0]', { timeout: 60_000 });
    assert.doesNotMatch(await page.textContent('main'), /NaN|Infinity|undefined/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('it speaks Korean, fits a phone, and opens from an experiment', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844 });
  try {
    await page.evaluate(() => localStorage.setItem('sightline.language', 'ko'));
    await page.reload();
    await page.evaluate(() => (location.hash = '#experiments/kim'));
    await page.waitForSelector('.outcome .keys', { timeout: 120_000 });
    await page.click('.action [data-action=inside]', { timeout: 120_000 });
    await page.waitForSelector('.steps-taken [data-step-number]', { timeout: 120_000 });
    for (const tab of ['matrices', 'datum', 'errors', 'weights']) {
      await page.click(`[data-inside=${tab}]`);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= 390, `${tab} is ${wide} px wide`);
    }
    assert.match(await page.textContent('h1'), /조정/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
