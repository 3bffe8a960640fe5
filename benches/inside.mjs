// A step of "Inside the adjustment" and its redrawing on the page, at 160 and at 2000 unknowns: from the click to the new matrices, unknowns and
// residuals laid out, and to the frame after; and the longest task of the page's own thread meanwhile.
//   cd e2e && npm ci; cd ..; node benches/inside.mjs [--runs 5] [dist]
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { served } from './served.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { runs: { type: 'string', default: '5' } } });
process.env.CHROMIUM ??= 'chromium';
const CASES = [
  { photos: 10, points: 32, rays: 6, free: ['c', 'x0', 'y0', 'k1'], unknowns: 160, limit: 16 },
  { photos: 40, points: 585, rays: 8, free: ['c', 'x0', 'y0', 'k1', 'k2'], unknowns: 2000, limit: 200 },
];

/** Photos on a spiral around a slab of points, each point seen by the `rays` photos nearest to its own side. */
function network({ photos, points, rays, free }) {
  let state = 12345;
  const random = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 2 ** 32;
  const normal = () => Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
  const camera = { id: 'c', width: 8000, height: 6000, pixel_pitch: [0.004, 0.004], model: 'brown', c: 28, free };
  const project = { format: 'sightline', version: 1, name: 'Steps', unit: 'mm', cameras: [camera], photos: [], points: [], observations: [] };
  project.datum = { kind: 'free', points: null };
  const stations = Array.from({ length: photos }, (_, k) => {
    const azimuth = (2 * Math.PI * k) / photos;
    const elevation = 0.6 + 0.6 * ((k * 0.618) % 1);
    const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
    const z = [cos * Math.cos(elevation), sin * Math.cos(elevation), Math.sin(elevation)];
    const [a, b] = [[-sin, cos, 0], [-cos * Math.sin(elevation), -sin * Math.sin(elevation), Math.cos(elevation)]];
    // Every other photo is rolled by a right angle.
    const [x, y] = k % 2 ? [b, a.map((v) => -v)] : [a, b];
    const position = z.map((v) => 1500 * v);
    const rotation = [Math.atan2(-z[1], z[2]), Math.asin(z[0]), Math.atan2(-y[0], x[0])];
    project.photos.push({ id: `f${k}`, camera: 'c', file: '', position: position.map((v) => v + 10 * normal()), rotation, enabled: true });
    return { position, axes: [x, y, z] };
  });
  for (let j = 0; j < points; j += 1) {
    const xyz = [400, 300, 150].map((half) => half * (2 * random() - 1));
    project.points.push({ id: `p${j}`, role: 'tie', xyz: xyz.map((v) => v + 3 * normal()) });
    const first = Math.floor((Math.atan2(xyz[1], xyz[0]) / (2 * Math.PI) + 1) * photos);
    for (let n = 0; n < rays; n += 1) {
      const k = (first + n - (rays >> 1) + photos) % photos;
      const d = xyz.map((v, i) => v - stations[k].position[i]);
      const [x, y, z] = stations[k].axes.map((axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]);
      const [u, v] = [4000 - (7000 * x) / z + 0.1 * normal(), 3000 + (7000 * y) / z + 0.1 * normal()];
      project.observations.push({ photo: `f${k}`, point: `p${j}`, u, v, sigma: 0.1, enabled: true });
    }
  }
  return project;
}

const median = (all) => all.toSorted((a, b) => a - b)[Math.floor(all.length / 2)];
const shown = (all) => `${median(all).toFixed(1)} ms (${Math.min(...all).toFixed(1)} to ${Math.max(...all).toFixed(1)})`;
const server = await served(positionals[0] ?? 'dist');
const { open } = await import('../e2e/browser.mjs');
const { drop } = await import('../e2e/desk.mjs');
const folder = mkdtempSync(join(tmpdir(), 'sightline-inside-'));

for (const one of CASES) {
  const file = join(folder, `${one.unknowns}.json`);
  writeFileSync(file, JSON.stringify(network(one)));
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    await drop(page, [file]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Steps');
    await page.evaluate(() => (location.hash = '#inside'));
    await page.waitForSelector('.steps-taken [data-step-number]', { timeout: 60_000 });
    const counted = await page.textContent('.bar > p');
    if (!counted.replaceAll(/\D+/g, ' ').split(' ').join('').includes(String(one.unknowns))) throw new Error(`not ${one.unknowns} unknowns: ${counted}`);
    const [laid, frames, tasks] = [[], [], []];
    for (let run = 0; run < Number(values.runs); run += 1) {
      // From the start values each time; those of the document are off by about a hundredth.
      await page.selectOption('[name=moved]', run % 2 ? '0.01' : '0.03');
      await page.waitForSelector('.steps-taken li.now[data-step-number="0"]', { timeout: 60_000 });
      for (let step = 1; step <= 3; step += 1) {
        // What follows a step at leisure (the factor, the standard errors) is done.
        await page.waitForTimeout(1500);
        const found = await page.evaluate(async (wanted) => {
          const long = [];
          const observer = new PerformanceObserver((list) => long.push(...list.getEntries().map((entry) => entry.duration)));
          observer.observe({ type: 'longtask' });
          const began = performance.now();
          document.querySelector('[data-action=step]').click();
          const channel = new MessageChannel();
          const turn = () => new Promise((resolve) => { channel.port1.onmessage = resolve; channel.port2.postMessage(0); });
          while (document.querySelector('li.now')?.dataset.stepNumber !== String(wanted)) {
            if (document.querySelector('[data-ended]')) return null;
            await turn();
          }
          document.querySelector('main').getBoundingClientRect();
          const laid = performance.now() - began;
          await new Promise(requestAnimationFrame);
          await turn();
          const frame = performance.now() - began;
          await new Promise((resolve) => setTimeout(resolve, 200));
          observer.disconnect();
          channel.port1.close();
          return { laid, frame, longest: Math.max(0, ...long) };
        }, step);
        if (!found) break;
        laid.push(found.laid);
        frames.push(found.frame);
        tasks.push(found.longest);
      }
    }
    console.log(`${one.unknowns} unknowns, ${laid.length} steps: laid out after ${shown(laid)}, in a frame after ${shown(frames)}, limit ${one.limit} ms; longest task ${Math.max(...tasks).toFixed(0)} ms`);
  } finally {
    await close();
  }
}
server.close();
rmSync(folder, { recursive: true, force: true });
