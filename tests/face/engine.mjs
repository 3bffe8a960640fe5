// The engine as any page or script loads it, and the data with independent answers where a machine has it.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = fileURLToPath(new URL('../..', import.meta.url));
/** Where the engine lies: `cargo xtask test` names what it has built. */
const pkg = process.env.SIGHTLINE_PKG || join(root, 'pkg');
const sightline = await import(pathToFileURL(join(pkg, 'sightline.js')));
sightline.initSync({ module: readFileSync(join(pkg, 'sightline_bg.wasm')) });
export { pkg, root, sightline };

const folder = process.env.SIGHTLINE_DATA || join(root, '../shared/data');
/** Whether the data is here; where it is, no test is skipped. */
export const hasData = existsSync(folder);
export const skip = hasData ? false : 'skipped, no data';
export const dataPath = (path) => join(folder, path);
export const data = (path) => readFileSync(dataPath(path));

/** Returns the error that a function throws; a trap of the module is not an error of the engine. */
export function thrown(action) {
  try {
    action();
  } catch (error) {
    if (!(error instanceof Error) || error instanceof WebAssembly.RuntimeError) throw new Error(`a trap: ${error}`);
    return error;
  }
  throw new Error('nothing was thrown');
}

/** A small document: two cameras, three photos, five points, one of each odd thing. */
export const document = () => ({
  format: 'sightline',
  version: 1,
  name: 'small',
  unit: 'm',
  cameras: [
    { id: 1, width: 1000, height: 800, pixel_pitch: [0.01, 0.01], model: 'brown', c: 10, free: ['c'], sigma: { k1: 1e-5 } },
    { id: 'b', width: 1000, height: 800, pixel_pitch: null, model: 'opencv', fx: 900, fy: 900, cx: 500, cy: 400, free: ['f'] },
  ],
  photos: [
    { id: 'p1', camera: 1, file: 'a.jpg', position: [0, 0, 10], rotation: [0, 0, 0] },
    { id: 'p2', camera: 1, file: 'b.jpg', position: [2, 0, 10], rotation: [0, 0.1, 0], enabled: false },
    { id: 3, camera: 'b', file: 'c.jpg', position: null, rotation: null },
  ],
  points: [
    { id: 1001, role: 'control', xyz: [0, 0, 0], sigma: [0.1, null, 0] },
    { id: 'x', role: 'check', xyz: [1, 0, 0.5], sigma: null, diameter: 0.02, normal: [0, 0.6, -0.8] },
    { id: 'y', role: 'tie', xyz: null },
  ],
  observations: [
    { photo: 'p1', point: 1001, u: 500, v: 400, sigma: 0.1 },
    { photo: 'p2', point: 'x', u: 510.5, v: 410.25, sigma: [0.1, 0.2], enabled: false },
    { photo: 3, point: 'y', u: 1, v: 2, sigma: 0.5, enabled: true },
  ],
  distances: [{ from: 1001, to: 'x', length: 1.118, sigma: 0.001 }],
  datum: { kind: 'control', points: null },
});
