// Dropped files: their content decides how they are imported, and files that cannot be used are reported where they were dropped.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { data, drop, files, go, idle, notice, photos, sample, scratch } from './desk.mjs';

const folder = data('camcal');
const control = 'id\tX\tY\tZ\nA\t1.5\t2\t0\nB\t3\t2\t0\nC\t3\t9\t0\n';

test('what cannot be read is told on the start page', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open();
  try {
    await drop(page, [scratch('letter.jpg', 'Dear Sir or Madam')]);
    await page.waitForSelector('.problems li');
    assert.match(await page.textContent('.problems'), /letter\.jpg.*JPEG, HEIC, camera RAW, PNG, TIFF or BMP/);
    assert.equal(await page.evaluate(() => location.hash), '#start');
    // It goes when something else is dropped.
    await drop(page, [scratch('nothing.jpg', '')]);
    await page.waitForFunction(() => /nothing\.jpg/.test(document.querySelector('.problems')?.textContent));
    assert.match(await page.textContent('.problems'), /nothing\.jpg.*the file is empty/i);
    assert.doesNotMatch(await page.textContent('.problems'), /letter/);
    await drop(page, [scratch('nothing.txt', ''), scratch('story.txt', 'It was a dark and stormy night;\nthe rain fell in torrents.\n')]);
    await page.waitForFunction(() => document.querySelectorAll('.problems li').length === 2);
    assert.match(await page.textContent('.problems'), /nothing\.txt.*empty/i);
    assert.match(await page.textContent('.problems'), /story\.txt.*neither image measurements.*nor control points/i);
    await drop(page, [scratch('nothing.json', '')]);
    await page.waitForSelector('.notice');
    assert.match(await notice(page), /nothing\.json: the file is empty/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('texts are sorted by what is in them, and only what can be both is asked', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    // Excel's "Unicode text" is UTF-16 with a mark.
    const utf16 = Buffer.concat([Buffer.from([0xff, 0xfe]), Buffer.from(control, 'utf16le')]);
    await go(page, 'photos');
    await drop(page, [scratch('control.txt', utf16)]);
    await page.waitForSelector('.preview tr.new');
    // A list is answered where it was dropped.
    assert.equal(await page.evaluate(() => location.hash), '#photos');
    assert.equal(await page.locator('.import-over .preview tr.new').count(), 3);
    await page.getByRole('button', { name: 'Discard' }).click();
    await go(page, 'results');
    await drop(page, [scratch('marks.txt', 'sample-1,A,100.5,200.5,0.1\nsample-2,A,120.5,220.5,0.1\nsample-2,B,10.5,22.5,0.1\n')]);
    await page.waitForSelector('.panel.marks');
    assert.equal(await page.evaluate(() => location.hash), '#identities');
    await page.getByRole('button', { name: 'Discard' }).click();
    await go(page, 'results');
    await drop(page, [scratch('either.txt', 'sample-1 7 100.5 200.5\nsample-2 7 101.5 201.5\n')]);
    await page.waitForSelector('.asking');
    assert.match(await page.textContent('.asking'), /either\.txt can be read as image measurements.*or as control points/);
    await page.locator('.asking').getByRole('button', { name: 'Control points' }).click();
    await page.waitForSelector('.preview tr.new');
    assert.equal(await page.locator('.asking').count(), 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('photos, marks and control dropped together go where they belong', { skip: folder ? false : 'skipped, no data', timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, [...files(join(folder, 'photos'), '.jpg').slice(0, 3), join(folder, 'markpts.txt'), join(folder, 'camcal-fixed.txt')]);
    await page.waitForSelector('.notice');
    assert.match(await notice(page), /camcal-fixed\.txt contains control points.*markpts\.txt contains image measurements/);
    assert.equal(await page.locator('.tile').count(), 3);
    await go(page, 'identities');
    assert.match(await page.textContent('.panel.marks'), /markpts\.txt/);
    await go(page, 'control');
    assert.equal(await page.locator('.preview tr.new').count(), 4);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** A JPEG with this one as the thumbnail of its EXIF block, and a number behind its end. */
function withThumbnail(whole, thumbnail, number) {
  const long = (value) => [value >>> 24, value >>> 16 & 255, value >>> 8 & 255, value & 255];
  const entry = (tag, value) => [tag >> 8, tag & 255, 0, 4, ...long(1), ...long(value)];
  const header = [...Buffer.from('MM\0*'), ...long(8)];
  const second = [0, 2, ...entry(0x201, 44), ...entry(0x202, thumbnail.length), ...long(0)];
  const block = Buffer.concat([Buffer.from('Exif\0\0'), Buffer.from([...header, 0, 0, ...long(14), ...second]), thumbnail]);
  const length = block.length + 2;
  return Buffer.concat([whole.subarray(0, 2), Buffer.from([0xff, 0xe1, length >> 8, length & 255]), block, whole.subarray(2), Buffer.from([number])]);
}

test('photos are on the page before they are read', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    const jpeg = async (width, height) => Buffer.from(await page.evaluate(async ([width, height]) => {
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext('2d');
      for (let x = 0; x < width; x += width / 8) {
        context.fillStyle = `hsl(${360 * x / width} 80% 50%)`;
        context.fillRect(x, 0, width / 8, height);
      }
      return [...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer())];
    }, [width, height]));
    const [whole, small] = [await jpeg(2400, 1600), await jpeg(160, 107)];
    await page.evaluate(() => {
      window.coming = { most: 0, step: '' };
      new MutationObserver(() => {
        const pictures = document.querySelectorAll('.coming-tile canvas').length;
        if (pictures > window.coming.most) window.coming = { most: pictures, step: location.hash, taken: document.querySelectorAll('.tile').length };
      }).observe(document.body, { childList: true, subtree: true });
    });
    const paths = Array.from({ length: 8 }, (_, k) => scratch(`early${k}.jpg`, withThumbnail(whole, small, k)));
    await photos(page, [...paths, scratch('again.jpg', withThumbnail(whole, small, 3)), scratch('letter.jpg', 'Dear Sir or Madam')]);
    assert.deepEqual(await page.evaluate(() => window.coming), { most: 9, step: '#photos', taken: 0 });
    // Every preview gives way to its photo. The duplicate and the text file are listed as problems.
    assert.equal(await page.locator('.tile').count(), 8);
    assert.equal(await page.locator('.coming-tile').count(), 0);
    assert.equal(await page.locator('.problems li').count(), 2);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** A JPEG whose maker's note says that the camera straightened it. */
function straightened(whole) {
  const [short, long] = [(value) => [value >> 8, value & 255], (value) => [value >>> 24, value >>> 16 & 255, value >>> 8 & 255, value & 255]];
  const entry = (tag, kind, count, value) => [...short(tag), ...short(kind), ...long(count), ...long(value)];
  const first = [...short(2), ...entry(0x10f, 2, 5, 38), ...entry(0x8769, 4, 1, 44), ...long(0)];
  const below = [...short(1), ...entry(0x927c, 7, 30, 62), ...long(0)];
  const note = [...short(2), ...entry(0x2011, 4, 1, 0), ...entry(0x2013, 4, 1, 2), ...long(0)];
  const block = Buffer.from([...Buffer.from('Exif\0\0MM\0*'), ...long(8), ...first, ...Buffer.from('SONY\0\0'), ...below, ...note]);
  return Buffer.concat([whole.subarray(0, 2), Buffer.from([0xff, 0xe1, ...short(block.length + 2)]), block, whole.subarray(2)]);
}

test('what the camera corrected is told, and is another camera\'s', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    const whole = Buffer.from(await page.evaluate(async () => {
      const canvas = new OffscreenCanvas(600, 400);
      canvas.getContext('2d').fillRect(0, 0, 300, 400);
      return [...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer())];
    }));
    await photos(page, [scratch('plain.jpg', whole), scratch('straight.jpg', straightened(whole))]);
    assert.equal(await page.locator('[data-result=corrections]').count(), 1);
    const said = () => page.textContent('[data-result=corrections]');
    assert.match(await said(), /corrected: distortion, if the lens is known \(Sony 0x2013\).*calibrate and measure with the same setting.*not corrected: vignetting \(Sony 0x2011\)/);
    assert.equal(await page.locator('.photos .tiles:has(.tile)').count(), 2, 'two cameras');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
