// Equipment beyond a project: kept on this computer, handed over as a file, offered where photos show it.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, downloads, drop, go, idle, notice, photos, sample, save, scratch, unzipped } from './desk.mjs';

const longer = { timeout: 900_000 };
const undoName = (page) => page.getAttribute('.tools .icon-button', 'aria-label');
/** Goes to the equipment from the photos, as a person does. */
async function equipment(page) {
  await go(page, 'photos');
  await page.click('[data-open=equipment]');
}
const bar = { name: 'Bar A', from: '11', to: '12', length: '0.5', sigma: '0.00001', certificate: 'DAkkS 4711', date: '2025-11-30' };

/** Types a scale bar and keeps it. */
async function keepBar(page, values, unit = 'm') {
  for (const [field, value] of Object.entries(values)) await page.fill(`[name=bar-${field}]`, value);
  await page.selectOption('[name=bar-unit]', unit);
  await page.click('.bar-form button');
}

test('a calibration is kept, survives a reload, and is held, observed or a start for photos of that camera', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await equipment(page);
    assert.match(await page.textContent('.bar p'), /0 cameras/);
    const camera = await page.getAttribute('[data-keep]', 'data-keep');
    await page.click('[data-keep]');
    assert.match(await notice(page), /is stored on this computer/);
    assert.equal(await page.locator('[data-known-camera] .calibration').count(), 1);
    // The same once more is not kept twice.
    await page.click('[data-keep]');
    assert.equal(await page.locator('[data-known-camera] .calibration').count(), 1);
    await page.waitForTimeout(300);
    await afresh(page);
    await page.click('[data-open=equipment]');
    await page.waitForSelector('[data-known-camera]');

    // The sample again: its photos say which camera took them.
    await page.click('.mark');
    await sample(page);
    await go(page, 'photos');
    await page.waitForSelector('[data-offer]');
    const free = async () => {
      await go(page, 'adjust');
      await page.$$eval('details', (all) => all.forEach((one) => (one.open = true)));
      const all = await page.$$eval('.parameters input[data-parameter]', (boxes) => boxes.map((box) => [box.dataset.parameter, box.checked]));
      const sigmas = await page.$$eval('.parameters input[data-sigma]', (fields) => fields.filter((field) => field.value !== '').map((field) => field.dataset.sigma));
      await go(page, 'photos');
      return { free: all.filter(([, on]) => on).map(([name]) => name), sigmas };
    };
    const before = await free();
    assert.ok(before.free.length > 0 && before.sigmas.length === 0);
    await page.click('[data-use=held]');
    assert.match(await undoName(page), /calibration of/);
    assert.equal(await page.getAttribute('[data-use=held]', 'aria-pressed'), 'true');
    assert.deepEqual(await free(), { free: [], sigmas: [] });
    await page.click('[data-use=observed]');
    const observed = await free();
    assert.ok(observed.free.length > 0);
    assert.deepEqual([...observed.sigmas].sort(), [...observed.free].sort());
    await page.click('[data-use=free]');
    assert.deepEqual(await free(), { free: observed.free, sigmas: [] });
    for (let k = 0; k < 3; k++) await page.click('.tools .icon-button');
    assert.deepEqual(await free(), before);
    assert.ok(camera);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a scale bar gives its distance by itself where its codes are read, and once', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const saved = await downloads(page, 1, () => save(page));
    await idle(page);
    const entries = unzipped(Object.values(saved)[0]);
    const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
    const paths = names.map((name) => scratch(name.slice(7), entries[name]));
    const given = JSON.parse(entries['project.json']).distances.length;

    await equipment(page);
    await keepBar(page, { ...bar, length: 'half a metre' });
    assert.match(await notice(page), /half a metre/);
    await keepBar(page, { ...bar, to: '11' });
    assert.match(await notice(page), /two different points/);
    await keepBar(page, bar);
    assert.equal(await page.locator('[data-bar="Bar A"]').count(), 1);
    assert.equal(await page.inputValue('[name=bar-name]'), '');
    // Offered to the project that is open, in its unit; taken and taken back.
    const lengths = () => page.$$eval('[name=distance-length]', (all) => all.map((field) => Number(field.value)));
    await go(page, 'control');
    assert.match(await page.textContent('.bars-offer'), /Bar A \(11 – 12, 0\.5 m\)/);
    await page.click('[data-action=take-bars]');
    assert.equal((await lengths()).length, given + 1);
    assert.equal((await lengths()).at(-1), 500);
    assert.equal(await page.locator('.bars-offer').count(), 0);
    assert.match(await undoName(page), /from scale bars/);
    await page.click('.tools .icon-button');
    assert.equal((await lengths()).length, given);

    // In a project of photos alone: codes are read, and the distance is there.
    await page.waitForTimeout(300);
    await afresh(page);
    await photos(page, paths);
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await idle(page);
    assert.match(await notice(page), /Distances added from scale bars seen in the photos: Bar A/);
    await go(page, 'control');
    assert.deepEqual(await lengths(), [500]);
    // Taken away it is offered, and not forced on anybody.
    await page.click('.tools .icon-button');
    assert.deepEqual(await lengths(), []);
    assert.equal(await page.locator('.bars-offer').count(), 1);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('equipment goes out and comes in as one file, and what was removed can be had back', longer, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844, hasTouch: true, isMobile: true });
  try {
    await page.click('[data-open=equipment]');
    await keepBar(page, bar);
    await keepBar(page, { ...bar, name: 'Bar B', from: '13', to: '14' }, 'in');
    const saved = await downloads(page, 1, () => page.click('[data-action=export-equipment]'));
    const text = String(Object.values(saved)[0]);
    const file = JSON.parse(text);
    assert.deepEqual([file.format, file.version, file.bars.length, file.bars[1].unit], ['sightline-equipment', 1, 2, 'in']);
    await page.getByRole('button', { name: 'Remove the scale bar Bar A' }).click();
    assert.equal(await page.locator('[data-bar]').count(), 1);
    await page.click('[data-action=put-back]');
    assert.equal(await page.locator('[data-bar]').count(), 2);
    for (const name of ['Bar A', 'Bar B']) await page.getByRole('button', { name: `Remove the scale bar ${name}` }).click();
    assert.equal(await page.locator('[data-bar]').count(), 0);
    // Dropped anywhere, it is known by what is in it, in UTF-16 too.
    await page.click('.mark');
    await drop(page, [scratch('shop.json', Buffer.from(`\ufeff${text}`, 'utf16le'))]);
    await page.waitForSelector('[data-bar="Bar B"]');
    assert.match(await notice(page), /shop\.json: 0 new cameras, 0 calibrations, 2 scale bars/);
    await drop(page, [scratch('newer.json', text.replace('"version": 1', '"version": 9'))]);
    await page.waitForFunction(() => /newer\.json/.test(document.querySelector('.notice p')?.textContent ?? ''));
    assert.match(await notice(page), /version 9/);
    await drop(page, [scratch('wrong.json', text.replace('"length": 0.5', '"length": -0.5'))]);
    await page.waitForFunction(() => /wrong\.json/.test(document.querySelector('.notice p')?.textContent ?? ''));
    assert.match(await notice(page), /Bar A.*greater than 0|greater than 0.*Bar A/);
    assert.equal(await page.locator('[data-bar]').count(), 2);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
