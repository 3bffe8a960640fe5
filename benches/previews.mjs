// From many RAW photos dropped on the page to a picture of each: the embedded previews.
//   cargo run --release --package sightline-codecs --example large -- FOLDER; cd e2e && npm ci; cd ..
//   node benches/previews.mjs --photo FOLDER/large.dng [--count 50] [--rounds 3] [dist]
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { served } from './served.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { photo: { type: 'string' }, count: { type: 'string', default: '50' }, rounds: { type: 'string', default: '3' } },
});
const [dist = 'dist'] = positionals;
if (!values.photo) {
  console.error('usage: previews.mjs --photo LARGE.dng [--count 50] [--rounds 3] [DIST]');
  process.exit(2);
}
process.env.CHROMIUM ??= 'chromium';
const count = Number(values.count);
const folder = mkdtempSync(join(tmpdir(), 'sightline-previews-'));
const photo = readFileSync(values.photo);
// A byte behind the file's own, so that none is taken for another.
const paths = Array.from({ length: count }, (_, k) => {
  const path = join(folder, `shot${String(k).padStart(3, '0')}.dng`);
  writeFileSync(path, Buffer.concat([photo, Buffer.from([k >> 8, k & 255])]));
  return path;
});
const server = await served(dist);
const { open } = await import('../e2e/browser.mjs');
const { drop } = await import('../e2e/desk.mjs');

/** Seconds from the drop until so many tiles have a picture that is not all of one colour. */
async function measured() {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    await page.waitForTimeout(2000);
    const began = performance.now();
    await drop(page, paths);
    const times = await page.evaluate((count) => new Promise((resolve) => {
      const began = performance.now();
      const drawn = (canvas) => {
        if (!canvas.width) return false;
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
        return data.some((level, i) => level !== data[i % 4]);
      };
      let first;
      const look = () => {
        const all = document.querySelectorAll('.tiles canvas');
        if (all.length && first === undefined) first = performance.now() - began;
        if (all.length === count && [...all].every(drawn)) resolve([first, performance.now() - began]);
        else setTimeout(look, 50);
      };
      look();
    }), count);
    return { first: times[0] / 1000, all: (performance.now() - began) / 1000 };
  } finally {
    await close();
  }
}

const runs = [];
try {
  for (let round = 0; round < Number(values.rounds); round++) {
    runs.push(await measured());
    console.log(`first picture ${runs.at(-1).first.toFixed(1)} s, all ${count} after ${runs.at(-1).all.toFixed(1)} s`);
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
  server.close();
}
const all = runs.map((run) => run.all).sort((a, b) => a - b);
console.log(`median ${all[all.length >> 1].toFixed(1)} s`);
