// The same photo gives the same targets natively and as wasm, the same network the same adjustment: to 1e-9, every number but those of the
// residual patterns.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { compare } from './compare.mjs';
import { dataPath, sightline, skip } from './engine.mjs';
import { tiff } from './tiff.mjs';

/** Output of an example program, built by `cargo xtask test face`, for a file. */
function natively(example, file, options) {
  const folder = process.env.SIGHTLINE_EXAMPLES;
  if (!folder) throw new Error('run these tests with: cargo xtask test face');
  const { status, stdout, stderr, error } = spawnSync(join(folder, example), [file, JSON.stringify(options)], { encoding: 'utf8', maxBuffer: 1 << 28 });
  assert.equal(status, 0, error?.message ?? stderr);
  return JSON.parse(stdout);
}

function check(t, file, options, atLeast) {
  const bytes = readFileSync(file);
  const here = sightline.detect(bytes, options);
  assert.ok(here.targets.length >= atLeast, `${file}: ${here.targets.length} targets`);
  compare(here, natively('targets', file, options), 1e-9, `${file} ${JSON.stringify(options)}`);
  t.diagnostic(`${here.targets.length} targets alike, ${JSON.stringify(options)}`);
}

/** A photo with perspective, distortion, texture and noise: tilted targets with code rings and without, on two faces. */
function photo(bits) {
  const codes = [37, 203, 601, 1193, 2473, 5417];
  const points = Array.from({ length: 48 }, (_, k) => ({
    id: `t${k}`,
    xyz: [70 * ((k % 8) - 3.5) + 5 * Math.sin(3 * k), 70 * (Math.floor(k / 8) - 2.5) + 5 * Math.cos(5 * k), 0],
    normal: [Math.sin(k), 0.7 * Math.cos(2 * k), 1.2],
    diameter: 5 + (k % 7) * 2,
    grey: 0.5 + 0.05 * (k % 8),
    patch: { ratio: k % 8 === 3 ? 3.5 : 2, grey: 0.05 },
    ring: k % 8 === 3 ? { sectors: 14, code: codes[Math.floor(k / 8)] } : null,
  }));
  const camera = { id: 'c', width: 1200, height: 900, pixel_pitch: [0.005, 0.005], model: 'brown', c: 8, k1: 1e-3, p1: 5e-5 };
  const station = { id: 's', camera: 'c', position: [150, -350, 700], look_at: [0, 0, 0], roll: 0.3 };
  const faces = [
    { corner: [-600, -600, 0], along: [1200, 0, 0], across: [0, 1200, 0], grey: 0.3, texture: 0.03, grain: 25 },
    { corner: [-90, 150, 0], along: [180, 0, 0], across: [0, 40, 60], grey: 0.6, texture: 0.05, grain: 9 },
  ];
  const exposure = { psf: 0.8, read_noise: 0.006, seed: 5, bits };
  return sightline.renderPhoto({ cameras: [camera], stations: [station], points, faces, exposure }, 's');
}

test('a rendered photo: every method, codes, 8 and 16 bits', (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-native-'));
  for (const bits of [8, 16]) {
    const { width, height, samples } = photo(bits);
    const file = join(folder, `${bits}.tif`);
    writeFileSync(file, tiff(width, height, samples));
    for (const method of ['least_squares', 'ellipse', 'intensity', 'gradient']) check(t, file, { method, codes: 'auto' }, 30);
  }
});

test('photographs: JPEG in colour, compressed TIFF with codes', { skip }, (t) => {
  for (const name of ['P8250021.JPG', 'P8250030.JPG']) check(t, dataPath(`camcal/photos/${name}`), { channel: 'green' }, 90);
  for (const name of ['043_0005_Scaled.tif', '671_0021_Scaled.tif']) check(t, dataPath(`panel/${name}`), { codes: 'ring-14' }, 40);
});

/** A ring of aimed stations around a dome of points, with control, a distance and noise. */
const network = (model, seed) => ({
  seed,
  cameras: [
    model === 'brown'
      ? { id: 'c', width: 2000, height: 1500, pixel_pitch: [0.005, 0.005], model, c: 10, k1: 2e-4, p1: 1e-5, free: ['c', 'x0', 'y0', 'k1', 'k2', 'p1', 'p2', 'b1'], sigma: { k2: 1e-4 } }
      : { id: 'c', width: 2000, height: 1500, pixel_pitch: [0.005, 0.005], model, fx: 2000, fy: 2000, cx: 1000, cy: 750, k1: -0.01, free: ['f', 'cx', 'cy', 'k1'] },
  ],
  stations: Array.from({ length: 8 }, (_, k) => ({
    id: `s${k}`,
    camera: 'c',
    position: [3000 * Math.cos(k), 3000 * Math.sin(k), 1500 + 200 * k],
    look_at: [0, 0, 0],
    roll: (k * Math.PI) / 2,
  })),
  points: Array.from({ length: 40 }, (_, k) => {
    const [x, y] = [70 * Math.sqrt(k) * Math.cos(2.4 * k), 70 * Math.sqrt(k) * Math.sin(2.4 * k)];
    return { id: `p${k}`, xyz: [x, y, 300 - (x * x + y * y) / 700], diameter: null, ...(k % 9 === 0 && { role: 'control', sigma: [0.05, 0.05, 0.05] }) };
  }),
  distances: [{ from: 'p1', to: 'p7', sigma: 0.01 }],
});

/** An adjustment without its residual patterns and the advice about them, and these. */
function apart({ patterns, advice, ...others }) {
  const about = (one) => one.kind === 'residual_pattern';
  return [
    { ...others, advice: advice.filter((one) => !about(one)) },
    { patterns, advice: advice.filter(about) },
  ];
}

test('networks: every datum, both camera models, robust and with snooping, with gross errors', () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-native-'));
  for (const model of ['brown', 'opencv']) {
    for (const kind of ['control', 'minimal', 'free']) {
      const project = { ...sightline.simulate(network(model, 11)), datum: { kind, points: null } };
      project.observations[17].u += 3;
      project.observations[301].v -= 2;
      const file = join(folder, `${model}-${kind}.json`);
      writeFileSync(file, JSON.stringify(project));
      for (const options of [{}, { robust: 'huber' }, { snooping: true }, { residuals: 'corrected' }]) {
        const [here, patterns] = apart(JSON.parse(JSON.stringify(sightline.adjust(project, options))));
        const [there, expected] = apart(natively('adjust', file, options));
        compare(here, there, 1e-9, `${model} ${kind} ${JSON.stringify(options)}`);
        // What the unknowns leave of a field is the difference of numbers up to 1e5 times as large, which a solution of equations of
        // condition 1e6 gives to 1e-10.
        assert.ok(patterns.patterns.length > 0);
        compare(patterns, expected, 1e-5, `${model} ${kind} ${JSON.stringify(options)} patterns`);
      }
    }
  }
});
