// From photos dropped on the page to all their targets, of several builds of the page in turns.
//   cd e2e && npm ci; cd ..; node benches/intake.mjs --photo DIR/det1.camera.jpg --count 20 --rounds 3 dist OTHER/dist
// The photo comes from bench/detect/photos.py; copies of it differ by a comment, so that none is taken for another.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { copied } from './drawn.mjs';
import { served } from './served.mjs';

const { values, positionals: builds } = parseArgs({
  allowPositionals: true,
  options: { photo: { type: 'string' }, count: { type: 'string', default: '20' }, rounds: { type: 'string', default: '3' } },
});
if (!values.photo || !builds.length) {
  console.error('usage: intake.mjs --photo PHOTO.jpg [--count 20] [--rounds 3] DIST ...');
  process.exit(2);
}
process.env.CHROMIUM ??= 'chromium';

const folder = mkdtempSync(join(tmpdir(), 'sightline-intake-'));
const photo = readFileSync(values.photo);
const paths = Array.from({ length: Number(values.count) }, (_, k) => {
  const path = join(folder, `photo${String(k).padStart(2, '0')}.jpg`);
  writeFileSync(path, copied(photo, `photo${k}`));
  return path;
});

const { open } = await import('../e2e/browser.mjs');
const { go, idle, photos } = await import('../e2e/desk.mjs');

/** Seconds until the photos are taken, and until their targets are found; the targets of all. */
async function measured(dist) {
  const server = await served(dist);
  const { page, close } = await open();
  try {
    await page.waitForSelector('.desk');
    const start = performance.now();
    await photos(page, paths);
    const taken = performance.now();
    await go(page, 'targets');
    // As builds of other days have it too.
    await page.locator('[data-action=detect], .action .primary').first().click();
    await idle(page);
    const end = performance.now();
    const targets = (await page.textContent('main, .desk')).match(/\d[\d\u2009\s]* targets/)?.[0] ?? '?';
    return { taken: (taken - start) / 1000, all: (end - start) / 1000, targets };
  } finally {
    await close();
    server.close();
  }
}

const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];
const runs = builds.map(() => []);
try {
  for (let round = 0; round < Number(values.rounds); round++) {
    for (const [k, dist] of builds.entries()) {
      const run = await measured(dist);
      runs[k].push(run);
      console.log(`${dist}: taken ${run.taken.toFixed(1)} s, all targets ${run.all.toFixed(1)} s (${run.targets})`);
    }
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
const all = runs.map((of) => median(of.map((run) => run.all)));
for (const [k, dist] of builds.entries()) console.log(`${dist}: median ${all[k].toFixed(1)} s, ${(all[k] / all.at(-1)).toFixed(2)} of the last`);
