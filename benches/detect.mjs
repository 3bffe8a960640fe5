// Detection against the physical limit, as wasm in Node on one thread, in the pictures that benches/detect/main.rs paints.
//   cargo xtask bench detect, or node benches/detect.mjs FOLDER
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import * as sightline from '../pkg/sightline.js';
import { tiff } from '../tests/face/tiff.mjs';

const [folder, ...fresh] = process.argv.slice(2);
const index = JSON.parse(readFileSync(join(folder, 'index.json'), 'utf8'));
const samples = (picture) => new Uint8Array(readFileSync(join(folder, `${picture.name}.raw`)));
const of = (part) => index.filter((picture) => picture.part === part);
const start = () => sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });

/** `columns` x `rows` copies of a picture side by side. */
function tiled({ width, height, samples }, columns, rows) {
  const all = new samples.constructor(width * columns * height * rows);
  for (let y = 0; y < height * rows; y++) {
    const row = samples.subarray((y % height) * width, ((y % height) + 1) * width);
    for (let i = 0; i < columns; i++) all.set(row, (y * columns + i) * width);
  }
  return { width: width * columns, height: height * rows, samples: all };
}

/** A part of a picture. */
function cut({ width, samples }, left, top, columns, rows) {
  const part = new samples.constructor(columns * rows);
  for (let y = 0; y < rows; y++) part.set(samples.subarray((top + y) * width + left).subarray(0, columns), y * columns);
  return { width: columns, height: rows, samples: part };
}

const whole = (picture) => ({ width: picture.width, height: picture.height, samples: samples(picture) });
const detect = (p, options) => sightline.detectGray(p.width, p.height, p.samples, options);

/** The pictures of each size in megapixels: every pixel of the 24 is in those of 6 and 12, and they are copies in those above. */
const SIZES = {
  6: (p) => [0, 1, 2, 3].map((k) => cut(p, (k % 2) * 3000, (k >> 1) * 2000, 3000, 2000)),
  12: (p) => [0, 1].map((k) => cut(p, 0, k * 2000, 6000, 2000)),
  24: (p) => [p],
  48: (p) => [tiled(p, 2, 1)],
  96: (p) => [tiled(p, 2, 2)],
};

if (fresh.length) {
  // A process of its own, for one size: the first call, and what memory it took.
  const [size, bits] = fresh.map(Number);
  const [picture] = SIZES[size](whole(of('cluttered')[0]));
  if (bits === 16) picture.samples = Uint16Array.from(picture.samples, (value) => 200 * value);
  const began = performance.now();
  const { memory } = start();
  const before = memory.buffer.byteLength;
  detect(picture);
  const ms = performance.now() - began;
  const pixels = picture.width * picture.height;
  console.log(JSON.stringify({ ms, perPixel: (memory.buffer.byteLength - before - picture.samples.byteLength) / pixels }));
  process.exit();
}

start();
const rms = (values) => Math.sqrt(values.reduce((sum, x) => sum + x * x, 0) / values.length);
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const timed = (action) => {
  const began = performance.now();
  action();
  return performance.now() - began;
};
/** A figure with what is asked of it, and "NO" where it is missed. */
const most = (limit, value, digits = 3) => `${value.toFixed(digits)} (<= ${limit}) ${value <= limit ? '  ' : 'NO'}`;
const least = (limit, value) => `${value} (>= ${limit}) ${value >= limit ? '  ' : 'NO'}`;
const within = (low, high, value) => `${value.toFixed(3)} (${low} to ${high}) ${value >= low && value <= high ? '  ' : 'NO'}`;

/** Rows of { heading: cell } in aligned columns. */
function table(title, rows) {
  const headings = Object.keys(rows[0]);
  const lines = [headings, ...rows.map((row) => headings.map((name) => String(row[name] ?? '')))];
  const widths = headings.map((_, k) => Math.max(...lines.map((line) => line[k].length)));
  console.log(`\n${title}`);
  for (const line of lines) console.log(line.map((cell, k) => cell.padStart(widths[k])).join('  '));
}

