// Calibrating a camera on the page: a path from the start page, the dots of a board named, halves of the photos against each other, photos
// taken together.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { data, detect, go, idle, photos, sample } from './desk.mjs';

const folder = data('photos');

test('the dots of a board are named, what is no number is said at its field, and the change has its name', { skip: folder ? false : 'skipped, no data', timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, ['acircles1.png', 'acircles2.png'].map((name) => join(folder, name)));
    await detect(page, {});
    await go(page, 'identities');
    await page.click('[data-action=grid]');
    const fill = async (name, value) => {
      await page.fill(`input[name=${name}]`, value);
      await page.press(`input[name=${name}]`, 'Enter');
    };
    await fill('grid-rows', '13');
    await fill('grid-columns', '7');
    await fill('grid-pitch', 'wide');
    assert.match(await page.textContent('[data-refused=grid-pitch]'), /“wide”.*20|“wide”.*earlier value stays/);
    assert.equal(await page.inputValue('input[name=grid-pitch]'), '20');
    await fill('grid-rows', '1.5');
    assert.match(await page.textContent('[data-refused=grid-rows]'), /“1\.5”/);
    assert.equal(await page.inputValue('input[name=grid-rows]'), '13');
    await fill('grid-pitch', '15');
    assert.equal(await page.locator('[data-refused=grid-pitch]').count(), 0);
    await page.click('[data-action=name-grid]');
    await page.waitForSelector('[data-grid=result]', { timeout: 120_000 });
    assert.match(await page.textContent('[data-grid=result]'), /Named in 2 of 2 photos: 182 new observations/);
    assert.match(await page.getAttribute('[aria-label^="Undo"]', 'aria-label'), /182 dots of a circle grid named/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a path of its own leads from the start page to coverage, models and halves of the photos', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.click('[data-open=calibrate]');
    await page.waitForSelector('.calibrating [data-part=files]');
    assert.equal(await page.evaluate(() => location.hash), '#calibrate');
    await page.click('.mark');
    await sample(page);
    await page.evaluate(() => (location.hash = '#calibrate'));
    await page.waitForSelector('[data-result=coverage] [data-bars=roll]', { timeout: 60_000 });
    for (const bars of ['radius', 'roll', 'tilt']) assert.ok((await page.locator(`[data-bars=${bars}] tbody tr`).count()) > 3);
    await page.click('[data-action=cross-validate]');
    await page.waitForSelector('[data-result=cross-validation]', { timeout: 120_000 });
    assert.match(await page.getAttribute('[data-result=cross-validation]', 'data-verdict'), /agrees|larger_noise|wrong_model/);
    assert.equal(await page.locator('[data-result=cross-validation] .map').count(), 2);
    // How well the adjusted camera predicts: map, by distance, residuals by column and row.
    if (!(await page.locator('[data-action=judge-camera]').count())) await page.click('[data-action=adjust]');
    await page.waitForSelector('[data-action=judge-camera]', { timeout: 120_000 });
    if (!(await page.evaluate(() => location.hash === '#calibrate'))) await page.evaluate(() => (location.hash = '#calibrate'));
    await page.click('[data-action=judge-camera]');
    await page.waitForSelector('[data-result=predicted-uncertainty]', { timeout: 120_000 });
    assert.match(await page.textContent('[data-result=predicted-uncertainty] [role=status]'), /predicted to [\d.]+ px/);
    for (const plot of ['distance', 'columns', 'rows']) assert.equal(await page.locator(`[data-plot=${plot}] svg`).count(), 1, plot);
    assert.equal(await page.locator('[data-plot=distance] :is(.line-a, .line-b)[d*=L]').count(), 2);
    assert.ok((await page.locator('[data-plot=columns] .bar-a').count()) >= 8);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a project that is begun before the storage has answered is kept, and another opens without a question', { timeout: 600_000 }, async () => {
  const { page, context, errors, url, close } = await open({ width: 1366, height: 768 });
  try {
    // A slow disk: the script of the storage comes after two clicks.
    let release;
    const clicked = new Promise((resolve) => (release = resolve));
    await context.route('**/storage*.js', async (route) => {
      await clicked;
      await route.continue();
    });
    await page.goto('about:blank');
    await page.goto(url);
    await page.click('[data-open=calibrate]');
    await page.waitForSelector('.calibrating [data-part=files]');
    await page.click('.mark');
    const opened = sample(page);
    await page.waitForTimeout(500);
    release();
    await opened;
    await page.click('.mark');
    await page.waitForFunction(() => document.querySelectorAll('tr[data-project]').length === 2, undefined, { timeout: 30_000 });
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('photos taken together are paired, kept, and undone', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'photos');
    assert.equal(await page.locator('[data-panel=rig]').count(), 0, 'one camera is no rig');
    // Every second photo is given a camera of its own.
    const tiles = page.locator('.tiles li');
    for (let k = 0; k < 8; k += 2) await tiles.nth(k).click({ modifiers: k ? ['Control'] : [] });
    await page.selectOption('.photos .side .fields select >> nth=0', '\u0000own');
    await page.waitForSelector('[data-panel=rig]');
    await page.click('[data-action=make-rig]');
    await page.waitForSelector('[data-table=rig]');
    assert.equal(await page.locator('[data-table=rig] tbody tr').count(), 4);
    await idle(page);
    await page.keyboard.press('Control+z');
    await page.waitForSelector('[data-table=rig]', { state: 'detached' });
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
