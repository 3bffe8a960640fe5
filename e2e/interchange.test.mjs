// Files of other programs: recognised by content wherever they are dropped, opened or kept, with what was assumed, left out and converted in
// sight; and files for other programs, with what a conversion leaves stated before they are handed over.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, data, downloads, drop, go, goOn, idle, notice, sample, scratch, unzipped, written } from './desk.mjs';

const longer = { timeout: 600_000 };
const folder = data('interchange');
const withFiles = { ...longer, skip: folder ? false : 'no data' };
const file = (name) => join(folder, name);
const korean = (page) => page.getByRole('button', { name: /한국어/ }).click();
const counts = (page) => page.evaluate(() => [...document.querySelectorAll('.steps .figure')].map((one) => one.textContent.trim()));
const origin = (page) => page.waitForSelector('.panel.origin', { timeout: 60_000 });
/** Name of the project in the head. */
const project = (page) => page.inputValue('.project-name');
const files = (page) => page.click('[data-open=files]');

/** A project of one camera and one photo. */
const small = (interior, more = {}) =>
  scratch('small.json', JSON.stringify({ format: 'sightline', version: 1, name: 'Small', cameras: [{ id: 'cam', width: 640, height: 480, free: [], ...interior }], photos: [{ id: 'p', file: 'p.jpg', camera: 'cam' }], ...more }));
const opened = (page, name) => page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted, name, { timeout: 60_000 });

