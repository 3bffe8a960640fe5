// Time of whole calls from JavaScript: what the border costs beside the engine's own work.
//   cargo xtask bench, or node benches/border.mjs [observations]
import { readFileSync } from 'node:fs';

import * as sightline from '../pkg/sightline.js';

sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });

/** A seeded network: photos on a ring around points in a cube, pinhole camera, 0.1 px noise. */
function network(observations) {
  let state = 12345;
  const random = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) + 0.5) / 2 ** 32;
  const normal = () => Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
  const photos = Math.max(4, Math.round(Math.sqrt(observations / 5)));
  const points = Math.round(observations / photos);
  const project = {
    format: 'sightline',
    version: 1,
    cameras: [{ id: 'c', width: 4000, height: 3000, pixel_pitch: null, model: 'brown', c: 4000, free: ['c'] }],
    photos: [],
    points: Array.from({ length: points }, (_, i) => ({ id: `p${i}`, role: 'tie', xyz: [random() - 0.5, random() - 0.5, random() - 0.5] })),
    observations: [],
    distances: [],
    datum: { kind: 'free', points: null },
  };
  for (let k = 0; k < photos; k++) {
    const angle = (2 * Math.PI * k) / photos;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    // Looking at the origin from the ring: phi about Y, the camera's z points away from the object.
    project.photos.push({ id: `f${k}`, camera: 'c', file: '', position: [3 * sin, 0, 3 * cos], rotation: [0, angle, 0], enabled: true });
    for (const { id, xyz } of project.points) {
      const [dx, dy, dz] = [xyz[0] - 3 * sin, xyz[1], xyz[2] - 3 * cos];
      const [x, y, z] = [cos * dx - sin * dz, dy, sin * dx + cos * dz];
      project.observations.push({ photo: `f${k}`, point: id, u: 2000 - (4000 * x) / z + 0.1 * normal(), v: 1500 + (4000 * y) / z + 0.1 * normal(), sigma: 0.1, enabled: true });
    }
  }
  return project;
}

function median(action, runs = 7) {
  const times = Array.from({ length: runs }, () => {
    const began = performance.now();
    action();
    return performance.now() - began;
  });
  return times.sort((a, b) => a - b)[runs >> 1];
}

const project = network(Number(process.argv[2] ?? 100_000));
const rows = { observations: project.observations.length, points: project.points.length, photos: project.photos.length };
rows['JSON.parse(JSON.stringify) ms'] = median(() => JSON.parse(JSON.stringify(project)));
rows['project in, checked ms'] = median(() => {
  try {
    // The last observation names no point: the project is read and checked, and then refused.
    sightline.adjust({ ...project, observations: [...project.observations, { ...project.observations[0], point: 'nobody' }] });
  } catch (error) {
    if (error.code !== 'unknown') throw error;
  }
});
rows['adjust, one iteration, no statistics ms'] = median(() => sightline.adjust(project, { max_iterations: 1, statistics: 'none' }), 3);
rows['adjust, full statistics ms'] = median(() => sightline.adjust(project), 1);
console.table([rows]);
