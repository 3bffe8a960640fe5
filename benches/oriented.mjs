// Orientation as wasm in Node: seconds of `orient` on networks that the native bench has written.
//   mkdir given && cargo bench --bench orient -- large write given && node benches/oriented.mjs given
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

import * as sightline from '../pkg/sightline.js';

sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });

const folder = process.argv[2];
if (!folder) throw new Error('name the folder with the networks');
const files = readdirSync(folder).filter((name) => name.endsWith('.json'));
files.sort((a, b) => Number.parseInt(a) - Number.parseInt(b));
const all = [];
for (const name of files) {
  const project = JSON.parse(readFileSync(join(folder, name), 'utf8'));
  const began = process.cpuUsage();
  const oriented = sightline.orient(project);
  const { user, system } = process.cpuUsage(began);
  const seconds = (user + system) / 1e6;
  all.push(seconds);
  const standing = oriented.photos.filter((photo) => photo.position).length;
  console.log(`${name}: ${standing} of ${project.photos.length} photos, ${project.points.length} points, ${seconds.toFixed(2)} s`);
}
all.sort((a, b) => a - b);
console.log(`${all.length} networks: median ${all[all.length >> 1]?.toFixed(2)} s, longest ${all.at(-1)?.toFixed(2)} s`);