test('a BAL problem under any name opens as a project whose assumptions stay in sight, in both languages and after a reload', withFiles, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [scratch('no ending', readFileSync(file('bal-3-7.txt')))]);
    await origin(page);
    assert.equal(await page.evaluate(() => location.hash), '#photos');
    assert.deepEqual((await counts(page)).slice(0, 1), ['3']);
    const said = () => page.$$eval('.panel.origin [data-assumed]', (all) => all.map((one) => [one.dataset.assumed, one.textContent]));
    const english = await said();
    assert.deepEqual(english.map(([kind]) => kind).sort(), ['ImageSizeFromMeasurements', 'SigmaOnePixel', 'UnitUnknown']);
    assert.match(await page.textContent('.panel.origin .section-head'), /Opened from BAL.*no ending/);
    await korean(page);
    const other = await said();
    assert.ok(other.every(([, text], k) => /[가-힣]/.test(text) && text !== english[k][1]));
    await page.getByRole('button', { name: /English/ }).click();
    await written(page);
    await afresh(page);
    await page.waitForSelector('.desk');
    await page.evaluate(() => (location.hash = '#start'));
    await goOn(page, 'no ending');
    await go(page, 'photos');
    await origin(page);
    // Beside the estimated parameters too, before the adjustment.
    await go(page, 'adjust');
    await origin(page);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a COLMAP model and a Meshroom scene open on any step; what is not kept is counted', withFiles, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [small({ model: 'brown', c: 500 })]);
    await opened(page, 'Small');
    await go(page, 'control');
    await drop(page, [file('small.sfm')]);
    await opened(page, 'small');
    await origin(page);
    assert.match(await page.textContent('.panel.origin [data-ignored]'), /metadata: \d/);
    await go(page, 'targets');
    const cameras = '1 PINHOLE 640 480 500 500 320 240\n';
    const images = '1 1 0 0 0 0 0 5 1 a.jpg\n320 240 7 10 10 -1\n2 1 0 0 0 1 0 5 1 b.jpg\n220 240 7\n';
    const points = '7 0 0 0 255 255 255 0.5 1 0 2 0\n';
    await drop(page, [scratch('cameras.txt', cameras), scratch('images.txt', images), scratch('points3D.txt', points)]);
    await opened(page, 'COLMAP');
    await origin(page);
    assert.match(await page.textContent('.panel.origin [data-ignored]'), /keypoints of no point: 1/);
    await korean(page);
    assert.match(await page.textContent('.panel.origin [data-ignored]'), /점이 없는 특징점: 1/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('camera files go to Equipment with their conversion, and are offered to cameras of the same size', withFiles, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [small({ model: 'opencv', fx: 600, fy: 600, cx: 320, cy: 240 })]);
    await opened(page, 'Small');
    // Thin prisms are terms that no model of the document has.
    const prisms = readFileSync(file('cam0.opencv8.cameramodel'), 'utf8').replace('OPENCV8', 'OPENCV12').replace(/(0\.0500223357),/, '$1, 1e-4, 0, 2e-4, 0,');
    await drop(page, [file('opencv-left.yml'), scratch('cam0.opencv12.cameramodel', prisms)]);
    await page.waitForSelector('[data-known-camera=opencv-left] .calibration');
    assert.equal(await page.evaluate(() => location.hash), '#equipment');
    assert.match(await notice(page), /2 cameras from .*opencv-left\.yml/);
    assert.match(await page.textContent('[data-known-camera=opencv-left]'), /read from OpenCV: opencv-left\.yml/);
    // More terms than the document's model: what the conversion leaves stands beside the camera.
    assert.match(await page.textContent('[data-known-camera="cam0.opencv12"] .conversion'), /OpenCV 12 → \w+, at most [<\d. ]+ px, RMS [<\d. ]+ px/);
    assert.equal(await page.locator('[data-offer]').count(), 1);
    await page.click('[data-offer] [data-use=held]');
    assert.equal(await page.getAttribute('[data-offer] [data-use=held]', 'aria-pressed'), 'true');
    await go(page, 'photos');
    assert.match(await page.textContent('[data-offer]'), /opencv-left/);
    // A camera that fits none is kept and says so.
    await drop(page, [scratch('cameras.txt', readFileSync(file('colmap-cameras.txt')))]);
    await page.waitForFunction(() => document.querySelectorAll('[data-known-camera]').length === 13, undefined, { timeout: 60_000 });
    assert.match(await notice(page), /No camera of the open project has 2832 × 2128 px/);
    assert.equal(await project(page), 'Small');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('damaged files name file and place, and leave the project as it was', withFiles, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    const scene = readFileSync(file('small.sfm'), 'utf8');
    const cut = scratch('cut.sfm', scene.slice(0, scene.length / 2));
    await drop(page, [cut]);
    await page.waitForSelector('.problems li');
    assert.match(await page.textContent('.problems'), /cut\.sfm.*line \d+/s);
    await drop(page, [small({ model: 'brown', c: 500 })]);
    await opened(page, 'Small');
    await go(page, 'control');
    const left = readFileSync(file('opencv-left.yml'), 'utf8');
    const cases = [
      [cut, /cut\.sfm, line \d+/],
      [scratch('fov.yaml', 'cam0:\n  camera_model: pinhole\n  intrinsics: [500, 500, 320, 240]\n  distortion_model: fov\n  distortion_coeffs: [0.9]\n  resolution: [640, 480]\n'), /fov/],
      [scratch('left.yml', left.replace(/cols: 3\s+dt: d\s+data: \[[^\]]*\]/, 'cols: 3\n   dt: d\n   data: [ 1., 2. ]')), /left\.yml/],
      [scratch('page.xml', '<html/>'), /page\.xml/],
    ];
    for (const [path, said] of cases) {
      await drop(page, [path]);
      await page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.notice p')?.textContent ?? ''), said.source, { timeout: 30_000 });
      assert.equal(await page.evaluate(() => location.hash), '#control');
      assert.equal(await project(page), 'Small');
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a camera is written with its difference stated first; more than a pixel is refused until it is accepted', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    // A shear of the axes, for which ROS has no parameter: 0.01 × 320 px at the edge.
    await drop(page, [small({ model: 'brown', c: 500, b2: 0.01 })]);
    await opened(page, 'Small');
    await files(page);
    const row = (format) => page.locator(`[data-group=camera] .file-row:has(> [data-prepare=${format}], > [data-download=${format}])`);
    const ros = page.locator('[data-group=camera] .file-row').nth(1);
    await page.click('[data-group=camera] [data-prepare=ros]');
    await ros.locator('.stated .bad').waitFor();
    assert.match(await ros.locator('.stated .bad').textContent(), /differ by up to [\d.]+ pixels/);
    await page.click('[data-group=camera] [data-convert=ros]');
    await ros.locator('[data-download=ros]').waitFor();
    const line = await ros.locator('.conversion.warn').textContent();
    assert.ok(Number(/at most ([\d.]+) px/.exec(line)[1]) > 1, line);
    const got = await downloads(page, 1, () => page.click('[data-group=camera] [data-download=ros]'));
    assert.match(String(Object.values(got)[0]), /camera_matrix|plumb_bob|rational_polynomial/);
    // Metashape's model has the shear: exact.
    await page.click('[data-group=camera] [data-prepare=agisoft-lens]');
    await row('agisoft-lens').locator('.stated li').first().waitFor();
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('the adjusted sample is written for other programs with its covariance, and read back', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const before = (await counts(page))[0];
    await files(page);
    assert.match(await page.textContent('[data-group=camera] .section-head'), /adjusted, with covariance/);
    await page.click('[data-group=camera] [data-prepare=mrcal]');
    await page.waitForSelector('[data-group=camera] [data-download=mrcal]', { timeout: 120_000 });
    const stated = await page.locator('[data-group=camera] .file-row').nth(3).locator('.stated').textContent();
    assert.match(stated, /at most [<\d. ]+ px, RMS [<\d. ]+ px|exactly/);
    assert.match(stated, /covariance/);
    const camera = await downloads(page, ['cameramodel', 'covariance.json'], () => page.click('[data-group=camera] [data-download=mrcal]'));
    await page.click('[data-group=network] [data-prepare=colmap]');
    await page.waitForSelector('[data-group=network] [data-download=colmap]', { timeout: 120_000 });
    const zip = await downloads(page, 1, () => page.click('[data-group=network] [data-download=colmap]'));
    const model = unzipped(Object.values(zip)[0]);
    assert.deepEqual(Object.keys(model).sort(), ['cameras.txt', 'images.txt', 'interchange.json', 'points3D.txt']);
    // Direct ones are handed over at once.
    const drawing = await downloads(page, 1, () => page.click('[data-group=cad] [data-export=dxf]'));
    assert.match(Object.keys(drawing)[0], /\.dxf$/);

    const [name, content] = Object.entries(camera).find(([one]) => one.endsWith('cameramodel'));
    await drop(page, [scratch(name, content)]);
    await page.waitForSelector('[data-known-camera] .calibration', { timeout: 60_000 });
    await drop(page, ['cameras.txt', 'images.txt', 'points3D.txt'].map((part) => scratch(part, model[part])));
    await origin(page);
    await idle(page);
    assert.equal((await counts(page))[0], before);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
