// Before the photos: targets to print and the plan.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { open } from './browser.mjs';

test('sheets are drawn, follow what is chosen and are handed over', async () => {
  const { page, errors, close } = await open();
  try {
    await page.click('[data-open="print"]');
    await page.waitForSelector('.sheet-shown svg');
    assert.equal(await page.getAttribute('.sheet-shown svg', 'viewBox'), '0 0 210 297');
    await page.selectOption('select[name="paper"]', { label: 'A3' });
    await page.waitForSelector('.sheet-shown svg[viewBox="0 0 297 420"]');
    await page.fill('input[name="numbers"]', '1-3, 999999');
    await page.press('input[name="numbers"]', 'Enter');
    await page.waitForSelector('.sheet-view [role="alert"]');
    await page.fill('input[name="numbers"]', '1-3');
    await page.press('input[name="numbers"]', 'Enter');
    await page.waitForSelector('.sheet-view [role="alert"]', { state: 'detached' });
    await page.fill('input[name="measured"]', '99.6');
    await page.press('input[name="measured"]', 'Enter');
    await page.waitForFunction(() => document.querySelector('.told').textContent.includes('0.9960'));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-action="pdf"]')]);
    assert.ok(readFileSync(await download.path()).subarray(0, 5).toString() === '%PDF-');
    // Another sheet is chosen by its small picture, which keeps the focus.
    assert.equal(await page.locator('.sketch svg').count(), 1);
    await page.fill('input[name="dots"]', '40');
    await page.press('input[name="dots"]', 'Enter');
    await page.waitForFunction(() => document.querySelectorAll('.sketch svg').length > 1);
    await page.click('[data-sketch="1"]');
    await page.waitForFunction(() => document.querySelector('.sheet-bar b').textContent.includes('2'));
    assert.equal(await page.evaluate(() => document.activeElement.dataset.sketch), '1');
    const [lists] = await Promise.all([page.waitForEvent('download'), page.click('[data-action="lists"]')]);
    assert.match(readFileSync(await lists.path(), 'utf8'), /9\.9600/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a plan is begun, made, changed by dragging, undone and kept', async () => {
  const { page, errors, close } = await open();
  try {
    await page.click('[data-open="plan"]');
    await page.click('[data-form="plane"]');
    await page.waitForSelector('.plan-view .point-at');
    await page.fill('input[name="precision"]', '0.03');
    await page.press('input[name="precision"]', 'Enter');
    await page.click('[data-action="make"]');
    await page.waitForSelector('.verdict [data-reached="true"]', { timeout: 30000 });
    const count = await page.locator('.stations tbody tr').count();
    assert.ok(count >= 3, `${count} photos`);

    const places = () => page.$$eval('tr[data-station="1"] input[type="text"]', (all) => all.map((input) => input.value).join());
    const before = await places();
    // The tip of the station's sign, in the view's own units.
    const view = page.locator('.plan-view[data-view="front"]');
    const d = await view.locator('[data-station="1"] path').getAttribute('d');
    const [, x, y] = /^M([-\d.]+) ([-\d.]+)/.exec(d).map(Number);
    const box = await view.boundingBox();
    const [, , width] = (await view.getAttribute('viewBox')).split(' ').map(Number);
    const scale = box.width / width;
    await page.mouse.move(box.x + x * scale, box.y + y * scale);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2, box.y + 40, { steps: 5 });
    await page.mouse.up();
    await page.waitForSelector('.station-at.chosen');
    assert.notEqual(await places(), before);
    await page.click('.tools .icon-button >> nth=0');
    assert.equal(await places(), before);

    // Where nobody can stand is drawn in a view, and nothing is dragged meanwhile.
    await page.click('[data-action="fence"]');
    const top = await page.locator('.plan-view[data-view="top"]').boundingBox();
    await page.mouse.move(top.x + 8, top.y + 8);
    await page.mouse.down();
    await page.mouse.move(top.x + 60, top.y + 40, { steps: 4 });
    await page.mouse.up();
    await page.waitForSelector('.plan-view[data-view="top"] .forbidden');
    assert.match(await page.textContent('.regions li'), /^X .* … .*, Y .* … /);
    assert.equal(await page.getAttribute('[data-action="fence"]', 'aria-pressed'), 'false');
    assert.equal(await places(), before);

    await page.click('[data-action="next"]');
    await page.waitForSelector('[data-take="0"]', { timeout: 30000 });
    await page.click('[data-take="0"]');
    await page.waitForFunction((n) => document.querySelectorAll('.stations tbody tr').length === n, count + 1);
    await page.click('[data-action="keep"]');
    await page.waitForSelector('.variants');
    assert.equal(await page.locator('.variants thead tr > *').count(), 3);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('points are typed, and what is wrong in them is told', async () => {
  const { page, errors, close } = await open();
  try {
    await page.click('[data-open="plan"]');
    await page.selectOption('select[name="unit"]', 'm');
    await page.fill('textarea[name="plan-points"]', 'a, 0, 0, 0\nb, 1, x, 0');
    await page.locator('textarea[name="plan-points"]').blur();
    await page.waitForSelector('[role="alert"] >> text=/2/');
    const grid = Array.from({ length: 12 }, (_, k) => `P${k + 1} ${(k % 4) * 0.5} 0 ${Math.floor(k / 4) * 0.5}`);
    await page.fill('textarea[name="plan-points"]', grid.join('\n'));
    await page.locator('textarea[name="plan-points"]').blur();
    await page.waitForSelector('.plan-view .point-at');
    assert.equal(await page.locator('.plan-view[data-view="top"] .point-at').count(), 12);
    await page.selectOption('select[name="facing"]', 'front');
    await page.fill('input[name="target-diameter"]', '0.01');
    await page.press('input[name="target-diameter"]', 'Enter');
    await page.fill('input[name="control"]', 'P1, P4, P9');
    await page.press('input[name="control"]', 'Enter');
    await page.selectOption('select[name="datum"]', 'control');
    await page.click('[data-action="make"]');
    await page.waitForSelector('.verdict [data-reached="true"]', { timeout: 30000 });
    assert.equal(await page.locator('.plan-view[data-view="top"] .point-at.given').count(), 3);
    await page.click('[data-look="space"]');
    await page.waitForSelector('.plan-view[data-view="space"] .station-at');
    await page.click('tr[data-station="1"] .id');
    assert.match(await page.textContent('[data-unseen]'), /Sees every point|Does not see/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
