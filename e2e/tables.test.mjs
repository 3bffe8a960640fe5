// The tables people work in: marking, typing, excluding, renaming, filling, pasting, each undone by its name; and many rows.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { drop, idle, notice, sample, scratch } from './desk.mjs';

const longer = { timeout: 900_000 };
const cell = (page, key, col) => page.locator(`.sheet tr[data-key="${key}"] td[data-col=${col}]`);
const keys = (page) => page.$$eval('.sheet tr.data', (rows) => rows.map((row) => row.dataset.key));
const shown = async (page) => Number(/^[\d\u2009]+/.exec(await page.textContent('.bar p'))[0].replaceAll('\u2009', ''));
const undoName = (page) => page.getAttribute('.tools .icon-button', 'aria-label');
const table = async (page, name) => {
  await page.click(`[data-table=${name}]`);
  await page.waitForSelector(`[data-table=${name}][aria-current]`);
};

test('rows are marked, typed into, excluded, renamed, filled and pasted, and every step can be undone', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768, permissions: ['clipboard-read', 'clipboard-write'] });
  try {
    await sample(page);
    await page.click('.to-tables');
    await page.waitForSelector('.sheet tr.data');
    const all = await shown(page);
    assert.ok(all > 50);

    // A range and one besides.
    const [first, , third, fourth] = await keys(page);
    await cell(page, first, 'Id').click();
    await cell(page, third, 'Id').click({ modifiers: ['Shift'] });
    await cell(page, fourth, 'Id').click({ modifiers: ['Control'] });
    assert.match(await page.textContent('.sheet-actions .count'), /^4 selected/);
    assert.match(await page.textContent('.foot .chosen'), /4 selected/);

    // Excluded, found by that, restored by undoing; the step has its name.
    await page.click('[data-action=exclude]');
    assert.equal(await page.locator('.sheet tr.off').count(), 4);
    assert.match(await undoName(page), /4 rows excluded, Points/);
    await page.click('[data-condition=Excluded]');
    assert.equal(await shown(page), 4);
    await page.click('[data-condition=All]');
    await page.keyboard.press('Control+z');
    assert.equal(await page.locator('.sheet tr.off').count(), 0);

    // Roles and names of many.
    await page.selectOption('.sheet-actions select[name=role]', 'check');
    assert.equal(await cell(page, third, 'Role').textContent(), 'check');
    await page.click('[data-action=rename]');
    await page.fill('[name=pattern]', 'N###');
    await page.press('[name=pattern]', 'Enter');
    await page.waitForSelector('.sheet tr[data-key=N004]');
    assert.match(await undoName(page), /4 points renamed/);
    await page.keyboard.press('Escape');
    await page.locator('.sheet table').focus();
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    assert.equal(await page.locator('.sheet tr[data-key=N004]').count(), 0);

    // Two points of one photo are not one.
    await cell(page, first, 'Id').click();
    await cell(page, third, 'Id').click({ modifiers: ['Control'] });
    await page.click('[data-action=merge]');
    assert.match(await notice(page), /shows both/);

    // Typed into: taken, or refused with the reason.
    await cell(page, first, 'Diameter').click();
    await page.keyboard.press('8');
    await page.keyboard.press('Enter');
    await page.waitForFunction((key) => document.querySelector(`.sheet tr[data-key="${key}"] [data-col=Diameter]`)?.textContent.startsWith('8'), first);
    await cell(page, first, 'Diameter').click();
    await page.keyboard.press('Enter');
    await page.fill('[name=cell]', 'wide');
    await page.press('[name=cell]', 'Enter');
    assert.match(await notice(page), /"wide" is no/);
    assert.match(await cell(page, first, 'Diameter').textContent(), /^8/);

    // Filled down from the first marked row.
    await cell(page, first, 'Diameter').click();
    await cell(page, fourth, 'Diameter').click({ modifiers: ['Shift'] });
    await page.click('[data-action=fill]');
    assert.match(await cell(page, third, 'Diameter').textContent(), /^8/);
    assert.match(await undoName(page), /3 cells edited, Points/);

    // Copied, changed in a spreadsheet, pasted: what would change is shown first.
    await page.click('[data-action=copy]');
    const lines = (await page.evaluate(() => navigator.clipboard.readText())).split('\n').map((line) => line.split('\t'));
    assert.equal(lines.length, 5);
    const at = lines[0].findIndex((name) => name.startsWith('diameter'));
    lines[1][at] = '9.5';
    lines[2][at] = 'much';
    await page.evaluate((text) => navigator.clipboard.writeText(text), lines.map((line) => line.join('\t')).join('\n'));
    await page.locator('.sheet table').focus();
    await page.keyboard.press('Control+v');
    await page.waitForSelector('.plan');
    assert.match(await page.textContent('.plan h2'), /1 cell to change, 1 refused, 0 lines/);
    assert.match(await cell(page, first, 'Diameter').textContent(), /^8/);
    await page.click('[data-action=take-plan]');
    await page.waitForFunction((key) => document.querySelector(`.sheet tr[data-key="${key}"] [data-col=Diameter]`)?.textContent.startsWith('9.5'), first);

    // Sorted by a heading, either way; found by name.
    await page.locator('.sheet th button').nth(1).click();
    assert.equal(await page.locator('.sheet th[aria-sort=ascending]').count(), 1);
    await page.fill('[name=filter]', first);
    assert.ok((await keys(page)).includes(first) && (await shown(page)) < all);

    // Keys go through rows and cells; Delete takes marked rows away, and undoing brings them back.
    await table(page, 'Observations');
    await page.locator('.sheet table').focus();
    const before = await shown(page);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Shift+ArrowDown');
    await page.keyboard.press('Delete');
    await page.waitForFunction(() => document.querySelector('.tools .icon-button').getAttribute('aria-label').includes('deleted'));
    assert.equal(await shown(page), before - 2);
    await page.keyboard.press('Control+z');
    assert.equal(await shown(page), before);
    for (const name of ['Photos', 'Cameras', 'Distances', 'Control', 'Identities']) {
      await table(page, name);
      assert.ok((await page.locator('.sheet th').count()) > 3, name);
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a hundred thousand observations are scrolled, sorted and filtered, and only those in sight are drawn', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    const photos = Array.from({ length: 100 }, (_, k) => ({ id: `${k + 1}`, camera: 'c', file: '', enabled: true }));
    const points = Array.from({ length: 1000 }, (_, k) => ({ id: `p${k + 1}` }));
    const observations = photos.flatMap((photo, i) => points.map((point, k) => ({ photo: photo.id, point: point.id, u: (k * 37 + i * 11) % 4000, v: (k * 53 + i) % 3000, sigma: 0.1, enabled: k % 100 > 0 })));
    const cameras = [{ id: 'c', width: 4000, height: 3000, model: 'opencv', fx: 3000, fy: 3000, cx: 2000, cy: 1500, k1: 0, k2: 0, p1: 0, p2: 0, k3: 0, skew: 0 }];
    const project = { format: 'sightline', version: 1, name: 'many', unit: 'mm', cameras, photos, points, observations, distances: [] };
    await drop(page, [scratch('many.json', JSON.stringify(project))]);
    await page.waitForFunction(() => document.title.startsWith('many'), undefined, { timeout: 120_000 });
    await idle(page);
    await page.click('.to-tables');
    await table(page, 'Observations');
    assert.equal(await shown(page), 100_000);
    assert.ok((await page.locator('.sheet tr.data').count()) < 150);
    await page.locator('.sheet th button').nth(2).click();
    await page.waitForFunction(() => document.querySelector('.sheet th[aria-sort=ascending]'));
    assert.equal(await page.locator('.sheet tr.data td[data-col=U]').first().textContent(), '0.000');
    await page.click('[data-condition=Excluded]');
    assert.equal(await shown(page), 1000);
    await page.click('[data-condition=All]');
    await page.fill('[name=filter]', 'p999');
    assert.equal(await shown(page), 100);
    await page.fill('[name=filter]', '');
    await page.locator('.sheet table').focus();
    await page.keyboard.press('Control+End');
    await page.waitForFunction(() => document.querySelector('.sheet-frame').scrollTop > 1_000_000);
    assert.ok((await page.locator('.sheet tr.data').count()) < 150);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
