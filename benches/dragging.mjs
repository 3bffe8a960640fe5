// Dragging a station of a plan with 20 photos and 200 points: time from the pointer's move to every prediction of it on the page, and
// the longest task of the page's own thread.
//   cd e2e && npm ci; cd ..; node benches/dragging.mjs [--moves 40] dist [OTHER/dist ...]
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

import { served } from './served.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { moves: { type: 'string', default: '40' } } });
const builds = positionals.length ? positionals : ['dist'];
process.env.CHROMIUM ??= 'chromium';

// A plate of 20 x 10 targets and 20 photos from five places at four rolls, with a camera that is calibrated by them.
const points = Array.from({ length: 200 }, (_, k) => ({
  id: `${k + 1}`,
  xyz: [(k % 20) * 50 - 475, 0, Math.floor(k / 20) * 50 - 225],
  role: 'tie',
  normal: [0, -1, 0],
  diameter: 12,
}));
const places = [[0, -1400, 0], [-900, -1100, 300], [900, -1100, 300], [-800, -1100, -400], [800, -1100, -400]];
const stations = Array.from({ length: 20 }, (_, k) => ({
  id: `${k + 1}`,
  position: places[k % 5].map((x, axis) => x + 20 * (Math.floor(k / 5) - 1.5) * (axis === 1 ? 1 : 0.7)),
  look_at: [0, 0, 0],
  roll: (Math.floor(k / 5) * Math.PI) / 2,
}));
const zero = Object.fromEntries(['x0', 'y0', 'k1', 'k2', 'k3', 'p1', 'p2', 'b1', 'b2'].map((name) => [name, 0]));
const free = ['c', 'x0', 'y0', 'k1', 'k2', 'k3', 'p1', 'p2'];
const camera = { id: 'camera', width: 6000, height: 4000, pixel_pitch: [0.006, 0.006], model: 'brown', c: 24, ...zero, free };
const plan = { cameras: [camera], points, stations, datum: { kind: 'free' }, wanted: { precision: 0.02, probability: 0.95 } };
const folder = mkdtempSync(join(tmpdir(), 'sightline-dragging-'));
const file = join(folder, 'plan.json');
writeFileSync(file, JSON.stringify({ format: 'sightline', version: 1, name: 'Plan', unit: 'mm', plan }));

const { open } = await import('../e2e/browser.mjs');
const { drop } = await import('../e2e/desk.mjs');
const median = (all) => all.toSorted((a, b) => a - b)[Math.floor(all.length / 2)];

async function measured(dist) {
  const server = await served(dist);
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    await drop(page, [file]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Plan');
    await page.click('.mark');
    await page.click('[data-open="plan"]');
    await page.waitForSelector('.verdict .figure', { timeout: 60_000 });
    const view = page.locator('.plan-view').first();
    const d = await view.locator('[data-station="2"] path').getAttribute('d');
    const [, x, y] = /^M([-\d.]+) ([-\d.]+)/.exec(d).map(Number);
    const box = await view.boundingBox();
    const [, , width] = (await view.getAttribute('viewBox')).split(' ').map(Number);
    const scale = box.width / width;
    const at = [box.x + x * scale, box.y + y * scale];
    await page.evaluate(() => {
      window.tasks = [];
      new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: 'longtask' });
    });
    await page.mouse.move(...at);
    await page.mouse.down();
    const times = [];
    for (let k = 1; k <= Number(values.moves); k++) {
      // From the event to the frame after the verdict changed.
      const changed = page.evaluate(() => new Promise((resolve) => {
        let began = 0;
        addEventListener('pointermove', (event) => (began = event.timeStamp), { once: true, capture: true });
        const observer = new MutationObserver((changes) => {
          if (!began || !changes.some(({ target }) => target.classList.contains('ellipse'))) return;
          observer.disconnect();
          requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - began)));
        });
        // Ellipses change with the prediction alone, the rest with the pointer too.
        observer.observe(document.querySelector('.plan-view'), { subtree: true, attributes: true, attributeFilter: ['rx', 'ry', 'd'] });
      }));
      await page.waitForTimeout(30);
      await page.mouse.move(at[0] + 2 * k, at[1] + (k % 3));
      times.push(await changed);
      await page.waitForTimeout(120);
    }
    await page.mouse.up();
    const tasks = await page.evaluate(() => window.tasks);
    return { median: median(times), slowest: Math.max(...times), longest: Math.max(0, ...tasks), over: tasks.length };
  } finally {
    await close();
    server.close();
  }
}

for (const dist of builds) {
  const { median, slowest, longest, over } = await measured(dist);
  console.log(`${dist}: median ${median.toFixed(0)} ms, slowest ${slowest.toFixed(0)} ms; ${over} tasks over 50 ms, longest ${longest.toFixed(0)} ms`);
}
rmSync(folder, { recursive: true, force: true });
