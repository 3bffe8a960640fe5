// The report printed as a person prints it, in both languages and sizes, and what must be on its pages.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { rows } from './desk.mjs';

const fonts = spawnSync('fc-list', [':lang=ko'], { encoding: 'utf8' });
/** A reason to skip, where there is nothing that reads a PDF, or nothing to print Korean with. */
export const unreadable = spawnSync('pdftotext', ['-v']).status !== 0 ? 'skipped, no pdftotext' : fonts.status === 0 && !fonts.stdout.trim() ? 'skipped, no Korean font' : false;

const SECTIONS = {
  en: ['Summary', 'Uncertainty of the coordinates', 'Observations and unknowns', 'Cameras', 'Network', 'Photos', 'Points', 'Control, check points and scale', 'Length measurement errors', 'Statistics and tests', 'Residuals by photo', 'Rejected observations', 'Features', 'Settings and inputs'],
  ko: ['요약', '좌표의 불확도', '관측값과 미지수', '카메라', '관측망', '사진', '점', '기준점, 검사점, 축척', '길이측정오차', '통계와 검정', '사진별 잔차', '제외한 관측값', '형상', '설정과 입력 자료'],
};
/** Width and height in points. */
const SIZES = { a4: [595, 842], letter: [612, 792] };

/** Text as it can be compared: without what only sets it apart. */
export const plain = (text) => text.replaceAll(/\s+/g, '');

/** Sizes of the pages, and the box of each word. */
function boxes(file) {
  const html = execFileSync('pdftotext', ['-bbox', file, '-'], { encoding: 'utf8', maxBuffer: 1 << 28 });
  return html.split('<page ').slice(1).map((page) => {
    const [, width, height] = page.match(/width="([\d.]+)" height="([\d.]+)"/).map(Number);
    const words = [...page.matchAll(/<word xMin="([\d.-]+)" yMin="([\d.-]+)" xMax="([\d.-]+)" yMax="([\d.-]+)">(.*?)<\/word>/g)];
    return { width, height, words: words.map(([, ...rest]) => ({ box: rest.slice(0, 4).map(Number), text: rest[4] })) };
  });
}

/** A number with so many decimals, as it is printed and compared. */
const digits = (value, decimals) => {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
};

/** Rows of exported points as they are printed: rays, coordinates and their standard errors with the decimals of the page's own table. */
export function printedPoints(csv, decimals) {
  return rows(csv).map((row) => {
    const numbers = Object.keys(row).filter((name) => /^s?[XYZ] \[/.test(name));
    return [row.id, row.rays, ...numbers.map((name) => (row[name] === '' ? '–' : digits(Number(row[name]), decimals)))];
  });
}

/**
 * Prints the report that is shown in both languages and sizes. Every section but those `without` is found, nothing lies outside the page, each
 * page says its number, and all of `figures` and `points` (id, rays, six numbers) are on the paper to the printed digit.
 */
export async function printed(page, { figures = [], points = [], without = [] }) {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-report-'));
  for (const language of ['en', 'ko']) {
    await page.selectOption('[name=report-language]', language);
    await page.waitForFunction((tag) => document.querySelector('.paper').shadowRoot.querySelector('.report').lang === tag, language);
    await page.waitForSelector('.paper[data-ready=true]');
    for (const paper of ['a4', 'letter']) {
      await page.selectOption('[name=paper]', paper);
      const size = paper === 'a4' ? 'a4' : 'letter';
      await page.waitForFunction((name) => [...document.adoptedStyleSheets].some((sheet) => [...sheet.cssRules].some((rule) => rule.cssText.toLowerCase().includes(`size: ${name}`))), size);
      await page.waitForSelector('.paper[data-ready=true]');
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
      const text = plain(execFileSync('pdftotext', ['-layout', file, '-'], { encoding: 'utf8', maxBuffer: 1 << 28 }));
      const sections = SECTIONS[language].filter((_, k) => !without.includes(SECTIONS.en[k]));
      for (const [k, section] of sections.entries()) assert.ok(text.includes(plain(`${k + 1}  ${section}`)), `${section} is not in ${language} ${paper}`);
      for (const figure of figures) assert.ok(text.includes(plain(figure)), `${figure} is not in ${language} ${paper}`);
      for (const [id, rays, ...numbers] of points) assert.ok(text.includes(plain(`${rays}${numbers.join('')}`)), `point ${id} ${numbers} is not in ${language} ${paper}`);
    }
  }
  return folder;
}
