// Epochs of one object: the sample, lists of points, a new epoch from photos, and input that cannot be compared.
import assert from 'node:assert/strict';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads, drop, idle, notice, number, rows, sample, save, scratch, unzipped, written } from './desk.mjs';

const longer = { timeout: 900_000 };
const SIGMA = 0.05;

/** Numbers of a normal distribution from a seed (W. Hörmann's order: two uniform ones, G. Box and M. Muller). */
function normal(seed) {
  let state = seed >>> 0;
  const uniform = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 4294967296;
  return () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
}

const PLACES = [
  ...[[0, 0, 0], [2000, 100, 50], [2100, 1500, 100], [50, 1450, 30], [1000, -200, 600], [900, 1700, 650], [-100, 700, 500], [2200, 800, 550]].map((xyz, k) => [`R${k + 1}`, xyz]),
  ...[[500, 400, 300], [1000, 450, 320], [1500, 420, 280], [520, 900, 310], [1010, 950, 330], [1490, 930, 300]].map((xyz, k) => [`P${k + 1}`, xyz]),
];

/** A list as other programs export it; `change` gives another name or place. */
function list(seed, change = (name, xyz) => [name, xyz], sigmas = true, unit = 1) {
  const noise = normal(seed);
  const line = ([name, xyz]) => {
    const [id, place] = change(name, xyz);
    const seen = place.map((x) => (unit * (x + SIGMA * noise())).toFixed(7));
    return [id, ...seen, ...(sigmas ? [0, 0, 0].map(() => unit * SIGMA) : [])].join(',');
  };
  return `${PLACES.map(line).join('\n')}\n`;
}

/** Moves points by so many millimetres along Z. */
const moved = (by) => (name, [x, y, z]) => [name, [x, y, z + (by[name] ?? 0)]];

const monitoring = (page) => page.click('[data-open=monitoring]');
const verdict = (page) => page.textContent('[data-found=verdict]');

/** Adds files as epochs and waits until so many are there. */
async function epochs(page, files, count) {
  await drop(page, files);
  await page.waitForFunction((n) => document.querySelectorAll('.epochs-table tr[data-epoch]').length === n, count);
}

async function compare(page) {
  await page.click('[data-action=compare]');
  await page.waitForTimeout(100);
  await idle(page);
}

async function field(page, name, typed) {
  await page.fill(`[data-field=${name}] input`, typed);
  await page.press(`[data-field=${name}] input`, 'Tab');
}

