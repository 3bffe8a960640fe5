// Targets from pixels and from files.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { crc32, deflateSync } from 'node:zlib';

import { data, sightline, skip, thrown } from './engine.mjs';
import { bmp, paletteTiff } from './tiff.mjs';

/** A bright disc on dark ground, its edge averaged over 16 x 16 places a pixel. */
function disc(width, height, u, v, radius, depth) {
  const samples = depth === 16 ? new Uint16Array(width * height) : new Uint8Array(width * height);
  const [low, high] = depth === 16 ? [8000, 50000] : [40, 200];
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      let inside = 0;
      for (let i = 0; i < 256; i++) {
        if (Math.hypot(x + ((i & 15) + 0.5) / 16 - u, y + ((i >> 4) + 0.5) / 16 - v) < radius) inside++;
      }
      samples[y * width + x] = Math.round(low + ((high - low) * inside) / 256);
    }
  }
  return samples;
}

test('a disc is measured where it is, in 8 and in 16 bits, by every method', () => {
  // An edge without blur is more than the gradient can stand on; the others hardly notice.
  const methods = { least_squares: 0.01, ellipse: 0.02, intensity: 0.05, gradient: 0.2 };
  for (const depth of [8, 16]) {
    for (const [method, tolerance] of Object.entries(methods)) {
      const found = sightline.detectGray(80, 60, disc(80, 60, 41.3, 28.8, 9.5, depth), { method });
      assert.deepEqual([found.width, found.height, found.bits, found.targets.length], [80, 60, depth, 1], method);
      const [target] = found.targets;
      assert.ok(Math.hypot(target.u - 41.3, target.v - 28.8) < tolerance, `${method}: ${target.u}, ${target.v}`);
      assert.ok(Math.abs(target.major - 19) < 0.3 && target.polarity === 'bright' && target.code === null);
      assert.ok(target.sigma_u > 0 && target.sigma_v > 0);
      const clicked = sightline.measureAtGray(80, 60, disc(80, 60, 41.3, 28.8, 9.5, depth), 39, 30, { method });
      assert.ok(Math.hypot(clicked.u - target.u, clicked.v - target.v) < 0.05 * target.sigma_u, `${method}: ${clicked.u}, ${clicked.v}`);
      assert.equal(sightline.measureAtGray(80, 60, disc(80, 60, 41.3, 28.8, 9.5, depth), 10, 10, { method }), null);
    }
  }
  const dark = disc(80, 60, 41.3, 28.8, 9.5, 8).map((value) => 255 - value);
  assert.equal(sightline.detectGray(80, 60, dark).targets[0].polarity, 'dark');
  assert.equal(sightline.detectGray(80, 60, dark, { polarity: 'bright' }).targets.length, 0);
});

test('a disc is found in a BMP and in a TIFF with a palette, of every depth', () => {
  const samples = disc(80, 60, 41.3, 28.8, 9.5, 8);
  const files = [bmp(80, 60, samples), ...[1, 2, 4, 8].map((bits) => paletteTiff(80, 60, samples, bits))];
  // Pixels of two levels alone stand up to half a pixel off.
  [0.01, 0.2, 0.1, 0.05, 0.01].forEach((tolerance, i) => {
    const { width, height, bits } = sightline.photoInfo(files[i]);
    assert.deepEqual([width, height, bits], [80, 60, 8]);
    const { targets } = sightline.detect(files[i]);
    assert.equal(targets.length, 1, `file ${i}`);
    assert.ok(Math.hypot(targets[0].u - 41.3, targets[0].v - 28.8) < tolerance, `file ${i}: ${targets[0].u}, ${targets[0].v}`);
  });
});

/** A PNG of 8 or 16 bits a sample, of one or of four, with the chunks before its data. */
function png(width, height, bits, samples, rows, before = []) {
  const chunk = (kind, content) => {
    const named = Buffer.concat([Buffer.from(kind, 'latin1'), content]);
    const file = Buffer.alloc(named.length + 8);
    file.writeUInt32BE(content.length, 0);
    file.set(named, 4);
    file.writeUInt32BE(crc32(named), named.length + 4);
    return file;
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([bits, samples === 4 ? 6 : 0], 8);
  const chunks = [['IHDR', head], ...before, ['IDAT', deflateSync(rows)], ['IEND', Buffer.alloc(0)]];
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), ...chunks.map(([kind, content]) => chunk(kind, content))]);
}