/** Who is who: the spots that were hit, with errors in pixels and over their sigmas, and how many targets are none of them. */
function score(targets, spots) {
  const cell = 64;
  const near = new Map();
  targets.forEach((t) => {
    const key = `${Math.floor(t.u / cell)} ${Math.floor(t.v / cell)}`;
    near.set(key, [...(near.get(key) ?? []), t]);
  });
  const used = new Set();
  const hits = [];
  spots.forEach(([u, v, , b], k) => {
    const reach = Math.max(1.5, 0.3 * b);
    const [i, j] = [Math.floor(u / cell), Math.floor(v / cell)];
    const around = [-1, 0, 1].flatMap((di) => [-1, 0, 1].flatMap((dj) => near.get(`${i + di} ${j + dj}`) ?? []));
    const hit = around.filter((t) => Math.hypot(t.u - u, t.v - v) < reach);
    hit.forEach((t) => used.add(t));
    const best = hit.sort((p, q) => Math.hypot(p.u - u, p.v - v) - Math.hypot(q.u - u, q.v - v))[0];
    if (best) hits.push({ k, u, v, du: best.u - u, dv: best.v - v, target: best });
  });
  return {
    hits,
    others: targets.length - used.size,
    errors: hits.flatMap(({ du, dv }) => [du, dv]),
    normalised: hits.flatMap(({ du, dv, target }) => [du / target.sigma_u, dv / target.sigma_v]),
  };
}

/** How far chance moves an rms. */
const chance = (values) => ({ '+-': (rms(values) / Math.sqrt(2 * values.length)).toFixed(3) });

/** Largest mean error over the place within a pixel, as a wave of two harmonics fitted to both axes. */
function bias(hits) {
  const pairs = hits.flatMap(({ u, v, du, dv }) => [[u, du], [v, dv]]);
  const mean = (weight) => pairs.reduce((sum, [place, error]) => sum + error * weight(2 * Math.PI * place), 0) / pairs.length;
  const waves = [1, 2].map((k) => [k, 2 * mean((x) => Math.cos(k * x)), 2 * mean((x) => Math.sin(k * x))]);
  const level = mean(() => 1);
  const curve = Array.from({ length: 100 }, (_, i) => waves.reduce((sum, [k, c, s]) => sum + c * Math.cos((k * i * Math.PI) / 50) + s * Math.sin((k * i * Math.PI) / 50), level));
  return Math.max(...curve.map(Math.abs));
}

const LIMITS = { least_squares: 1.05, ellipse: 1.25 };
const METHODS = ['least_squares', 'ellipse', 'intensity', 'gradient'];

table(
  '1. isolated targets, noise 2, blur 0.7 px, circles of contrast 200, ellipses of 60; bias: its largest value over the place within a pixel',
  of('isolated').flatMap((picture) =>
    Object.entries(LIMITS).map(([method, limit]) => {
      const { hits, others, errors } = score(detect(whole(picture), { method }).targets, picture.spots);
      const bound = rms(picture.bounds);
      return {
        picture: picture.name, method, hits: `${hits.length}/${picture.spots.length}`, others, 'bound px': bound.toFixed(5), 'rms/bound': most(limit, rms(errors) / bound),
        ...chance(errors.map((e) => e / bound)), 'bias/bound': most(0.1, bias(hits) / bound),
      };
    }),
  ),
);

table(
  '2. 2000 random targets of 6 to 60 px, half of them dark on bright; with the medians, which no stray error moves',
  METHODS.map((method) => {
    const scores = of('random').map((picture) => score(detect(whole(picture), { method }).targets, picture.spots));
    const all = scores.flatMap((s) => s.normalised);
    const count = (what) => scores.reduce((sum, s) => sum + what(s), 0);
    return {
      method, hits: count((s) => s.hits.length), others: count((s) => s.others), 'rms of error/sigma': within(0.95, 1.05, rms(all)), ...chance(all),
      'bright, dark': scores.map((s) => rms(s.normalised).toFixed(3)).join(', '), 'by median': (median(all.map(Math.abs)) / 0.6745).toFixed(3), 'beyond 4 sigma': all.filter((e) => Math.abs(e) > 4).length,
    };
  }),
);

