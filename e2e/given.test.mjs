// Ambiguous input is confirmed by the user: photos with equal names, units of length, numbers and tables with two interpretations.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { test } from 'node:test';
import { crc32, deflateSync } from 'node:zlib';

import { open } from './browser.mjs';
import { downloads, drop, go, idle, notice, save, scratch, unzipped } from './desk.mjs';

const longer = { timeout: 300_000 };
const shots = process.env.SIGHTLINE_SHOTS;

/** A grey picture as PNG; different seeds give different contents. */
function png(seed, width = 320, height = 240) {
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name, 'latin1'), data]);
    const ends = [Buffer.alloc(4), Buffer.alloc(4)];
    ends[0].writeUInt32BE(data.length);
    ends[1].writeUInt32BE(crc32(body));
    return Buffer.concat([ends[0], body, ends[1]]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = 8;
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) rows[y * (width + 1) + 1 + x] = 90 + ((x * seed + y * 3) % 60);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

const sha256 = (bytes) => createHash('sha256').update(bytes).digest('hex');
const [measured, other, third] = [png(1), png(2), png(5)];

/** A project of two measured photos, with or without the digests of their files. */
function project(digests = [sha256(measured), sha256(third)], unit = 'mm') {
  const photo = (k) => ({ id: String(k + 1), camera: 'k', file: ['DSC_0001.JPG', 'DSC_0002.JPG'][k], ...(digests[k] ? { sha256: digests[k] } : {}) });
  const observation = (photo, point, u) => ({ photo, point, u, v: 50, sigma: 0.1 });
  return {
    format: 'sightline',
    version: 1,
    name: 'Given',
    unit,
    cameras: [{ id: 'k', width: 320, height: 240, model: 'brown', c: 400 }],
    photos: [photo(0), photo(1)],
    points: [{ id: 'a', role: 'control', xyz: [565, 0, 0.5], sigma: [0.25, 0.25, null] }, { id: 'b' }],
    observations: [observation('1', 'a', 40), observation('1', 'b', 80), observation('2', 'a', 60)],
    distances: [{ from: 'a', to: 'b', length: 250, sigma: 0.5 }],
  };
}

async function opened(page, document) {
  await drop(page, [scratch('given.json', JSON.stringify(document))]);
  await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Given');
  await go(page, 'photos');
}

/** Screenshots in both languages and two widths, if SIGHTLINE_SHOTS names a folder. */
async function pictures(page, name) {
  if (!shots) return;
  for (const language of ['en', 'ko']) {
    for (const width of [390, 1366]) {
      await page.setViewportSize({ width, height: width === 390 ? 844 : 768 });
      await page.screenshot({ path: `${shots}/${name}-${language}-${width}.png` });
    }
    await page.getByRole('button', { name: /Language|언어/ }).first().click();
  }
}

const answer = (page, name) => page.locator('.asking').getByRole('button', { name }).click();
const asked = (page) => page.waitForSelector('.asking');
const tiles = (page) => page.locator('.tile').count();

async function saved(page) {
  await page.setViewportSize({ width: 1366, height: 768 });
  const files = await downloads(page, 1, () => save(page, false));
  return JSON.parse(unzipped(Object.values(files)[0])['project.json']);
}

