// The lessons played through: every answer is read off the screen that the lesson shows, a wrong one is given first.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads } from './desk.mjs';

const folder = new URL('../lab/src/teaching/lessons/', import.meta.url);
const lessons = readdirSync(folder).map((name) => JSON.parse(readFileSync(new URL(name, folder), 'utf8')));

/** Numbers of a text as they are shown: thin spaces, minus signs, powers of ten. */
const numbers = (text) => {
  const plain = text.replaceAll('−', '-').replaceAll(/(?<=\d)[\u2009\u202f\u00a0](?=\d)/g, '').replaceAll(/\s*×\s*10/g, '×10');
  return [...plain.matchAll(/(-?\d+(?:\.\d+)?)(?:×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?/g)].map(([, mantissa, power]) => {
    const digits = [...(power ?? '⁰')].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('');
    return Number(mantissa) * 10 ** Number(digits);
  });
};
const first = async (page, selector) => numbers(await page.textContent(selector))[0];
const derivative = async (page, unknown) => {
  const rows = await page.$$eval('.derivatives tbody tr', (all) => all.map((row) => [row.cells[0].textContent, row.cells[1].textContent]));
  return numbers(rows.find(([name]) => name === unknown)[1])[0];
};
const text = async (page) => numbers(await page.textContent('.lesson-text'));
const figure = (page, row) => first(page, `.errors section:nth-child(2) .table.words tr:nth-child(${row}) td:nth-child(2)`);
const bias = async (page, diameter) => {
  const rows = await page.$$eval('.errors section:nth-child(2) tbody tr', (all) => all.map((row) => [row.cells[0].textContent, row.cells[3].textContent]));
  return numbers(rows.find(([size]) => numbers(size)[0] === diameter)[1])[0];
};
const finished = async (page) => {
  if (await page.locator('[data-action=run]:not([disabled])').count()) await page.click('[data-action=run]');
  await page.waitForSelector('[data-ended]');
  return page.locator('.steps-taken li').last();
};

/** Where each number asked for stands, by lesson and step. */
const read = {
  'weights 1': async (page) => { const [n, u] = numbers(await page.textContent('.bar > p')); return n - u; },
  'weights 2': () => 4,
  'weights 3': (page) => first(page, '[data-weighted=sigma0]'),
  'collinearity 1': (page) => first(page, '.observed tr:nth-child(3) b'),
  'collinearity 2': (page) => page.locator('.derivatives tbody tr').count(),
  'collinearity 3': async (page) => (await derivative(page, '7 X')) + (await derivative(page, '2 X')),
  'collinearity 4': (page) => derivative(page, 'lab camera c'),
  'iteration 1': async (page) => { await page.click('[data-action=step]'); await page.waitForSelector('li.now[data-step-number="1"]'); return first(page, 'li.now b'); },
  'iteration 2': async (page) => Number(await (await finished(page)).getAttribute('data-step-number')),
  'iteration 4': async (page) => numbers(await (await finished(page)).locator('b').textContent())[0],
  'datum 1': (page) => page.locator('[data-motion]').count(),
  'datum 5': async (page) => { const all = await page.$$eval('.equality > div:not(.sign) > b', (bold) => bold.map((one) => one.textContent)); return numbers(all[0])[0] - numbers(all[2])[0]; },
  'reliability 1': async (page) => 100 * (await figure(page, 1)),
  'reliability 2': (page) => figure(page, 2),
  'reliability 3': async (page) => Math.abs(await first(page, '[data-said=planted]')),
  'calibration 1': (page) => derivative(page, 'lab camera x0'),
  'calibration 3': async (page) => { const [c, sigma] = await text(page); return (1000 * sigma) / c; },
  'eccentricity 1': (page) => bias(page, 40),
  'eccentricity 2': async (page) => (await bias(page, 40)) / (await bias(page, 20)),
  'eccentricity 3': async (page) => 40 * Math.sqrt(0.1 / (await bias(page, 40))),
  'design 1': async (page) => { const all = await text(page); return 100 * (all.at(-1) / all.at(-3) - 1); },
};

const settled = (page) => page.waitForFunction(() => !document.querySelector('.lesson').textContent.includes('…') && !document.querySelector('.ask input[disabled]') && !document.querySelector('.with-lesson > main .note:not(.warn)'), undefined, { timeout: 60_000 }).catch(() => {});

async function played(page, lesson) {
  await page.click(`[data-lesson=${lesson.id}]`);
  for (const [k, step] of lesson.steps.entries()) {
    const name = `${lesson.id} ${k + 1}`;
    await page.waitForSelector('.lesson .ask');
    await settled(page);
    assert.doesNotMatch(await page.textContent('.lesson'), /NaN|\[|undefined/, name);
    if (step.ask.value) {
      await page.fill('[name=lesson-answer]', '-987');
      await page.click('[data-action=lesson-check]');
      await page.waitForSelector('[data-answer=wrong]');
      await page.waitForTimeout(300);
      const value = await read[name](page);
      await page.fill('[name=lesson-answer]', String(value));
      await page.click('[data-action=lesson-check]');
      await page.waitForSelector('[data-answer=right]', { timeout: 5000 }).catch(() => assert.fail(`${name}: ${value} is not taken`));
    } else {
      const seen = [];
      for (let choice = 0; choice < step.ask.choices.length; choice += 1) {
        await page.locator('[name=lesson-choice]').nth(choice).check();
        seen.push(await page.getAttribute('[data-answer]', 'data-answer'));
      }
      assert.deepEqual(seen.filter((answer) => answer === 'right'), ['right'], `${name}: ${seen}`);
    }
    assert.doesNotMatch(await page.textContent('.lesson'), /NaN|\[|undefined/, `${name}, answered`);
    await page.click('[data-action=lesson-next]');
  }
  await page.waitForSelector('.lesson-summary');
  const asked = lesson.steps.length;
  assert.match(await page.textContent('.lesson-summary'), new RegExp(`${asked} of ${asked}|${asked}개 중 ${asked}개`), lesson.id);
}

for (const [language, width] of [['en', 1366], ['ko', 390]]) {
  test(`every lesson is played through, ${language}, ${width} px`, { timeout: 900_000 }, async () => {
    const { page, errors, close } = await open({ width, height: width > 500 ? 768 : 844 });
    try {
      await page.evaluate((tag) => { localStorage.setItem('sightline.language', tag); location.hash = '#inside'; }, language);
      await page.reload();
      await page.waitForSelector('.steps-taken [data-step-number]', { timeout: 60_000 });
      await page.click('[data-inside=lessons]');
      await page.waitForSelector('[data-lesson]');
      assert.equal(await page.locator('[data-lesson]').count(), 8);
      for (const lesson of lessons) {
        await played(page, lesson);
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, `${lesson.id} is too wide`);
        await page.click('[data-action=all-lessons]');
      }
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });
}

test('progress is kept, a link carries it, and the lesson file of a third person opens', { timeout: 300_000 }, async () => {
  const { page, errors, close, url } = await open({ width: 1366, height: 768 });
  try {
    // A link opens on a fresh page: of one that still starts, the start page's address would replace it.
    await page.goto('about:blank');
    await page.goto(`${url}#inside/datum/2;0,1`);
    await page.waitForSelector('.lesson .ask', { timeout: 60_000 });
    assert.match(await page.textContent('.lesson-head'), /3 of 5/);
    await page.click('[data-action=all-lessons]');
    assert.match(await page.textContent('[data-lesson=datum]'), /2 of 5/);
    const own = async (contents) => {
      const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.click('[data-action=lesson-file]')]);
      await chooser.setFiles({ name: 'own.json', mimeType: 'application/json', buffer: Buffer.from(contents) });
    };
    // Progress is saved to a file. Opening the file replaces the progress stored in the browser.
    const saved = await downloads(page, 1, () => page.click('[data-action=lesson-progress]'));
    const progress = JSON.parse(Buffer.from(saved['lesson-progress.json']).toString());
    assert.deepEqual(progress.lessons, { datum: { step: 2, right: [0, 1] } });
    progress.lessons = { datum: { step: 3, right: [0, 1, 2] }, weights: { step: 1, right: [0] } };
    progress.open = 'datum';
    await own(JSON.stringify(progress));
    await page.waitForSelector('.lesson .ask');
    assert.match(await page.textContent('.lesson-head'), /4 of 5/);
    await page.click('[data-action=all-lessons]');
    assert.match(await page.textContent('[data-lesson=datum]'), /3 of 5/);
    assert.match(await page.textContent('[data-lesson=weights]'), /1 of 5/);
    await own('{"format": "other"}');
    await page.waitForSelector('.lesson .note.warn');
    const example = /```json\n(.*?)```/s.exec(readFileSync(new URL('../docs/lessons.md', import.meta.url), 'utf8'))[1];
    await own(example);
    await page.waitForSelector('.lesson .ask');
    assert.match(await page.textContent('.lesson h2'), /Rays/);
    await page.waitForFunction(() => !document.querySelector('[name=lesson-answer]').disabled);
    await page.fill('[name=lesson-answer]', '5');
    await page.click('[data-action=lesson-check]');
    await page.waitForSelector('[data-answer=right]');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
