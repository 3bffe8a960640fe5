// The page is killed at random moments, as a full memory or a flat battery does it; reopening has everything up to a second before.
// SIGHTLINE_KILLS is how often: a few in the tests, 200 in `cargo xtask bench field`. One browser, one profile, many kills: what a kill
// leaves behind is there in all that follow. SIGHTLINE_SEED draws other moments.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';

import { killRenderers, open } from './browser.mjs';
import { drop, go, sample, scratch } from './desk.mjs';

const KILLS = Number(process.env.SIGHTLINE_KILLS ?? 12);
/** What was done so long before the kill has to be there. */
const GRACE_MS = 1000;
/** Kills between two lines that say how far it is. */
const REPORT = 10;

let state = Number(process.env.SIGHTLINE_SEED ?? 20_250_117);
const random = () => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/** What a killed page leaves undone is no fault of a test. */
const dying = (work) => work.catch((error) => assert.match(String(error), /closed|crash|detached|Target|Protocol/i));

/** What would be undone next, once the history is read. */
async function undone(page) {
  await page.waitForFunction(() => document.querySelector('.tools .icon-button')?.disabled === false);
  return page.locator('.tools .icon-button').first().getAttribute('aria-label');
}

const text = async (page, selector) => (await page.textContent(selector)).trim();
const role = (page) => page.locator('.preview select').first();

// Each tells what it changes when it begins to, and when the page has it: from then on it has to be kept.
const WORK = {
  /** Names and roles, one after the other, each in its place in time. */
  async editing(page, seen) {
    await go(page, 'control');
    for (let i = 0; ; i++) {
      const name = `${seen.round} ${i}`;
      await page.fill('.project-name', name);
      const named = seen.begin({ name });
      await page.press('.project-name', 'Enter');
      named();
      if (i % 3 === 1) {
        const chosen = (await role(page).inputValue()) === 'check' ? 'control' : 'check';
        const changed = seen.begin({ role: chosen });
        await role(page).selectOption(chosen);
        changed();
      }
      await sleep(20);
    }
  },
  async detection(page, seen) {
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await page.waitForSelector('.progress', { state: 'detached' });
    seen.begin({ undo: await undone(page), targets: await text(page, '[data-step=targets] .figure') })();
    seen.ended = true;
  },
  async adjustment(page, seen) {
    await go(page, 'adjust');
    await page.click('.action .button');
    await page.waitForSelector('.progress', { state: 'detached' });
    seen.begin({ undo: await undone(page), results: await text(page, '[data-step=results] .figure') })();
    seen.ended = true;
  },
  async saving(page, seen) {
    const saved = page.waitForEvent('download');
    saved.catch(() => {});
    await page.getByRole('button', { name: 'Save with photos', exact: true }).click();
    await saved;
    seen.ended = true;
  },
};

/** What is watched, as the page that was opened again shows it; only what `like` has. */
async function shown(page, like) {
  const all = { name: await page.inputValue('.project-name') };
  if ('targets' in like) all.targets = await text(page, '[data-step=targets] .figure');
  if ('results' in like) all.results = await text(page, '[data-step=results] .figure');
  if ('undo' in like) all.undo = await undone(page);
  if ('role' in like) {
    await go(page, 'control');
    all.role = await role(page).inputValue();
  }
  return all;
}

const limit = { timeout: 120_000 + KILLS * 30_000, skip: !existsSync('/proc') && 'the processes of a browser are found in /proc' };
test(`killed ${KILLS} times, a project is there again each time`, limit, async () => {
  const { page: first, context, url, profile, close } = await open({ width: 1366, height: 768 });
  const written = (page) => page.waitForFunction(() => /saved|Saved/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 60_000 });
  try {
    let page = first;
    // One that nobody touches stays as well.
    await drop(page, [scratch('other.json', JSON.stringify({ format: 'sightline', version: 1, name: 'Other' }))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Other');
    await written(page);
    await page.click('.mark');
    await sample(page);
    await written(page);
    let name = await page.inputValue('.project-name');
    const lost = [];
    const ended = Object.fromEntries(Object.keys(WORK).map((kind) => [kind, 0]));
    let slowest = 0;
    const began = Date.now();
    for (let round = 0; round < KILLS; round++) {
      const kind = Object.keys(WORK)[round % 4];
      const states = [{ state: { name }, at: 0 }];
      const begin = (change) => {
        const next = { state: { ...states.at(-1).state, ...change }, at: Infinity };
        states.push(next);
        return () => (next.at = Date.now());
      };
      const seen = { round, ended: false, begin };
      const work = dying(WORK[kind](page, seen));
      await sleep(200 + random() * (kind === 'editing' ? 2500 : 5000));
      const crashed = page.waitForEvent('crash');
      const killed = Date.now();
      assert.ok(killRenderers(profile) > 0);
      // A new page waits for ever where the browser has not heard of it.
      await crashed;
      ended[kind] += Number(seen.ended);
      const dead = page;
      page = await context.newPage();
      // It hears of its end at once when it is closed.
      await dying(dead.close());
      await work;
      const back = Date.now();
      await page.goto(url);
      await page.click('[data-project]:not(:has-text("Other")) .do .button', { timeout: 30_000 });
      await page.waitForSelector('.project-name', { timeout: 30_000 });
      slowest = Math.max(slowest, Date.now() - back);
      // What was there a second before the kill, or anything later.
      const due = states.filter(({ at }) => at <= killed - GRACE_MS).length - 1;
      const allowed = states.slice(due).map((one) => one.state);
      const found = await shown(page, states.at(-1).state);
      const agrees = (one) => Object.entries(one).every(([key, value]) => found[key] === value);
      if (!allowed.some(agrees)) lost.push(`kill ${round}, ${kind}: ${JSON.stringify(found)} instead of ${JSON.stringify(allowed[0])} or later`);
      const photos = await text(page, '[data-step=photos] .figure');
      if (photos !== '8') lost.push(`kill ${round}, ${kind}: ${photos} photos`);
      name = found.name;
      if ((round + 1) % REPORT === 0) {
        const minutes = ((Date.now() - began) / 60_000).toFixed(1);
        console.log(`${round + 1} of ${KILLS} kills in ${minutes} min, ${lost.length} with a loss; ended before the kill: ${JSON.stringify(ended)}; reopened within ${slowest} ms`);
      }
    }
    assert.deepEqual(lost, []);
    // The photos are there too, and what was done can be undone still.
    await go(page, 'targets');
    await page.waitForSelector('.strip canvas.thumbnail');
    assert.equal(await page.locator('.strip canvas.thumbnail').count(), 8);
    await undone(page);
    await page.click('.tools .icon-button');
    await written(page);
    await page.click('.mark');
    await page.click('[data-project]:has-text("Other") .do .button');
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Other');
    await page.click('.mark');
    assert.equal(await page.locator('[data-project]').count(), 2);
  } finally {
    await close();
  }
});
