// How the adjustment grows with the network: milliseconds of an iteration and of the full statistics, as wasm in Node.
//   cargo xtask bench, or node benches/growth.mjs [--plot docs/growth.svg]
import { readFileSync, writeFileSync } from 'node:fs';

import * as sightline from '../pkg/sightline.js';

const { memory } = sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });

/** Photos on a spiral around a slab of points, each point seen by the `rays` photos nearest to its own side. */
function network(photos, points, rays) {
  let state = 12345;
  const random = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 2 ** 32;
  const normal = () => Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
  const camera = { id: 'c', width: 8000, height: 6000, pixel_pitch: [0.004, 0.004], model: 'brown', c: 28 };
  camera.free = ['c', 'x0', 'y0', 'k1', 'k2', 'k3', 'p1', 'p2'];
  const project = { format: 'sightline', version: 1, unit: 'mm', cameras: [camera], photos: [], points: [], observations: [] };
  project.distances = [];
  project.datum = { kind: 'free', points: null };
  const stations = Array.from({ length: photos }, (_, k) => {
    const azimuth = (2 * Math.PI * k) / photos;
    const elevation = 0.6 + 0.6 * ((k * 0.618) % 1);
    const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
    const z = [cos * Math.cos(elevation), sin * Math.cos(elevation), Math.sin(elevation)];
    const [a, b] = [
      [-sin, cos, 0],
      [-cos * Math.sin(elevation), -sin * Math.sin(elevation), Math.cos(elevation)],
    ];
    // Every other photo is rolled by a right angle.
    const [x, y] = k % 2 ? [b, a.map((v) => -v)] : [a, b];
    const position = z.map((v) => 1500 * v);
    const rotation = [Math.atan2(-z[1], z[2]), Math.asin(z[0]), Math.atan2(-y[0], x[0])];
    project.photos.push({ id: `f${k}`, camera: 'c', file: '', position: position.map((v) => v + 10 * normal()), rotation, enabled: true });
    return { position, axes: [x, y, z] };
  });
  for (let j = 0; j < points; j++) {
    const xyz = [400, 300, 150].map((half) => half * (2 * random() - 1));
    project.points.push({ id: `p${j}`, role: 'tie', xyz: xyz.map((v) => v + 3 * normal()) });
    const first = Math.floor((Math.atan2(xyz[1], xyz[0]) / (2 * Math.PI) + 1) * photos);
    for (let n = 0; n < rays; n++) {
      const k = (first + n - (rays >> 1) + photos) % photos;
      const d = xyz.map((v, i) => v - stations[k].position[i]);
      const [x, y, z] = stations[k].axes.map((axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]);
      const [u, v] = [4000 - (7000 * x) / z + 0.1 * normal(), 3000 + (7000 * y) / z + 0.1 * normal()];
      project.observations.push({ photo: `f${k}`, point: `p${j}`, u, v, sigma: 0.1, enabled: true });
    }
  }
  return project;
}

const smallest = (runs, measure) => Math.min(...Array.from({ length: runs }, measure));

function measured(photos, points, rays) {
  const project = network(photos, points, rays);
  const runs = photos * points > 500_000 ? 3 : 7;
  let iterations = 0;
  const lean = { statistics: 'none' };
  let whole = Infinity;
  const iteration = smallest(runs, () => {
    const stamps = [];
    const began = performance.now();
    sightline.adjust(project, { ...lean, on_iteration: () => void stamps.push(performance.now()) });
    whole = Math.min(whole, performance.now() - began);
    iterations = stamps.length;
    return (stamps.at(-1) - stamps[0]) / (stamps.length - 1);
  });
  const full = smallest(runs, () => {
    const began = performance.now();
    sightline.adjust(project);
    return performance.now() - began;
  });
  const row = { photos, points, observations: project.observations.length, iterations, 'ms per iteration': iteration, 'statistics ms': full - whole };
  return { ...row, 'memory MB': memory.buffer.byteLength / 1e6 };
}

const series = {
  photos: [10, 20, 50, 100, 200, 400].map((photos) => measured(photos, 1000, 10)),
  points: [100, 300, 1000, 3000, 10_000].map((points) => measured(50, points, 10)),
};
for (const rows of Object.values(series)) {
  console.table(rows.map((row) => ({ ...row, 'ms per iteration': row['ms per iteration'].toFixed(2), 'statistics ms': row['statistics ms'].toFixed(1), 'memory MB': row['memory MB'].toFixed(0) })));
}

/** Both series with logarithmic axes, one line an iteration and one the statistics. */
function plot() {
  const [width, height, left, bottom] = [330, 250, 48, 40];
  const panel = (name, offset) => {
    const rows = series[name];
    const x = (value) => offset + left + ((Math.log10(value) - Math.log10(rows[0][name])) / Math.log10(rows.at(-1)[name] / rows[0][name])) * (width - left - 20);
    const y = (ms) => height - bottom - ((Math.log10(Math.max(ms, 0.1)) + 1) / 5) * (height - bottom - 30);
    const text = (at, place, label, anchor = 'middle') => `<text x="${at.toFixed(1)}" y="${place.toFixed(1)}" text-anchor="${anchor}">${label}</text>`;
    const ticks = [0.1, 1, 10, 100, 1000, 10_000].map((ms) => `<line x1="${offset + left}" x2="${offset + width - 20}" y1="${y(ms).toFixed(1)}" y2="${y(ms).toFixed(1)}" stroke="#ddd"/>${text(offset + left - 4, y(ms) + 4, ms, 'end')}`);
    const labels = rows.map((row) => text(x(row[name]), height - bottom + 16, row[name]));
    const line = (column, colour) => `<polyline fill="none" stroke="${colour}" stroke-width="1.5" points="${rows.map((row) => `${x(row[name]).toFixed(1)},${y(row[column]).toFixed(1)}`).join(' ')}"/>`;
    const fixed = name === 'photos' ? 'photos, 1000 points of 10 rays' : 'points of 10 rays, 50 photos';
    return [...ticks, ...labels, text(offset + left + (width - left) / 2, height - 6, fixed), line('ms per iteration', '#1769aa'), line('statistics ms', '#b3541e')].join('');
  };
  const legend = `<text x="48" y="16" fill="#1769aa">ms of an iteration</text><text x="180" y="16" fill="#b3541e">ms of the full statistics</text>`;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${2 * width} ${height}" font-family="sans-serif" font-size="11">${legend}${panel('photos', 0)}${panel('points', width)}</svg>\n`;
}
const target = process.argv.indexOf('--plot');
if (target > 0) writeFileSync(process.argv[target + 1], plot());
