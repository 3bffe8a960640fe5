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
    assert.equal(await page.locator('[data-matrix] canvas').count(), 3);
    const sigma0 = async () => number(await page.textContent('.steps-taken li.now b'));
    const first = await sigma0();
    await page.click('[data-action=step]');
    await page.waitForSelector('li.now[data-step-number="1"]');
    assert.ok((await sigma0()) < first);
    await page.click('[data-action=run]');
    await page.waitForSelector('[data-ended]', { timeout: 60_000 });
    const last = await sigma0();
    assert.ok(last > 0.5 && last < 1.6, `sigma0 ${last}`);
    await page.click('[data-action=step-back]');
    assert.ok((await sigma0()) >= last * 0.999);

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
