// Many large photos in one sitting: taken in, measured, adjusted, saved with the project, opened again; the most memory that all processes
// of the browser take together (PSS: what they share is counted once). Photos are dots in noise that Chromium encodes, 24 megapixels each.
//   cd e2e && npm ci; cd ..; node benches/field.mjs [--count 100] [--cores 8] [--photos DIR] DIST
// Marks and control points come as lists, so that all of it is adjusted.
// It fails where the peak is above 1.5 GB.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { copied, drawn } from './drawn.mjs';
import { served } from './served.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { count: { type: 'string', default: '100' }, cores: { type: 'string' }, photos: { type: 'string' }, limit: { type: 'string', default: '1.5' } },
});
const [dist = 'dist'] = positionals;
const COUNT = Number(values.count);
/** Different pictures; the others are these again with another comment, so that none is taken for another. */
const DRAWN = 5;
const [WIDTH, HEIGHT] = [6000, 4000];
process.env.CHROMIUM ??= 'chromium';

const server = await served(dist);
const { open, processes } = await import('../e2e/browser.mjs');
const { adjust, detect, drop, figure, go, idle, photos } = await import('../e2e/desk.mjs');

/** Principal distance in pixels of 5 micrometres. */
const C = 6000;
/** Targets on uneven ground, mm. */
const POINTS = Array.from({ length: 150 }, (_, k) => [170 * ((k % 15) - 7), 170 * (Math.floor(k / 15) - 4.5), 60 * ((7 * k) % 5)]);
/** The given points: the four corners and three more. */
const CONTROL = [0, 14, 135, 149, 22, 67, 112];

/** Where the targets are in one of the pictures: all around, looking down at the middle, each turned another way. */
function projected(seed) {
  const turn = (2 * Math.PI * seed) / DRAWN;
  const place = [1500 * Math.cos(turn), 1500 * Math.sin(turn), 3200];
  const length = Math.hypot(...place);
  const back = place.map((x) => x / length);
  const across = [-Math.sin(turn), Math.cos(turn), 0];
  const up = [back[1] * across[2] - back[2] * across[1], back[2] * across[0] - back[0] * across[2], back[0] * across[1] - back[1] * across[0]];
  const [sin, cos] = [Math.sin(seed), Math.cos(seed)];
  const all = POINTS.map((point, i) => {
    const ray = point.map((x, axis) => x - place[axis]);
    const [x, y, z] = [across, up, back].map((axis) => axis.reduce((sum, a, k) => sum + a * ray[k], 0));
    const [right, above] = [(-C * x) / z, (-C * y) / z];
    return { name: `P${i}`, u: WIDTH / 2 + cos * right - sin * above, v: HEIGHT / 2 - sin * right - cos * above };
  });
  return all.filter(({ u, v }) => Math.min(u, v, WIDTH - u, HEIGHT - v) > 40);
}

/** Photos as files in a folder. */
async function pictures(folder) {
  const paths = Array.from({ length: COUNT }, (_, k) => join(folder, `photo${String(k).padStart(3, '0')}.jpg`));
  if (paths.every(existsSync)) return paths;
  mkdirSync(folder, { recursive: true });
  const { page, close } = await open();
  const originals = [];
  for (let seed = 1; seed <= Math.min(DRAWN, COUNT); seed++) originals.push(await drawn(page, { width: WIDTH, height: HEIGHT, seed, dots: projected(seed) }));
  await close();
  for (const [k, path] of paths.entries()) {
    writeFileSync(path, copied(originals[k % originals.length], `photo${String(k).padStart(3, '0')}`));
  }
  return paths;
}

/** Marks of every photo and the control points, as files. */
function lists(folder) {
  const marks = Array.from({ length: COUNT }, (_, k) => projected(1 + (k % Math.min(DRAWN, COUNT))).map((dot) => `${k + 1}, ${dot.name}, ${dot.u}, ${dot.v}, 0.1`));
  const control = CONTROL.map((i) => [`P${i}`, ...POINTS[i], 0.1, 0.1, 0.1].join(', '));
  const files = [join(folder, 'marks.txt'), join(folder, 'control.txt')];
  writeFileSync(files[0], marks.flat().join('\n'));
  writeFileSync(files[1], ['id, X, Y, Z, sX, sY, sZ', ...control].join('\n'));
  return files;
}