test('small files that claim much are refused, and profiles are not unpacked, before memory is taken', () => {
  const memory = () => sightline.initSync().memory.buffer.byteLength;
  const samples = disc(80, 60, 41.3, 28.8, 9.5, 8);
  sightline.detectGray(80, 60, samples);
  const before = memory();
  // 15600 rows of 16000 pixels, baseline, grey, in 2.4 kB.
  const jpeg = Buffer.alloc(2400, 0x55);
  jpeg.set(Buffer.from('ffd8ffc0000b083cf03e8001011100ffda0008010100003f00', 'hex'));
  const vast = png(15800, 15800, 16, 4, Buffer.alloc(0));
  assert.ok(vast.length < 100);
  for (const file of [jpeg, vast]) {
    for (const action of [() => sightline.photoInfo(file), () => sightline.detect(file)]) {
      const error = thrown(action);
      assert.equal(error.code, 'broken_image', error.message);
      assert.match(error.message, /1(6000 x 15600|5800 x 15800)/);
    }
  }
  const rows = Buffer.alloc(81 * 60);
  for (let y = 0; y < 60; y++) rows.set(samples.subarray(80 * y, 80 * (y + 1)), 81 * y + 1);
  const profile = Buffer.concat([Buffer.from('name\0\0', 'latin1'), deflateSync(Buffer.alloc(1 << 28))]);
  const bomb = png(80, 60, 8, 1, rows, [['iCCP', profile]]);
  const { width, height, bits } = sightline.photoInfo(bomb);
  assert.deepEqual([width, height, bits], [80, 60, 8]);
  const [target] = sightline.detect(bomb).targets;
  assert.ok(Math.hypot(target.u - 41.3, target.v - 28.8) < 0.01, `${target.u}, ${target.v}`);
  assert.ok(memory() - before < 16 << 20, `${(memory() - before) >> 20} MB`);
});

test('the outer rim of a donut is the target, its hole a property', () => {
  const outer = disc(90, 80, 45.3, 39.8, 22, 8);
  const hole = disc(90, 80, 46.1, 39.8, 8, 8);
  const samples = outer.map((level, i) => level - hole[i] + 40);
  const { targets } = sightline.detectGray(90, 80, samples);
  assert.equal(targets.length, 1);
  const [{ u, v, major, inner }] = targets;
  assert.ok(Math.hypot(u - 45.3, v - 39.8) < 0.02 && Math.abs(major - 44) < 0.2, `${u}, ${v}, ${major}`);
  assert.ok(Math.hypot(inner.u - 46.1, inner.v - 39.8) < 0.03 && Math.abs(inner.major - 16) < 0.2, JSON.stringify(inner));
  assert.equal(inner.off_centre, true);
  assert.equal(sightline.detectGray(80, 60, disc(80, 60, 41.3, 28.8, 9.5, 8)).targets[0].inner, undefined);
});

test('what is rejected is shown where it is, with its reason', () => {
  const detected = () => {
    const samples = disc(120, 60, 31.3, 28.8, 9.5, 8);
    for (let y = 20; y < 40; y++) samples.fill(200, y * 120 + 80, y * 120 + 100);
    return sightline.detectGray(120, 60, samples);
  };
  const found = detected();
  assert.equal(found.targets.length, 1);
  const blobs = found.rejected_blobs;
  assert.ok(blobs.some(({ u, v, reason }) => Math.hypot(u - 90, v - 30) < 1 && reason === 'not_an_ellipse'), JSON.stringify(blobs));
  for (const { reason, u, v, diameter } of blobs) {
    assert.ok([u, v, diameter].every(Number.isFinite));
    assert.ok(blobs.filter((blob) => blob.reason === reason).length <= found.rejected[reason], reason);
  }
  assert.deepEqual(structuredClone(detected()).rejected_blobs, blobs);
  assert.deepEqual(JSON.parse(JSON.stringify(detected())).rejected_blobs, blobs);
});

test('what is no picture, no size and no option is named', () => {
  const samples = new Uint8Array(12);
  const cases = [
    [() => sightline.detectGray(4, 4, samples), 'samples'],
    [() => sightline.detectGray(0, 0, new Uint8Array(0)), 'samples'],
    [() => sightline.detectGray('4', 3, samples), 'width'],
    [() => sightline.detectGray(4, -3, samples), 'height'],
    [() => sightline.detectGray(4, 2.5, samples), 'height'],
    [() => sightline.detectGray(4, 3, [...samples]), 'samples'],
    [() => sightline.detectGray(4, 3, new Float32Array(12)), 'samples'],
    [() => sightline.detectGray(4, 3, samples, { min_diametre: 3 }), 'min_diametre'],
    [() => sightline.detectGray(4, 3, samples, { method: 'magic' }), 'method'],
    [() => sightline.detectGray(4, 3, samples, { min_diameter: NaN }), 'min_diameter'],
    [() => sightline.detectGray(4, 3, samples, { max_diameter: 'large' }), 'max_diameter'],
    [() => sightline.detectGray(4, 3, samples, { min_diameter: -1 }), 'min_diameter'],
    [() => sightline.detectGray(4, 3, samples, []), 'options'],
    [() => sightline.detectGray(4, 3, samples, 'fast'), 'options'],
    [() => sightline.detect('a.jpg'), 'bytes'],
    [() => sightline.measureAt(samples, 'left', 0), 'u'],
    [() => sightline.measureAtGray(4, 3, samples, 9, 1), 'u'],
    [() => sightline.measureAtGray(4, 2, samples, 1, 1), 'samples'],
  ];
  for (const [action, field] of cases) {
    const error = thrown(action);
    assert.deepEqual([error.code, error.where.field], ['invalid', field], `${action}: ${error.message}`);
  }
  assert.equal(thrown(() => sightline.detect(new Uint8Array(0))).code, 'unknown_image_format');
  assert.equal(thrown(() => sightline.detect(new TextEncoder().encode('no picture'))).code, 'unknown_image_format');
  assert.deepEqual(sightline.detectGray(4, 3, samples, undefined), sightline.detectGray(4, 3, samples, null));
});

