// Whatever lasts can be stopped: every task of the workers is held back until its button is pressed, and the desk works on.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, choosePoint, data, downloads, drop, figure, files, go, idle, notice, photos, sample, save, scratch, unzipped } from './desk.mjs';

/** Before the worker's own script: each task waits until it may begin. */
const PATIENT = `
{
  const { set } = Object.getOwnPropertyDescriptor(self, 'onmessage');
  Object.defineProperty(self, 'onmessage', { set: (handler) => set.call(self, (event) => fetch('held').then(() => handler(event))) });
}
`;

/** Before the page's own scripts: how long it breathes between two pieces of a long object, from an answer of many pieces on too, and how often workers were asked. */
const SLOW = `
{
  const post = MessagePort.prototype.postMessage;
  MessagePort.prototype.postMessage = function (...all) {
    if (self.breath) setTimeout(() => post.apply(this, all), self.breath);
    else post.apply(this, all);
  };
  self.asked = 0;
  const ask = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (...all) {
    if (all[0]?.body) self.asked += 1;
    return ask.apply(this, all);
  };
  const { set } = Object.getOwnPropertyDescriptor(Worker.prototype, 'onmessage');
  const listen = (handler) => (event) => {
    if (event.data.bytes?.length > 3) self.breath = self.breathOfAnswers ?? self.breath;
    handler(event);
  };
  Object.defineProperty(Worker.prototype, 'onmessage', { set(handler) { set.call(this, handler && listen(handler)); } });
}
`;

/** The page with workers that begin nothing between \`hold\` and \`release\`. */
async function openHeld() {
  const opened = await open({ width: 1366, height: 768, cores: 4, serviceWorkers: 'block' });
  let [gate, release] = [Promise.resolve(), () => {}];
  const hold = () => (gate = new Promise((done) => (release = done)));
  await opened.context.route('**/worker.js', async (route) => {
    const answer = await route.fetch();
    await route.fulfill({ response: answer, body: `${PATIENT}\n${await answer.text()}` });
  });
  await opened.context.route('**/held', async (route) => {
    await gate;
    // Who asked may have been ended meanwhile.
    await route.fulfill({ body: '' }).catch(() => {});
  });
  await afresh(opened.page);
  return { ...opened, hold, release: () => release() };
}

/** Stops what has taken the slot of the action. */
async function cancel(page, kind) {
  const bar = page.locator('.progress');
  await bar.waitFor({ timeout: 20_000 });
  assert.equal(await bar.getAttribute('aria-label'), kind);
  await bar.locator('xpath=following-sibling::button').click();
  await bar.waitFor({ state: 'detached' });
}

/** Stops what is done by the way and lasts: what was asked last stands first, and is stopped on the way. */
async function cancelLasting(page, kind) {
  for (let tries = 0; tries < 5; tries++) {
    await page.click('.background-task .button', { trial: true });
    // In one step: the element there may change a moment later.
    const stopped = await page.evaluate(() => {
      const row = document.querySelector('.background-task');
      row?.querySelector('button').click();
      return row?.querySelector('p').textContent;
    });
    await page.waitForFunction((words) => document.querySelector('.background-task p')?.textContent !== words, stopped);
    if (stopped === kind) return;
  }
  assert.fail(`${kind} is not told of`);
}

test('every long job has a cancel, and nothing is the worse for it', { timeout: 900_000 }, async () => {
  const { page, errors, hold, release, close } = await openHeld();
  try {
    await page.waitForSelector('.sample');
    hold();
    await page.click('.sample');
    await cancel(page, 'Rendering, measuring and adjusting the sample');
    release();
    await sample(page);
    const sigma0 = await figure(page, 'sigma0');
    const whole = Object.values(await downloads(page, 1, () => save(page)))[0];
    const entries = unzipped(whole);
    const [photo] = Object.keys(entries).filter((name) => name.startsWith('photos/'));
    await idle(page);

    await go(page, 'targets');
    await page.click('[data-photo="sample-5"]');
    hold();
    await page.click('[data-photo="sample-2"]');
    await cancelLasting(page, 'Reading a photo');

    await page.click('[data-action=detect]');
    await cancel(page, 'Detecting');
    await go(page, 'adjust');
    await page.click('.action .button');
    await cancel(page, 'Adjusting');
    assert.match(await notice(page), /Cancelled/);
    await go(page, 'identities');
    await page.click('[data-action=match]');
    await cancel(page, 'Matching');
    await choosePoint(page, '11');
    await cancelLasting(page, 'Orienting photos to predict point positions');
    await save(page);
    await cancel(page, 'Saving');

    await go(page, 'report');
    await cancelLasting(page, 'Writing the report');
    assert.match(await page.textContent('.note.bad'), /stopped/);
    release();
    await go(page, 'results');
    await go(page, 'report');
    const saving = page.getByRole('button', { name: 'Save HTML', exact: true });
    await page.waitForFunction(() => document.querySelector('.note.bad') === null);
    await saving.and(page.locator(':enabled')).waitFor();
    hold();
    await saving.click();
    await cancel(page, 'Writing the report');
    await go(page, 'results');
    await page.click('[data-shown=plots]');
    await cancelLasting(page, 'Drawing plots');

    await page.click('.mark');
    await page.click('[data-open="print"]');
    await cancelLasting(page, 'Drawing targets');
    // Not on the start page, where photos begin a project.
    await go(page, 'photos');
    await drop(page, [scratch(photo.slice(7), Buffer.concat([entries[photo], Buffer.from('another')]))]);
    await cancel(page, 'Opening photos');
    await drop(page, [scratch('own.sightline', whole)]);
    await cancel(page, 'Opening the project');

    // What was stopped can be done after all, with what it gave before.
    release();
    await go(page, 'adjust');
    await page.click('.action .button');
    await idle(page);
    await go(page, 'results');
    assert.equal(await figure(page, 'sigma0'), sigma0);
    await go(page, 'report');
    await page.waitForFunction(() => document.querySelector('.note.bad') === null);
    assert.deepEqual(errors, []);
  } finally {
    release();
    await close();
  }
});