const cluttered = of('cluttered');
table(
  '3. 24 megapixels, 200 targets of 8 to 60 px in clutter',
  cluttered.map((picture) => {
    const { hits, others, errors, normalised } = score(detect(whole(picture)).targets, picture.spots);
    const bound = rms(hits.map(({ k }) => picture.bounds[k]));
    return {
      picture: picture.name, hits: least(199, hits.length), others: most(2, others, 0), 'bound px': bound.toFixed(5), 'rms/bound': most(1.3, rms(errors) / bound),
      ...chance(errors.map((e) => e / bound)), 'error/sigma': rms(normalised).toFixed(3),
    };
  }),
);

/** Cold time and memory of a process of its own. */
function apart(size, bits) {
  const { status, stdout, stderr } = spawnSync(process.execPath, [fileURLToPath(import.meta.url), folder, size, bits].map(String), { encoding: 'utf8' });
  if (status !== 0) throw new Error(stderr);
  return JSON.parse(stdout);
}

const picture = whole(cluttered[0]);
const sizes = Object.keys(SIZES).map(Number);
const pictures = sizes.map((size) => SIZES[size](picture));
const warm = sizes.map(() => []);
// In turns, so that what else the machine does meets every size alike.
for (let round = 0; round < 7; round++) pictures.forEach((all, i) => warm[i].push(all.reduce((sum, p) => sum + timed(() => detect(p)), 0) / all.length));
const ms = warm.map(median);
const [x, y] = [sizes, ms].map((values) => values.map(Math.log));
const centre = (values) => values.map((value) => value - values.reduce((a, b) => a + b) / values.length);
const [dx, dy] = [centre(x), centre(y)];
const exponent = dx.reduce((sum, value, i) => sum + value * dy[i], 0) / dx.reduce((sum, value) => sum + value * value, 0);
table(
  '4. time, and memory beyond the decoded picture; no peer runs here, of which 0.30 is asked when warm and 1.0 when cold',
  [...sizes.map((size, i) => [size, 8, ms[i]]), [24, 16]].map(([size, bits, time]) => {
    const colds = [0, 1, 2].map(() => apart(size, bits));
    const cold = median(colds.map((c) => c.ms));
    const row = { megapixels: size, bits, 'warm ms': time?.toFixed(1), 'ms per megapixel': time && (time / size).toFixed(2), 'cold ms': cold.toFixed(1) };
    return { ...row, 'cold/warm': time && (cold / time).toFixed(2), 'bytes a pixel': most(3, colds[0].perPixel, 2) };
  }),
);
console.log(`time grows with megapixels to the power of ${most(1, exponent)}`);

/** Times of clicks a little beside their targets, and how many hit. */
function clicks(name, places, measure = sightline.measureAt) {
  let hit = 0;
  const times = places.map(([photo, u, v]) => timed(() => (hit += measure(photo, u + 1, v - 1) ? 1 : 0)));
  const sorted = times.sort((a, b) => a - b);
  return { what: name, clicks: places.length, hits: hit, 'median ms': most(5, median(times), 2), '95 % ms': most(5, sorted[Math.floor(0.95 * sorted.length)], 2), 'worst ms': most(5, sorted.at(-1), 2) };
}
const around = cluttered[0].spots.map(([u, v]) => {
  const [left, top] = [u - 150, v - 150].map((place, i) => Math.floor(Math.min(Math.max(place, 0), [picture.width, picture.height][i] - 300)));
  const part = cut(picture, left, top, 300, 300);
  return [tiff(part.width, part.height, part.samples), u - left, v - top];
});
clicks('warm up', around);
const file = tiff(picture.width, picture.height, picture.samples);
const decoded = ({ width, height, samples }, u, v) => sightline.measureAtGray(width, height, samples, u, v);
table('4. measureAt for one click', [
  clicks('in a picture of 300 x 300', around),
  clicks('in 24 megapixels that are decoded', cluttered[0].spots.slice(0, 100).map(([u, v]) => [picture, u, v]), decoded),
  clicks('in a file of 24 megapixels, which is decoded each time', cluttered[0].spots.slice(0, 40).map(([u, v]) => [file, u, v])),
]);