test('a different file with the name of a measured photo replaces nothing until the user answers', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page, project());
    await drop(page, [scratch('DSC_0001.JPG', other)]);
    await asked(page);
    assert.match(await page.textContent('.asking'), /1 file has the name of a photo of this project, but other contents: DSC_0001\.JPG/);
    assert.equal(await page.locator('.asking').getByRole('button', { name: 'The same photos' }).count(), 0);
    assert.match(await page.textContent('.problems'), /DSC_0001\.JPG.*attached only if you choose so/);
    await pictures(page, 'photos-differ');
    assert.equal(await tiles(page), 2);
    assert.equal((await saved(page)).observations.length, 3);

    // Closed without an answer: nothing changes, and the file can be dropped again.
    await page.keyboard.press('Escape');
    assert.equal(await tiles(page), 2);
    await drop(page, [scratch('dsc_0001.jpg', other)]);
    await asked(page);
    await answer(page, 'Add as new photos');
    await idle(page);
    assert.equal(await tiles(page), 3);
    let now = await saved(page);
    assert.deepEqual(now.photos.map((p) => [p.id, p.sha256]), [['1', sha256(measured)], ['2', sha256(third)], ['3', sha256(other)]]);
    assert.equal(now.observations.length, 3);
    await page.keyboard.press('Control+z');
    assert.equal(await tiles(page), 2);

    // Replaced: its measurements are deleted; undo restores the photo with its measurements, without a file.
    await drop(page, [scratch('DSC_0001.JPG', png(9))]);
    await asked(page);
    await answer(page, 'Replace, delete measurements');
    await idle(page);
    now = await saved(page);
    assert.equal(now.photos.length, 2);
    assert.equal(now.photos[0].sha256, sha256(png(9)));
    assert.deepEqual(now.observations.map((o) => o.photo), ['2']);
    await page.keyboard.press('Control+z');
    now = await saved(page);
    assert.deepEqual(now.photos.map((p) => p.sha256), [sha256(measured), sha256(third)]);
    assert.equal(now.observations.length, 3);

    // The measured file is recognised under any name; a second copy is refused.
    await drop(page, [scratch('renamed.jpeg', measured), scratch('DSC_0002.jpg', third)]);
    await idle(page);
    assert.equal(await page.locator('.asking').count(), 0);
    assert.equal(await tiles(page), 2);
    await drop(page, [scratch('DSC_0001.JPG', measured)]);
    await page.waitForSelector('.problems li');
    await idle(page);
    assert.match(await page.textContent('.problems'), /same content as/);
    assert.equal(await tiles(page), 2);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('one question covers all measured photos without a recorded digest', longer, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844 });
  try {
    await opened(page, project([]));
    await drop(page, [scratch('DSC_0001.JPG', measured), scratch('DSC_0002.JPG', third)]);
    await asked(page);
    assert.match(await page.textContent('.asking'), /2 files have the name and size of measured photos: DSC_0001\.JPG, DSC_0002\.JPG/);
    await pictures(page, 'photos-unrecorded');
    await answer(page, 'The same photos');
    await idle(page);
    const now = await saved(page);
    assert.deepEqual(now.photos.map((p) => p.sha256), [sha256(measured), sha256(third)]);
    assert.equal(now.observations.length, 3);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a change of unit asks whether to convert; an unknown unit is refused', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  const unit = async (typed) => {
    await page.fill('[name=unit]', typed);
    await page.press('[name=unit]', 'Enter');
  };
  try {
    await opened(page, project());
    await go(page, 'control');
    await unit('banana');
    assert.match(await notice(page), /mm, cm, m, .*"banana"/);
    assert.equal(await page.inputValue('[name=unit]'), 'mm');
    await unit('metres');
    await asked(page);
    assert.match(await page.textContent('.asking'), /in mm\. Convert them to m \(1000 mm become 1 m\), or were they in m all along\?/);
    assert.equal(await page.inputValue('[name=unit]'), 'mm');
    await pictures(page, 'unit');
    await page.locator('.asking button').nth(0).click();
    let now = await saved(page);
    assert.deepEqual([now.unit, now.distances[0].length, now.distances[0].sigma, now.points[0].xyz, now.points[0].sigma], ['m', 0.25, 0.0005, [0.565, 0, 0.0005], [0.00025, 0.00025, null]]);
    await page.keyboard.press('Control+z');
    now = await saved(page);
    assert.deepEqual([now.unit, now.distances[0].length], ['mm', 250]);
    await unit('m');
    await asked(page);
    await page.locator('.asking button').nth(1).click();
    now = await saved(page);
    assert.deepEqual([now.unit, now.distances[0].length, now.points[0].xyz], ['m', 250, [565, 0, 0.5]]);
    await page.keyboard.press('Control+z');
    assert.equal((await saved(page)).unit, 'mm');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a document with an unknown unit opens with a warning and asks before the unit is changed', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page, project([], 'ell'));
    await go(page, 'control');
    assert.match(await page.textContent('[data-unit=unknown]'), /"ell" is not a known unit of length/);
    await pictures(page, 'unit-unknown');
    await page.fill('[name=unit]', 'cm');
    await page.press('[name=unit]', 'Enter');
    await asked(page);
    assert.match(await page.textContent('.asking'), /nothing can be converted\. Are the numbers in cm\?/);
    await answer(page, 'Yes, change the unit');
    const now = await saved(page);
    assert.deepEqual([now.unit, now.distances[0].length], ['cm', 250]);
    assert.equal(await page.locator('[data-unit=unknown]').count(), 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('numbers and tables with two interpretations are asked about', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page, project());
    await go(page, 'control');
    // A typed number: refused with both readings.
    const length = page.locator('[name=distance-length]');
    await length.fill('1,234');
    await length.press('Enter');
    assert.match(await notice(page), /"1,234" is ambiguous: 1\.234 with a decimal comma, 1234 with a thousands separator/);
    assert.equal(await length.inputValue(), '250');
    await length.fill('1,5');
    await length.press('Enter');
    assert.equal(await length.inputValue(), '1.5');

    // A table: each interpretation is a button, and import is disabled until one is chosen.
    const take = page.locator('.panel .button.primary', { hasText: /^Import/ }).first();
    await drop(page, [scratch('control.txt', 'P1\t1,234\t2,345\t3,456\nP2\t4,567\t5,678\t6,789\n')]);
    await page.waitForSelector('[data-asked=decimal]');
    assert.equal(await take.isDisabled(), true);
    await pictures(page, 'decimal');
    await page.locator('[data-asked=decimal]').getByRole('button', { name: '1234', exact: true }).click();
    assert.match(await page.textContent('.preview tr.new'), /1\u2009?234\.0/);
    await page.getByRole('button', { name: 'Discard' }).click();

    await drop(page, [scratch('pnezd.csv', '1,5000.123,3000.456,101.231,TGT\n2,5004.223,3001.112,101.901,NAIL\n')]);
    await page.waitForSelector('[data-asked=axes]');
    assert.match(await page.textContent('.preview tr.new'), /TGT/);
    assert.equal(await take.isDisabled(), true);
    await pictures(page, 'axes');
    await page.locator('[data-asked=axes]').getByRole('button', { name: 'Y, north' }).click();
    assert.equal(await take.isDisabled(), false);
    await take.click();
    const now = await saved(page);
    assert.deepEqual(now.points.find((p) => p.id === '1').xyz, [3000.456, 5000.123, 101.231]);

    // The heading's unit is converted to the project's.
    await drop(page, [scratch('metres.csv', 'id,X [m],Y [m],Z [m],sX [mm],sY [mm],sZ [mm]\nM1,1.5,2.5,3.5,2,2,2\n')]);
    await page.waitForSelector('[data-reading]');
    assert.equal(await page.inputValue('[name=pasted-unit]'), 'm');
    await take.click();
    const point = (await saved(page)).points.find((p) => p.id === 'M1');
    assert.deepEqual([point.xyz, point.sigma], [[1500, 2500, 3500], [2, 2, 2]]);

    // Commas as decimal and as field separators: each row shows why it is refused.
    await drop(page, [scratch('commas.csv', 'P1,1,234,2,345,3,456\nP2,4,567,5,678,6,789\n')]);
    await page.waitForSelector('.preview tr.wrong');
    assert.match(await page.textContent('.preview tr.wrong'), /may separate decimals or thousands too/);
    await pictures(page, 'commas');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