test('photographs: dots of a calibration sheet, codes of a panel', { skip }, () => {
  const sheet = data('camcal/photos/P8250021.JPG');
  const info = sightline.photoInfo(sheet);
  assert.deepEqual([info.width, info.height, info.bits], [2272, 1704, 8]);
  assert.match(info.model, /C4040Z/);
  const dots = sightline.detect(sheet, { channel: 'green' });
  assert.ok(dots.targets.filter((target) => target.polarity === 'dark').length >= 90, `${dots.targets.length} targets`);
  const near = sightline.measureAt(sheet, 1429, 1456, { channel: 'green' });
  assert.ok(Math.hypot(near.u - 1429.1871, near.v - 1456.4278) < 0.3);
  assert.equal(sightline.measureAt(sheet, 20, 20, { channel: 'green' }), null);
  assert.deepEqual(dots.damaged_rows, []);
  const [[first, last], ...others] = sightline.detect(sheet.subarray(0, sheet.length / 2)).damaged_rows;
  assert.ok(first > 400 && first < 1300, `damaged from row ${first}`);
  assert.deepEqual([last, others], [1704, []]);

  const photos = ['043_0005_Scaled.tif', '043_0021_Scaled.tif'].map((name) => {
    const { targets } = sightline.detect(data(`panel/${name}`), { codes: 'ring-14' });
    return { photo: name, targets };
  });
  const coded = sightline.nameCoded(photos);
  assert.ok(coded.points.length >= 40, `${coded.points.length} codes`);
  const both = coded.observations.filter(({ photo }) => photo === photos[0].photo).map(({ point }) => point);
  assert.equal(new Set(both).size, both.length, 'a code stands once in a photo');
  const marks = coded.observations.map(({ photo, point, u, v }) => ({ photo, point, u: u + 0.7, v: v - 0.4, sigma: 0.5 }));
  const snapped = sightline.snapMarks(marks, photos, 3);
  assert.deepEqual(snapped.observations.map(({ u, v }) => [u, v]), coded.observations.map(({ u, v }) => [u, v]));
  const cut = data('panel/043_0005_Scaled.tif').subarray(0, 5000);
  assert.equal(thrown(() => sightline.detect(cut)).code, 'broken_image');
});

test('boards of circles: names, coordinates, and why a photo has none', () => {
  const target = (id, u, v) => ({
    id, u, v, sigma_u: 0.02, sigma_v: 0.02, major: 16, minor: 15.2, angle: 1.5, contrast: 100, polarity: 'dark', code: null, quality: {},
  });
  // 7 rows of 4 dots, every other one shifted, in a photo turned by a right angle
  const places = Array.from({ length: 28 }, (_, k) => [2 * (k % 4) + (Math.floor(k / 4) % 2), Math.floor(k / 4)]);
  const seen = places.map(([x, y], k) => target(k + 1, 400 - 30 * y, 100 + 31 * x));
  const project = sightline.importProject('sightline', { 'project.json': JSON.stringify({ format: 'sightline', version: 1 }) });
  const board = { rows: 7, columns: 4, pitch: 20, kind: 'asymmetric', sigma: 0.05, diameter: 10 };
  const photos = [{ photo: 'a', targets: seen }, { photo: 'b', targets: seen.slice(0, 4) }];
  const naming = sightline.nameGrid(project, photos, board);
  assert.deepEqual(naming.named.map(({ photo, dots, missing, orientation }) => [photo, dots, missing, orientation]), [['a', 28, 0, 'unique']]);
  assert.deepEqual(naming.unnamed.map(({ photo, reason }) => [photo, reason.kind]), [['b', 'no_grid']]);
  const last = naming.points.at(-1);
  assert.deepEqual([last.id, last.role, last.xyz, last.diameter], ['r7c4', 'control', [120, 120, 0], 10]);
  for (const { point, target: id } of naming.observations) {
    const [, row, column] = point.match(/^r(\d+)c(\d+)$/).map(Number);
    assert.equal(id, 4 * (row - 1) + column);
  }
  // A part of a larger board, which fits in several places, is not guessed.
  const part = sightline.nameGrid(project, photos, { ...board, rows: 11, columns: 6 });
  assert.deepEqual([part.named, part.unnamed[0].reason.kind], [[], 'ambiguous']);
  const error = thrown(() => sightline.nameGrid(project, photos, { ...board, rows: 2 }));
  assert.deepEqual([error.code, error.where.field], ['invalid', 'rows']);
});