/** Watches the memory of a browser. */
function watch(profile) {
  let most = { total: 0, parts: [] };
  const look = () => {
    const parts = [];
    for (const { pid, command } of processes(profile)) {
      try {
        const pss = Number(/^Pss:\s+(\d+) kB/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))[1]);
        parts.push({ kind: /--type=([a-z-]+)/.exec(command)?.[1] ?? 'browser', bytes: 1024 * pss });
      } catch {
        // It has ended meanwhile.
      }
    }
    const total = parts.reduce((sum, part) => sum + part.bytes, 0);
    if (total > most.total) most = { total, parts };
  };
  const timer = setInterval(look, 150);
  return {
    /** The most since the last time. */
    peak() {
      look();
      const peak = most;
      most = { total: 0, parts: [] };
      return peak;
    },
    end: () => clearInterval(timer),
  };
}

const scratch = mkdtempSync(join(tmpdir(), 'sightline-field-'));
const cores = values.cores && Number(values.cores);
let failed = false;
try {
  const paths = await pictures(values.photos ?? join(scratch, 'photos'));
  const [marks, control] = lists(scratch);
  const size = paths.reduce((sum, path) => sum + statSync(path).size, 0);
  console.log(`${COUNT} photos of ${(WIDTH * HEIGHT) / 1e6} megapixels, ${(size / 1e6).toFixed(0)} MB${cores ? `, ${cores} processors told` : ''}`);
  const { page, profile, url, errors, close } = await open({ cores });
  const memory = watch(profile);
  const phase = async (name, work) => {
    const start = performance.now();
    const result = await work();
    const { total, parts } = memory.peak();
    const kinds = [...new Set(parts.map((part) => part.kind))];
    const by = kinds.map((kind) => `${kind} ${parts.filter((part) => part.kind === kind).map((part) => (part.bytes / 1e6).toFixed(0)).join('+')}`);
    const over = total > 1e9 * Number(values.limit);
    failed ||= over;
    console.log(`${name}: ${((performance.now() - start) / 1000).toFixed(0)} s, peak ${(total / 1e9).toFixed(2)} GB${over ? ' TOO MUCH' : ''} (MB: ${by.join(', ')})`);
    return result;
  };
  const kept = () => page.waitForFunction(() => /^saved \d/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 600_000 });
  const shown = (step) => page.textContent(`[data-step=${step}] .figure`).then((text) => text.trim());
  try {
    await page.waitForSelector('.desk');
    await phase('start', () => page.waitForTimeout(1000));
    await phase('photos taken', () => photos(page, paths));
    await phase('targets detected', () => detect(page, {}));
    await phase('adjusted', async () => {
      await go(page, 'photos');
      for (const [field, value] of [['pitch', 5], ['c', (C * 5) / 1000]]) {
        await page.fill(`[data-field=${field}]`, String(value));
        await page.press(`[data-field=${field}]`, 'Tab');
      }
      await go(page, 'identities');
      await drop(page, [marks]);
      await page.click('.marks .primary', { timeout: 300_000 });
      await go(page, 'control');
      await drop(page, [control]);
      await page.selectOption('[name=pasted-unit]', 'mm').catch(() => {});
      await page.click('.columns .primary');
      await adjust(page);
    });
    const redundancy = await figure(page, 'redundancy');
    console.log(`adjusted with redundancy ${redundancy}, rms ${await figure(page, 'rms-px')} px`);
    assert.ok(redundancy > COUNT * POINTS.length, `${redundancy}`);
    const before = [await shown('photos'), await shown('targets')];
    await phase('kept', kept);
    const file = await phase('saved with photos', async () => {
      const saving = page.waitForEvent('download', { timeout: 600_000 });
      await page.getByRole('button', { name: 'Save with photos', exact: true }).click();
      const to = join(scratch, 'saved.sightline');
      await (await saving).saveAs(to);
      return to;
    });
    assert.ok(statSync(file).size > size);
    await phase('reloaded', async () => {
      await page.goto(url);
      await page.waitForSelector('[data-project]');
      await page.click('[data-project] .do .button');
      await page.waitForSelector('.project-name');
    });
    assert.deepEqual([await shown('photos'), await shown('targets')], before);
    await phase('opened from its file', async () => {
      await page.click('.mark');
      await drop(page, [file]);
      // It has its result.
      await page.waitForFunction(() => location.hash === '#results', undefined, { timeout: 600_000 });
      await idle(page, 1_200_000);
      await kept();
    });
    assert.deepEqual([await shown('photos'), await shown('targets')], before);
    assert.deepEqual(errors, []);
  } finally {
    memory.end();
    await close();
  }
} finally {
  rmSync(scratch, { recursive: true, force: true });
  server.close();
}
process.exitCode = failed ? 1 : 0;