test('plans and experiments can be stopped', { timeout: 600_000 }, async () => {
  const { page, errors, hold, release, close } = await openHeld();
  try {
    await page.click('[data-open="plan"]');
    await page.click('[data-form="plane"]');
    await page.waitForSelector('.plan-view .point-at');
    await page.fill('input[name="precision"]', '0.03');
    await page.press('input[name="precision"]', 'Enter');
    await page.click('[data-action="make"]');
    await page.waitForSelector('.verdict [data-reached="true"]', { timeout: 60_000 });
    await idle(page);
    const count = await page.locator('.stations tbody tr').count();
    hold();
    for (const action of ['next', 'make']) {
      await page.click(`[data-action="${action}"]`);
      await cancel(page, 'Computing stations');
    }
    assert.equal(await page.locator('.stations tbody tr').count(), count);
    await page.fill('input[name="precision"]', '0.04');
    await page.press('input[name="precision"]', 'Enter');
    await cancelLasting(page, 'Computing the plan');
    release();
    await page.fill('input[name="precision"]', '0.05');
    await page.press('input[name="precision"]', 'Enter');
    await page.click('[data-action="next"]');
    await page.waitForSelector('[data-take="0"]', { timeout: 60_000 });

    await page.click('.mark');
    await page.click('.experiments-entry');
    await idle(page);
    hold();
    await page.click('.action .run');
    await cancel(page, 'Running the experiment');
    assert.deepEqual(errors, []);
  } finally {
    release();
    await close();
  }
});

test('an adjustment is stopped while its project is written for the worker, and while its result is read', { timeout: 300_000 }, async () => {
  const { page, context, errors, close } = await open({ width: 1366, height: 768, serviceWorkers: 'block' });
  const slowly = (breath, breathOfAnswers) => page.evaluate(([own, answers]) => Object.assign(self, { breath: own, breathOfAnswers: answers }), [breath, breathOfAnswers]);
  try {
    await context.addInitScript(SLOW);
    await afresh(page);
    await sample(page);
    await idle(page);
    await go(page, 'results');
    const sigma0 = await figure(page, 'sigma0');
    await go(page, 'adjust');
    const unmodelled = page.locator('input[name="unmodelled"]');
    const before = await unmodelled.inputValue();
    const choose = async (typed) => {
      await unmodelled.fill(typed);
      await unmodelled.press('Enter');
      await idle(page);
    };
    await choose('0.3');

    await slowly(1000);
    const asked = await page.evaluate(() => self.asked);
    await page.click('.action .button');
    await cancel(page, 'Adjusting');
    assert.match(await notice(page), /Cancelled. The last result is kept/);
    await slowly(0);
    await page.waitForTimeout(2500);
    assert.equal(await page.evaluate(() => self.asked), asked, 'a project that nobody waits for goes to no worker');

    await slowly(0, 1000);
    await page.click('.action .button');
    await page.waitForFunction(() => self.breath === 1000, undefined, { timeout: 60_000 });
    await cancel(page, 'Adjusting');
    assert.match(await notice(page), /Cancelled. The last result is kept/);
    await page.waitForTimeout(2500);
    await choose(before);
    await go(page, 'results');
    assert.equal(await figure(page, 'sigma0'), sigma0);

    await slowly(0, 0);
    await go(page, 'adjust');
    await choose('0.3');
    await page.click('.action .button');
    await idle(page);
    await go(page, 'results');
    assert.notEqual(await figure(page, 'sigma0'), sigma0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('undoing what was edited while targets were detected leaves the targets', { skip: data('panel') ? false : 'skipped, no data', timeout: 300_000 }, async () => {
  const { page, errors, close, hold, release } = await openHeld();
  try {
    await photos(page, files(data('panel'), '.tif').slice(0, 2));
    const before = await page.inputValue('[data-field=c]');
    hold();
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await go(page, 'photos');
    await page.fill('[data-field=c]', '25.5');
    await page.press('[data-field=c]', 'Tab');
    release();
    await idle(page);
    const undo = page.locator('.tools .icon-button').first();
    await undo.click();
    assert.equal(await page.inputValue('[data-field=c]'), before);
    const found = async () => {
      const given = await downloads(page, 1, () => save(page, false));
      return Object.values(JSON.parse(unzipped(Object.values(given)[0])['targets.json'] ?? '{}')).map(({ targets }) => targets.length > 10);
    };
    assert.deepEqual(await found(), [true, true]);
    // The next press takes back the detection.
    await undo.click();
    assert.deepEqual(await found(), []);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
