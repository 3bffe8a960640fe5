// A large network of another program (COLMAP, 100,000 points) from its files to the report in Node: time and memory of each step. `memory` is
// what the module has taken, at most 4 GB.
//   cargo xtask build; node --max-old-space-size=12000 benches/large.mjs [points]
import { readFileSync } from 'node:fs';

import * as sightline from '../pkg/sightline.js';

const { memory } = sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });
const count = Number(process.argv[2] ?? 100_000);

/** A COLMAP text model: photos on rings around a slab of points, five photos a point, 0.5 px noise. */
function model(points, photos = 200, rays = 5) {
  let state = 12345;
  const random = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 2 ** 32;
  const normal = () => Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
  const [width, height, f] = [4000, 3000, 3200];
  const stations = Array.from({ length: photos }, (_, k) => {
    const azimuth = (2 * Math.PI * 7 * k) / photos;
    const elevation = 0.5 + (0.7 * k) / photos;
    const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
    const away = [cos * Math.cos(elevation), sin * Math.cos(elevation), Math.sin(elevation)];
    const [right, up] = [[-sin, cos, 0], [-cos * Math.sin(elevation), -sin * Math.sin(elevation), Math.cos(elevation)]];
    // COLMAP's camera: x right, y down, z forwards; the rows of the rotation from the world.
    const rows = [right, up.map((v) => -v), away.map((v) => -v)];
    const position = away.map((v) => 10 * v);
    const t = rows.map((row) => -row.reduce((sum, v, i) => sum + v * position[i], 0));
    return { rows, t, lines: [], seen: 0 };
  });
  const lines = [];
  for (let j = 0; j < points; j += 1) {
    const xyz = [3 * (random() - 0.5), 3 * (random() - 0.5), random() - 0.5];
    const first = Math.floor(random() * photos);
    const track = [];
    for (let n = 0; n < rays; n += 1) {
      const k = (first + n * 37) % photos;
      const { rows, t, lines: keypoints } = stations[k];
      const [x, y, z] = rows.map((row, i) => row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2] + t[i]);
      track.push(k + 1, keypoints.length);
      keypoints.push(`${(width / 2 + (f * x) / z + 0.5 * normal()).toFixed(3)} ${(height / 2 + (f * y) / z + 0.5 * normal()).toFixed(3)} ${j + 1}`);
    }
    lines.push(`${j + 1} ${xyz.map((v) => (v + 0.003 * normal()).toFixed(5)).join(' ')} 128 128 128 0.5 ${track.join(' ')}`);
  }
  const quaternion = ([[a, b, c], [d, e, g], [h, i, k]]) => {
    const w = Math.sqrt(Math.max(0, 1 + a + e + k)) / 2;
    const x = Math.sign(i - g || 1) * Math.sqrt(Math.max(0, 1 + a - e - k)) / 2;
    const y = Math.sign(c - h || 1) * Math.sqrt(Math.max(0, 1 - a + e - k)) / 2;
    const z = Math.sign(d - b || 1) * Math.sqrt(Math.max(0, 1 - a - e + k)) / 2;
    return [w, x, y, z];
  };
  const images = stations.map(({ rows, t, lines: keypoints }, k) => `${k + 1} ${[...quaternion(rows), ...t].join(' ')} 1 f${k}.jpg\n${keypoints.join(' ')}`);
  const text = (all) => new TextEncoder().encode(`# COLMAP text model\n${all.join('\n')}\n`);
  return {
    'cameras.txt': text([`1 PINHOLE ${width} ${height} ${f} ${f} ${width / 2} ${height / 2}`]),
    'images.txt': text(images),
    'points3D.txt': text(lines),
  };
}

/** Runs a step and says what it took. */
function step(name, action) {
  const start = performance.now();
  const result = action();
  const seconds = (performance.now() - start) / 1000;
  const mb = (bytes) => `${Math.round(bytes / 1e6)} MB`;
  console.log(`${name}: ${seconds.toFixed(1)} s; module ${mb(memory.buffer.byteLength)}, JavaScript ${mb(process.memoryUsage().heapUsed)}, process ${mb(process.memoryUsage.rss())}`);
  return result;
}

const files = step('model written', () => model(count));
const sizes = (all) => Object.entries(all).map(([name, bytes]) => `${name} ${(bytes.length / 1e6).toFixed(1)} MB`).join(', ');
console.log(sizes(files));
const project = step('read', () => sightline.importProject('colmap', files));
console.log(`${project.photos.length} photos, ${project.points.length} points, ${project.observations.length} observations`);
const adjustment = step('adjusted', () => sightline.adjust(project, {}));
console.log(`sigma0 ${adjustment.sigma0.toFixed(3)}, ${adjustment.iterations?.length} iterations`);
console.log(sizes(step('report', () => sightline.exportProject('report', project, adjustment))));
