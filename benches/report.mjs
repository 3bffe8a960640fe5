// The report of 40 photos and 300 points: time from the click on its step to the whole paper on the page, and of the file in Node.
//   cd e2e && npm ci; cd ..; node benches/report.mjs [--runs 5] [dist]
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import * as sightline from '../pkg/sightline.js';
import { served } from './served.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { runs: { type: 'string', default: '5' } } });
process.env.CHROMIUM ??= 'chromium';
sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });

// Two rings of twenty photos around a slab of points.
const points = Array.from({ length: 300 }, (_, k) => ({
  id: `${k + 1}`,
  xyz: [(k % 20) * 40 - 380, Math.floor(k / 20) * 40 - 280, 30 * Math.sin(k)],
  role: k % 60 === 0 ? 'control' : 'tie',
  sigma: k % 60 === 0 ? [0.02, 0.02, 0.02] : null,
}));
const stations = Array.from({ length: 40 }, (_, k) => {
  const [azimuth, height] = [(Math.PI * k) / 10, k < 20 ? 900 : 1500];
  return { id: `photo-${k + 1}`, camera: 'camera', position: [1300 * Math.cos(azimuth), 1300 * Math.sin(azimuth), height], look_at: [0, 0, 0], roll: ((k % 4) * Math.PI) / 2 };
});
const free = ['c', 'x0', 'y0', 'k1', 'k2', 'k3', 'p1', 'p2'];
const camera = { id: 'camera', width: 6000, height: 4000, pixel_pitch: [0.006, 0.006], model: 'brown', c: 24, k1: -1e-4, free };
const distances = [{ from: '1', to: '20', sigma: 0.02 }];
const project = sightline.simulate({ cameras: [camera], points, stations, distances, sigma: 0.1 });
const adjustment = sightline.adjust(project);
const median = (all) => all.toSorted((a, b) => a - b)[Math.floor(all.length / 2)];
const runs = Array.from({ length: Number(values.runs) });

const inNode = runs.map(() => {
  const began = performance.now();
  sightline.exportProject('report', project, adjustment);
  return performance.now() - began;
});
console.log(`Node: ${median(inNode).toFixed(0)} ms; ${project.observations.length} observations`);

const folder = mkdtempSync(join(tmpdir(), 'sightline-report-'));
const file = join(folder, 'project.zip');
writeFileSync(file, Object.values(sightline.exportProject('package', project, adjustment))[0]);
const { open } = await import('../e2e/browser.mjs');
const { drop, go } = await import('../e2e/desk.mjs');
const server = await served(positionals[0] ?? 'dist');
const { page, close } = await open({ width: 1366, height: 768 });
try {
  await page.waitForSelector('.desk');
  await drop(page, [file]);
  await page.waitForSelector('.results', { timeout: 60_000 });
  const onPage = [];
  for (const _ of runs) {
    await go(page, 'results');
    await page.waitForSelector('.results');
    onPage.push(
      await page.evaluate(async () => {
        const began = performance.now();
        document.querySelector('[data-step=report]').click();
        while (document.querySelector('.paper')?.dataset.ready !== 'true') await new Promise(requestAnimationFrame);
        await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
        return performance.now() - began;
      }),
    );
  }
  console.log(`page: ${median(onPage).toFixed(0)} ms, at first ${onPage[0].toFixed(0)} ms`);
} finally {
  await close();
  server.close();
  rmSync(folder, { recursive: true, force: true });
}
