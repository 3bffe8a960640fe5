// The report, printed as a person prints it: every section is on the paper in both languages and sizes, nothing is cut, and its numbers are
// those of the result to the printed digit.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads, go, sample } from './desk.mjs';

const poppler = spawnSync('pdftotext', ['-v']).status === 0;

const SECTIONS = {
  en: ['Summary', 'Uncertainty of the coordinates', 'Observations and unknowns', 'Cameras', 'Network', 'Photos', 'Points', 'Control, check points and scale', 'Statistics and tests', 'Residuals by photo', 'Left out, and why', 'Features', 'Settings and inputs'],
  ko: ['요약', '좌표의 불확도', '관측값과 미지수', '카메라', '관측망', '사진', '점', '기준점, 검사점, 축척', '통계와 검정', '사진별 잔차', '제외한 것과 그 까닭', '형상', '설정과 입력 자료'],
};
/** Width and height in points. */
const SIZES = { a4: [595, 842], letter: [612, 792] };

/** Text as it can be compared: without what only sets it apart. */
const plain = (text) => text.replaceAll(/\s+/g, '');

/** What lies on the pages: their sizes, and the box of each word. */
function boxes(file) {
  const html = execFileSync('pdftotext', ['-bbox', file, '-'], { encoding: 'utf8', maxBuffer: 1 << 28 });
  return html.split('<page ').slice(1).map((page) => {
    const [, width, height] = page.match(/width="([\d.]+)" height="([\d.]+)"/).map(Number);
    const words = [...page.matchAll(/<word xMin="([\d.-]+)" yMin="([\d.-]+)" xMax="([\d.-]+)" yMax="([\d.-]+)">(.*?)<\/word>/g)];
    return { width, height, words: words.map(([, ...rest]) => ({ box: rest.slice(0, 4).map(Number), text: rest[4] })) };
  });
}

test('the sample prints whole in both languages and sizes', { skip: poppler ? false : 'skipped, no pdftotext', timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  const folder = mkdtempSync(join(tmpdir(), 'sightline-report-'));
  try {
    await sample(page);
    const shown = await page.$$eval('[data-result]', (all) => all.map((element) => element.textContent));
    const points = await page.$$eval('.results .c1 tbody tr.data', (rows) => rows.map((row) => [...row.cells].slice(0, 8).map((cell) => cell.textContent)));
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
    for (const language of ['en', 'ko']) {
      await page.selectOption('[name=report-language]', language);
      await page.waitForFunction((tag) => document.querySelector('.paper').shadowRoot.querySelector('.report').lang === tag, language);
      for (const paper of ['a4', 'letter']) {
        await page.selectOption('[name=paper]', paper);
        const size = paper === 'a4' ? 'A4' : 'letter';
        await page.waitForFunction((name) => [...document.adoptedStyleSheets].some((sheet) => [...sheet.cssRules].some((rule) => rule.cssText.includes(`size: ${name}`) || rule.cssText.includes(`size: ${name.toLowerCase()}`))), size);
        const file = join(folder, `${language}-${paper}.pdf`);
        await page.pdf({ path: file, preferCSSPageSize: true, printBackground: true });
        const pages = boxes(file);
        assert.ok(pages.length >= 4, `${pages.length} pages`);
        for (const [k, { width, height, words }] of pages.entries()) {
          assert.ok(Math.abs(width - SIZES[paper][0]) < 2 && Math.abs(height - SIZES[paper][1]) < 2, `${width} x ${height}`);
          assert.ok(words.length > 10, `page ${k + 1} is empty`);
          const outside = words.filter(({ box: [x0, y0, x1, y1] }) => x0 < 20 || y0 < 15 || x1 > width - 20 || y1 > height - 15);
          assert.deepEqual(outside, [], `cut on page ${k + 1} of ${language} ${paper}`);
          // The number of the page and of all pages runs along.
          assert.ok(plain(words.map(({ text }) => text).join('')).includes(`${k + 1}/${pages.length}`), `no number on page ${k + 1}`);
        }
        const text = execFileSync('pdftotext', ['-layout', file, '-'], { encoding: 'utf8', maxBuffer: 1 << 28 });
        const compared = plain(text);
        for (const [k, section] of SECTIONS[language].entries()) assert.ok(compared.includes(plain(`${k + 1}  ${section}`)), `${section} is not in ${language} ${paper}`);
        for (const figure of shown) assert.ok(compared.includes(plain(figure)), `${figure} is not in ${language} ${paper}`);
        for (const [id, rays, ...numbers] of points) assert.ok(compared.includes(plain(`${rays}${numbers.join('')}`)), `point ${id} ${numbers} is not in ${language} ${paper}`);
        assert.ok(compared.includes(plain('Class 4b')));
      }
    }
    // One file, the same words.
    const saved = await downloads(page, 1, () => page.click('.bar .action .button:not(.primary)'));
    const html = Object.values(saved)[0].toString('utf8');
    assert.ok(html.includes('Class 4b') && !html.includes('<script') && !/ (src|href)="http/.test(html));
    const file = join(folder, 'report.html');
    writeFileSync(file, html);
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
    const saved = await downloads(page, 1, () => page.locator('.drawings .link').first().click());
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
