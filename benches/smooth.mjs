// What the page's own thread is held up by, and how evenly a photo moves: the tasks over 50 ms while 20 photos of 24 megapixels are taken in
// and their targets found, while 100,000 observations are sorted and filtered, and while a large network is adjusted; then the frames of
// zooming and moving in a photo of 24 megapixels with 500 targets.
//   cd e2e && npm ci; cd ..; python3 ../shared/bench/problems.py OUT P3; node benches/smooth.mjs [--count 20] [--network OUT/P3.json] [dist]
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { copied, drawn } from './drawn.mjs';
import { served } from './served.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { count: { type: 'string', default: '20' }, network: { type: 'string' } },
});
const [dist = 'dist'] = positionals;
process.env.CHROMIUM ??= 'chromium';
const [WIDTH, HEIGHT] = [6000, 4000];
/** 500 targets, a grid. */
const DOTS = Array.from({ length: 500 }, (_, k) => ({ u: 240 + 230 * (k % 25), v: 180 + 190 * Math.floor(k / 25) }));
const server = await served(dist);
const { open } = await import('../e2e/browser.mjs');
const { adjust, detect, drop, go, idle, photos } = await import('../e2e/desk.mjs');
const folder = mkdtempSync(join(tmpdir(), 'sightline-smooth-'));
const median = (all) => all.toSorted((a, b) => a - b)[Math.floor(all.length / 2)];

/** Runs an action on the page, and returns the tasks of its thread that took over 50 ms. */
async function watched(page, name, work) {
  await page.evaluate(() => {
    window.tasks = [];
    window.watching?.disconnect();
    window.watching = new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map((entry) => Math.round(entry.duration))));
    window.watching.observe({ type: 'longtask' });
  });
  const began = performance.now();
  const result = await work();
  // The observer is told after the task.
  await page.waitForTimeout(300);
  const tasks = (await page.evaluate(() => window.tasks)).sort((a, b) => b - a);
  console.log(`${name}: ${((performance.now() - began) / 1000).toFixed(1)} s, ${tasks.length} tasks over 50 ms${tasks.length ? `, the longest ${tasks.slice(0, 8).join(', ')} ms` : ''}`);
  return result;
}

/** Begins to note the frames; ended, their times apart in ms. */
const frames = (page) => page.evaluate(() => {
  window.frames_ = [];
  const step = (time) => {
    window.frames_?.push(time);
    if (window.frames_) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
});
async function rate(page, name, work) {
  await frames(page);
  await watched(page, name, work);
  const times = await page.evaluate(() => {
    const all = window.frames_;
    window.frames_ = undefined;
    return all.slice(1).map((time, k) => time - all[k]);
  });
  const between = median(times);
  console.log(`  ${times.length} frames, median ${between.toFixed(1)} ms (${(1000 / between).toFixed(1)} a second), nine tenths within ${times.toSorted((a, b) => a - b)[Math.floor(0.9 * times.length)].toFixed(1)} ms`);
}

async function largePhotos() {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    const original = await drawn(page, { width: WIDTH, height: HEIGHT, seed: 1, dots: DOTS });
    const paths = Array.from({ length: Number(values.count) }, (_, k) => {
      const path = join(folder, `photo${k}.jpg`);
      writeFileSync(path, copied(original, `photo${String(k).padStart(3, '0')}`));
      return path;
    });
    await page.waitForTimeout(1000);
    await watched(page, `${paths.length} photos taken`, () => photos(page, paths));
    await watched(page, 'their targets found', () => detect(page, {}));
    const box = await page.locator('canvas.photo').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.waitForTimeout(1500);
    await rate(page, 'zoom', async () => {
      for (let k = 0; k < 60; k++) {
        await page.mouse.wheel(0, k < 30 ? -100 : 100);
        await page.waitForTimeout(16);
      }
    });
    for (let k = 0; k < 8; k++) await page.mouse.wheel(0, -100);
    await page.waitForTimeout(1500);
    await rate(page, 'move', async () => {
      await page.mouse.down({ button: 'middle' });
      for (let k = 0; k < 90; k++) {
        await page.mouse.move(box.x + box.width / 2 + 250 * Math.sin(k / 9), box.y + box.height / 2 + 150 * Math.sin(k / 14));
        await page.waitForTimeout(16);
      }
      await page.mouse.up({ button: 'middle' });
    });
  } finally {
    await close();
  }
}

async function table() {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    const photos = Array.from({ length: 100 }, (_, k) => ({ id: `${k + 1}`, camera: 'c', file: '', enabled: true }));
    const points = Array.from({ length: 1000 }, (_, k) => ({ id: `p${k + 1}` }));
    const observations = photos.flatMap((photo, i) =>
      points.map((point, k) => ({ photo: photo.id, point: point.id, u: (k * 37 + i * 11) % 4000, v: (k * 53 + i) % 3000, sigma: 0.1, enabled: k % 100 > 0 })));
    const cameras = [{ id: 'c', width: 4000, height: 3000, model: 'opencv', fx: 3000, fy: 3000, cx: 2000, cy: 1500, k1: 0, k2: 0, p1: 0, p2: 0, k3: 0, skew: 0 }];
    const file = join(folder, 'many.json');
    writeFileSync(file, JSON.stringify({ format: 'sightline', version: 1, name: 'many', unit: 'mm', cameras, photos, points, observations, distances: [] }));
    await watched(page, '100,000 observations opened', async () => {
      await drop(page, [file]);
      await page.waitForFunction(() => document.title.startsWith('many'), undefined, { timeout: 120_000 });
      await idle(page);
    });
    await page.waitForTimeout(2000);
    await watched(page, 'the table shown', async () => {
      await page.click('.to-tables');
      await page.locator('.tabs button', { hasText: 'Observations' }).first().click();
      await page.waitForSelector('.sheet tr.data');
    });
    await watched(page, 'sorted by three columns, both ways', async () => {
      for (const column of [2, 2, 1, 1, 0, 0]) {
        await page.locator('.sheet th button').nth(column).click();
        await page.waitForTimeout(400);
      }
    });
    await watched(page, 'filtered by text and condition', async () => {
      for (const text of ['p9', 'p99', 'p999', '', 'no such']) {
        await page.fill('[name=filter]', text);
        await page.waitForTimeout(300);
      }
      await page.fill('[name=filter]', '');
      for (const condition of ['Excluded', 'All']) {
        await page.click(`[data-condition=${condition}]`);
        await page.waitForTimeout(300);
      }
    });
    await page.locator('.sheet-frame').hover();
    await rate(page, 'scrolled', async () => {
      for (let k = 0; k < 90; k++) {
        await page.mouse.wheel(0, 800);
        await page.waitForTimeout(16);
      }
    });
  } finally {
    await close();
  }
}

async function network() {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await watched(page, 'the network opened', async () => {
      await drop(page, [values.network]);
      await page.waitForSelector('.project-name', { timeout: 120_000 });
      await page.waitForSelector('[data-step=adjust]', { timeout: 120_000 });
      await idle(page);
    });
    await page.waitForTimeout(2000);
    await go(page, 'adjust');
    await watched(page, 'adjusted, results shown', () => adjust(page));
  } finally {
    await close();
  }
}

try {
  await largePhotos();
  await table();
  if (values.network) await network();
} finally {
  rmSync(folder, { recursive: true, force: true });
  server.close();
}
