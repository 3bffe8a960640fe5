// The report, printed as a person prints it: every section is on the paper in both languages and sizes, nothing is cut, and its numbers are
// those of the result to the printed digit.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, downloads, go, number, sample, scratch } from './desk.mjs';
import { plain, printed, unreadable } from './printed.mjs';

/** A red square. */
const LOGO = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==', 'base64');

test('the sample prints whole in both languages and sizes', { skip: unreadable, timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const rows = () => page.waitForSelector('.results .c1 tr.data').then(() => page.$$eval('.results .c1 tbody tr.data', (all) => all.map((row) => [...row.cells].slice(0, 8).map((cell) => cell.textContent))));
    // A known length that is not used: .03 beside what was measured.
    const [[from, , ...start], [to, , ...end]] = (await rows()).map((row) => row.slice(0, 5));
    const length = Math.hypot(...start.map((x, k) => number(x) - number(end[k]))) + 0.03;
    await go(page, 'control');
    for (const [name, value] of Object.entries({ from, to, length: length.toFixed(4), sigma: 0.01 })) await page.fill(`[name=${name}]`, String(value));
    await page.click('.distance-form button');
    await page.locator('[name=distance-check]').last().check();
    await adjust(page);
    const shown = await page.$$eval('[data-result]', (all) => all.map((element) => element.textContent));
    const points = await rows();
    assert.ok(points.length > 5 && points[0].length === 8, JSON.stringify(points[0]));
    // A plane and a distance measured on it.
    await page.click('[data-action=object]');
    const make = async (kind, names) => {
      await page.fill('[name=chosen-points]', names.join(' '));
      await page.press('[name=chosen-points]', 'Enter');
      await page.click(`[data-make=${kind}]`);
    };
    const names = points.map(([id]) => id);
    await make('plane', names.slice(0, 6));
    await page.waitForSelector('[data-feature=A] .value');
    await page.click('[data-feature=A]');
    await make('distance', names.slice(0, 2));
    for (const part of ['[data-feature=B] .value', '[data-feature=B] .sigma']) shown.push((await page.textContent(part)).replace('±', ''));
    await go(page, 'report');
    await page.waitForSelector('.paper[data-ready=true]', { timeout: 60_000 });
    await page.fill('[name=operator]', 'Class 4b');
    await page.press('[name=operator]', 'Tab');
    // The result is still current: words are no input.
    await page.waitForFunction(() => document.querySelector('.paper').shadowRoot?.textContent.includes('Class 4b'));
    const chooser = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: 'Choose logo' }).click();
    await (await chooser).setFiles(scratch('logo.png', LOGO));
    await page.waitForFunction(() => document.querySelector('.paper').shadowRoot?.querySelector('header img.logo')?.naturalWidth === 1);
    for (const [name, value] of [['limit-constant', '0.02'], ['limit-per', '100000']]) {
      await page.fill(`[name=${name}]`, value);
      await page.press(`[name=${name}]`, 'Tab');
    }
    await page.waitForFunction(() => {
      const { shadowRoot } = document.querySelector('.paper');
      return shadowRoot.querySelector('header img.logo')?.naturalWidth === 1 && shadowRoot.querySelector('[data-section=lengths] tr.bad');
    });
    // The first of the two fields has made pages of its own; those that are printed say both.
    await page.waitForSelector('.paper[data-ready=true]');
    const folder = await printed(page, { figures: [...shown, 'Class 4b', '0.02 mm + L / 100 000'], points });
    assert.match(execFileSync('pdfimages', ['-list', join(folder, 'en-a4.pdf')], { encoding: 'utf8' }), /^ +1 +0 image +1 +1 /m);
    // One file, the same words.
    const saved = await downloads(page, 1, () => page.click('.bar .action .button:not(.primary)'));
    const html = Object.values(saved)[0].toString('utf8');
    assert.ok(html.includes('Class 4b') && !html.includes('<script') && !/ (src|href)="http/.test(html));
    for (const figure of shown) assert.ok(plain(html.replaceAll(/<[^>]*>/g, '')).includes(plain(figure)), `${figure} is not in the file`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('plots are drawn in three themes and both languages, and saved', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await page.click('[data-shown=plots]');
    await page.waitForSelector('.drawings[data-ready=true]', { timeout: 60_000 });
    assert.ok((await page.locator('.drawings figure').count()) >= 14);
    const colour = () => page.$eval('.drawing', (host) => getComputedStyle(host.shadowRoot.querySelector('.line-a')).stroke);
    const colours = new Set();
    for (let k = 0; k < 3; k++) {
      colours.add(await colour());
      await page.getByRole('button', { name: /Theme: switch/ }).click();
    }
    assert.equal(colours.size, 3, [...colours].join(' '));
    const saved = await downloads(page, 1, () => page.locator('.drawings figcaption .link').first().click());
    const [[name, bytes]] = Object.entries(saved);
    assert.match(name, /\.svg$/);
    assert.match(bytes.toString('utf8'), /^<svg [^>]*xmlns=/);
    await page.click('[data-shown=meanings]');
    assert.equal(await page.locator('.meanings details').count(), 12);
    await page.locator('.hero .explained').first().click();
    assert.equal(await page.locator('.meanings details[open]').count(), 1);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
