// The sample's journey in every browser that is here: Chromium, Firefox (firefox-esr), WebKit (webkit2gtk-driver and Xvfb), all with the same
// figures. Crews carry what they carry. A browser that is missing is skipped by name.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';

import { open } from './browser.mjs';
import { sample } from './desk.mjs';
import { firefox, webkit } from './others.mjs';

/** Results of the sample as they are shown. */
const shown = () => {
  const text = (selector) => [...document.querySelectorAll(selector)].map((element) => element.textContent.trim());
  const rows = [...document.querySelectorAll('tr[data-camera]')].map((row) => [...row.cells].map((cell) => cell.textContent.trim()).join(' '));
  const results = [...document.querySelectorAll('[data-result]')].map((element) => `${element.dataset.result} ${element.textContent.trim()}`);
  return { figures: text('[data-step] .figure'), hero: text('.hero'), results, rows };
};

let expected;

before(async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await page.waitForSelector('[data-result=sigma0]');
    expected = await page.evaluate(shown);
    assert.ok(expected.results.length > 2 && expected.rows.length > 4, JSON.stringify(expected));
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

for (const [name, start] of Object.entries({ Firefox: firefox, WebKit: webkit })) {
  test(`the sample's journey in ${name} gives the figures that Chromium gives`, { timeout: 600_000 }, async (t) => {
    const page = await start();
    if (!page) return t.skip(`skipped, no ${name}`);
    try {
      await page.goto(process.env.SIGHTLINE_URL);
      await page.until(() => document.querySelector('.sample') !== null, 60);
      await page.run(() => document.querySelector('.sample').click());
      await page.until(() => location.hash === '#results' && document.querySelector('[data-result=sigma0]') !== null, 300);
      assert.deepEqual(await page.run(shown), expected);
      // What was done is kept here too: it is there again after the page is loaded anew.
      await page.until(() => /^saved \d/.test(document.querySelector('.project span')?.textContent), 60);
      await page.goto(process.env.SIGHTLINE_URL);
      await page.until(() => document.querySelector('[data-project] .do .button') !== null, 60);
      await page.run(() => document.querySelector('[data-project] .do .button').click());
      await page.until(() => document.querySelector('[data-result=sigma0]') !== null, 60);
      assert.deepEqual(await page.run(shown), expected);
    } finally {
      await page.close();
    }
  });
}