test('the sample with three epochs opens in one click; its verdict, tests, points over time and files agree', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.click('[data-open=sample-epochs]');
    await page.waitForSelector('[data-found=verdict]', { timeout: 120_000 });
    assert.match(await verdict(page), /^\d of 24 object points have moved; reference point R5 is not stable, the other 7 are\.$/);
    const rejected = await page.locator('[data-test=global] .bad').count();
    const accepted = await page.locator('[data-test=step] .pass').count();
    assert.deepEqual([rejected, accepted], [1, 1]);
    const table = () => page.$$eval('.displaced-table:not(.reference) tbody tr.data', (all) => all.map((row) => [row.dataset.key, row.cells[4].textContent, row.cells[9].textContent]));
    const found = await table();
    assert.deepEqual(new Set(found.filter(([, , said]) => said === 'moved').map(([id]) => id).filter((id) => ['D23', 'D24'].includes(id))), new Set(['D23', 'D24']));
    assert.equal(await page.locator('.displacements g[data-point]').count(), 32);
    // The file says the same as the screen.
    const csv = rows(Object.values(await downloads(page, 1, () => page.click('[data-action=csv]')))[0]);
    const last = csv.filter((row) => row.from.includes('03-14') && row.to.includes('09-12'));
    assert.equal(last.length, 32);
    for (const [id, length, said] of found) {
      const row = last.find((one) => one.id === id);
      assert.ok(Math.abs(Number(row['length [mm]']) - number(length)) < 0.006, `${id} ${length} ${row['length [mm]']}`);
      assert.equal(row.judgement, said === 'moved' ? 'moved' : 'not_significant');
    }
    const [[name, drawing]] = Object.entries(await downloads(page, 1, () => page.click('[data-action=dxf]')));
    assert.match(name, /\.dxf$/);
    assert.equal(String(drawing).split('\nLINE\n').length - 1, 32);
    // The exaggeration is stated, and is that of the drawing.
    const factor = number((await page.textContent('[data-found=factor]')).replace('×', ''));
    assert.ok(String(drawing).includes(`displacements x ${factor}`));
    // Another epoch, and a point over time.
    await page.click('.epoch-rows tr[data-epoch="1"] .link');
    assert.match(await page.textContent('.moved-verdict .words p:last-child'), /2026-06-13 against/);
    await page.click('.displacements g[data-point=D23]');
    await page.click('[data-shown=time]');
    assert.match(await page.textContent('[data-found=velocity]'), /^D23 moves with/);
    assert.equal(await page.locator('[data-found=since-first] tbody tr').count(), 3);
    assert.equal(await page.locator('.time-chart:not(.small) .bar').count(), 6);
    await page.click('.tools .text-button[aria-label*="Language"]');
    assert.match(await page.textContent('[data-found=velocity]'), /점 D23의 속도/);
    await page.click('[data-shown=displacements]');
    assert.match(await verdict(page), /^대상점 24점 중 \d점이 움직였고, 참조점 1점\(R5\)이 불안정/);
    // The report, in the language of the page.
    const report = async (wanted) => {
      await page.waitForFunction((text) => document.querySelector('.paper')?.shadowRoot?.textContent.includes(text), wanted, { timeout: 30_000 });
      return page.$eval('.paper', (paper) => [...paper.shadowRoot.querySelectorAll('section')].map((section) => section.dataset.section));
    };
    await page.click('[data-shown=report]');
    const sections = await report('변위 보고서');
    assert.deepEqual(sections, ['epochs-verdict', 'epochs', 'epochs-tests', 'epochs-stable', 'epochs-displacements', 'epochs-series', 'epochs-settings']);
    await page.click('.tools .text-button[aria-label*="언어"]');
    assert.deepEqual(await report('Deformation report'), sections);
    // With the camera shared by all epochs: one adjustment of all, which the report names with its test.
    await page.click('[data-shown=setup]');
    await page.selectOption('select[name=method]', { label: 'joint, stable points in common' });
    const cameras = page.locator('[data-field=shared-cameras] button');
    const camera = await cameras.first().textContent();
    await cameras.first().click();
    assert.equal(await cameras.first().getAttribute('aria-pressed'), 'true');
    await compare(page);
    assert.match(await verdict(page), /moved/);
    await page.click('[data-shown=report]');
    await report(camera);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('lists of three epochs: displacements, thresholds and velocities; what is changed makes it out of date', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await monitoring(page);
    const files = [0, 0.4, 0.8].map((by, k) => scratch(`wall 2026-0${k + 3}-15.csv`, list(31 + k, moved({ P2: by, P5: by / 8 }))));
    await epochs(page, files.slice(0, 1), 1);
    assert.match(await page.textContent('.epochs-setup'), /at least two epochs/);
    await epochs(page, files.slice(1), 3);
    await field(page, 'reference', 'R1, R2, R3, R4, R5, R6, R7, R8');
    assert.equal(await page.locator('[data-common][aria-pressed=true]').count(), 8);
    await field(page, 'warning', '0.3');
    await field(page, 'alarm', '0.6');
    await compare(page);
    assert.match(await verdict(page), /^1 of 6 object points has moved; the reference group of 8 points is stable\.$/);
    // Lists have neither correlations nor a redundancy: it is said.
    assert.match(await page.textContent('[data-found=notes]'), /without covariance matrix.*no redundancy/s);
    await page.click('[data-shown=time]');
    assert.match(await page.textContent('[data-found=velocity]'), /^P2 moves with 0\.\d+ ± 0\.\d+ {1,2}a month/);
    assert.match(await page.textContent('[data-found=state]'), /alarm/);
    const states = await page.$$eval('[data-found=since-first] tbody tr', (all) => all.map((row) => row.cells[row.cells.length - 1].textContent.trim()));
    assert.deepEqual(states, ['', 'warning', 'alarm']);
    // A group that moves as one.
    await page.click('[data-shown=setup]');
    await page.click('[data-action=add-group]');
    await field(page, 'group-points', 'P1, P4, P6');
    await page.click('[data-shown=displacements]');
    assert.match(await page.textContent('.out-of-date'), /Epochs or options have changed/);
    assert.equal(await page.locator('.displaced-table').count(), 0);
    await compare(page);
    assert.match(await page.textContent('[data-group="Group 1"]'), /Translation.*Rotation/s);
    // A removed epoch leaves two: no point over time.
    await page.click('[data-shown=setup]');
    await page.click('.epochs-table tr[data-epoch="2"] [aria-label^="Remove"]');
    await compare(page);
    await page.click('[data-shown=time]');
    assert.match(await page.textContent('.out-of-date'), /three epochs/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a covariance matrix goes to its list', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await monitoring(page);
    const n = 3 * PLACES.length;
    const matrix = Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, j) => (i === j ? SIGMA ** 2 : 0)).join(' ')).join('\n');
    await epochs(page, [scratch('first.csv', list(1)), scratch('second.csv', list(2))], 2);
    await drop(page, [scratch('second covariance.txt', matrix)]);
    await page.waitForSelector('.epochs-table tr[data-epoch="1"]:has-text("second covariance.txt")');
    await compare(page);
    const notes = await page.textContent('[data-found=notes]');
    assert.match(notes, /first: a list without covariance matrix/);
    assert.doesNotMatch(notes, /second: a list without covariance matrix/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('what cannot be compared is a sentence that says what to do, in both languages', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  const failed = async (wanted) => {
    await compare(page);
    const said = await page.textContent('[data-found=failure]');
    assert.match(said, wanted);
    await page.click('.tools .text-button[aria-label*="Language"]');
    assert.match(await page.textContent('[data-found=failure]'), /비교하지 못했습니다.*[가-힣]{2}/s);
    await page.click('.tools .text-button[aria-label*="언어"]');
  };
  try {
    await monitoring(page);
    await epochs(page, [scratch('first.csv', list(5))], 1);
    const names = PLACES.map(([name]) => name);
    const cases = [
      [(name, xyz) => [name, xyz], true, /times those of the first epoch: give both in one unit/i, 0.001],
      [(name, [x, y, z]) => [name, [-x, y, z]], true, /mirror image of the first: exchange two of its axes/i],
      [(name, xyz) => [names[(names.indexOf(name) * 5 + 3) % names.length], xyz], true, /check that the same names mean the same points/i],
      [(name, xyz) => [`Q${name}`, xyz], true, /no common point.*give at least four points the same names/i],
      [(name, xyz) => [name, xyz], false, /no standard errors.*give sigma for its points/i],
    ];
    for (const [change, sigmas, wanted, unit] of cases) {
      await epochs(page, [scratch('second.csv', list(6, change, sigmas, unit))], 2);
      await failed(wanted);
      await page.click('.epochs-table tr[data-epoch="1"] [aria-label^="Remove"]');
    }
    await epochs(page, [scratch('second.csv', list(6))], 2);
    await field(page, 'reference', 'R1, R2, R3');
    await failed(/reference points.*3, needed: 4; name more reference points/i);
    await field(page, 'reference', 'R1, R2, R3, R4, R99');
    await failed(/R99/);
    // Refused where it is typed; the last value stays.
    await page.fill('[data-field=date] >> nth=1 >> input', 'last spring');
    await page.press('[data-field=date] >> nth=1 >> input', 'Tab');
    assert.match(await notice(page), /is not a date\. Write it as 2026-03-14/);
    // A project that was never adjusted and a file of another kind are refused as epochs.
    await drop(page, [scratch('prose.csv', 'Dear Sir or Madam\n')]);
    await page.waitForSelector('[data-found=problems]');
    assert.match(await page.textContent('[data-found=problems]'), /prose\.csv/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('from a finished epoch 0 to the verdict of epoch 1 in at most eight clicks beside dropping the photos', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    // The same photos once more: nothing has moved between them.
    const saved = await downloads(page, 1, () => save(page));
    const folder = mkdtempSync(join(tmpdir(), 'sightline-epoch-'));
    const photos = Object.entries(unzipped(Object.values(saved)[0])).filter(([name]) => name.endsWith('.png'));
    assert.equal(photos.length, 8);
    const paths = photos.map(([name, bytes]) => {
      const path = join(folder, name.split('/').pop());
      writeFileSync(path, bytes);
      return path;
    });
    await written(page);
    let clicks = 0;
    const click = async (where) => {
      clicks += 1;
      await page.click(where);
    };
    await click('[data-action=new-epoch]');
    await page.waitForFunction(() => location.hash === '#photos');
    assert.match(await page.textContent('.gallery'), /Drop the photos of this epoch/);
    await drop(page, paths);
    await page.waitForFunction(() => document.querySelectorAll('.tiles li').length === 8 && !document.querySelector('.progress'), undefined, { timeout: 120_000 });
    // One camera, with the calibration of epoch 0.
    assert.equal(await page.locator('.gallery h2').count(), 1);
    await click('[data-step=targets]');
    await click('[data-action=detect]');
    await idle(page);
    await click('[data-step=adjust]');
    await click('.action .button');
    await idle(page);
    await click('[data-step=results]');
    await click('[data-action=compare-epochs]');
    await page.waitForSelector('[data-found=verdict]', { timeout: 120_000 });
    assert.ok(clicks <= 8, `${clicks} clicks`);
    assert.match(await verdict(page), /^No displacement of \d+ object points is significant; the reference group of 4 points is stable\.$/);
    assert.ok(number((await page.textContent('[data-found=largest]')).split('±')[0]) < 0.02);
    // The first epoch is the kept project, the other the one on the desk.
    await page.click('[data-shown=setup]');
    assert.equal(await page.locator('.epochs-table tr[data-epoch]').count(), 2);
    // Once more from the results: nothing is there twice.
    await page.click('[data-action=to-results]');
    await page.click('[data-action=compare-epochs]');
    await page.waitForSelector('[data-found=verdict]', { timeout: 120_000 });
    await page.click('[data-shown=setup]');
    assert.equal(await page.locator('.epochs-table tr[data-epoch]').count(), 2);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
