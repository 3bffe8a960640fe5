// The page is killed at random moments, as a full memory or a flat battery does it; reopening has everything up to a second before.
// SIGHTLINE_KILLS is how often: a few in the tests, 200 in `cargo xtask bench field`.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';

import { killRenderers, open } from './browser.mjs';
import { go, sample } from './desk.mjs';

const KILLS = Number(process.env.SIGHTLINE_KILLS ?? 10);
/** What was done so long before the kill has to be there. */
const GRACE_MS = 1000;

let state = 20_250_117;
const random = () => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/** What a killed page leaves undone is no fault of a test. */
const dying = (work) => work.catch((error) => assert.match(String(error), /closed|crash|detached|Target|Protocol/i));

const WORK = {
  /** Names, one after the other, each in its place in time. */
  async editing(page, seen) {
    for (let i = 0; ; i++) {
      const name = `${seen.round} ${i}`;
      await page.fill('.project-name', name);
      await page.press('.project-name', 'Enter');
      seen.names.push({ name, at: Date.now() });
      if (i % 3 === 1) {
        await go(page, 'control');
        const select = page.locator('.preview select').first();
        await select.selectOption((await select.inputValue()) === 'tie' ? 'control' : 'tie');
      }
      await sleep(20);
    }
  },
  async detection(page) {
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await sleep(60_000);
  },
  async adjustment(page, seen) {
    await go(page, 'adjust');
    await page.click('.action .button');
    await page.waitForSelector('.progress', { state: 'detached' });
    await sleep(50);
    seen.sigma0 = { text: await page.textContent('[data-step=results] .figure'), at: Date.now() };
    await sleep(60_000);
  },
  async saving(page) {
    await page.getByRole('button', { name: 'Save with photos', exact: true }).click();
    await sleep(60_000);
  },
};

test(`killed ${KILLS} times, a project is there again each time`, { timeout: 120_000 + KILLS * 30_000, skip: !existsSync('/proc') && 'the processes of a browser are found in /proc' }, async () => {
  const { page: first, context, url, profile, close } = await open({ width: 1366, height: 768 });
  try {
    let page = first;
    await sample(page);
    await page.waitForFunction(() => /saved|Saved/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 60_000 });
    let lastName = 'Sample';
    const lost = [];
    for (let round = 0; round < KILLS; round++) {
      const kind = Object.keys(WORK)[round % 4];
      const seen = { round, names: [{ name: lastName, at: 0 }], sigma0: null };
      const work = dying(WORK[kind](page, seen));
      await sleep(200 + random() * (kind === 'editing' ? 2500 : 4000));
      const killed = Date.now();
      assert.ok(killRenderers(profile) > 0);
      await Promise.race([work, sleep(3000)]);
      const dead = page;
      page = await context.newPage();
      await dying(dead.close());
      await page.goto(url);
      await page.click('[data-project] .do .button', { timeout: 30_000 });
      await page.waitForSelector('.project-name', { timeout: 30_000 });
      const name = await page.inputValue('.project-name');
      const due = seen.names.filter(({ at }) => at <= killed - GRACE_MS).length - 1;
      const found = seen.names.findIndex((one) => one.name === name);
      if (found < due) lost.push(`round ${round}, ${kind}: ${name} instead of ${seen.names[due].name} or later`);
      if (seen.sigma0 && seen.sigma0.at <= killed - GRACE_MS) {
        const sigma0 = await page.textContent('[data-step=results] .figure');
        if (sigma0 !== seen.sigma0.text) lost.push(`round ${round}: ${sigma0} instead of ${seen.sigma0.text}`);
      }
      const photos = await page.textContent('[data-step=photos] .figure');
      if (photos.trim() !== '8') lost.push(`round ${round}, ${kind}: ${photos} photos`);
      lastName = name;
    }
    assert.deepEqual(lost, []);
    // The photos are there too, and what was done can be undone still.
    await go(page, 'targets');
    await page.waitForSelector('.strip canvas.thumbnail');
    assert.equal(await page.locator('.strip canvas.thumbnail').count(), 8);
    await page.waitForFunction(() => document.querySelector('.tools .icon-button')?.disabled === false);
    await page.click('.tools .icon-button');
  } finally {
    await close();
  }
});
