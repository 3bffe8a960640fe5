// A program that uses the declarations of pkg/; it is compiled, not run.
import { readFileSync } from 'node:fs';
import * as sightline from 'sightline';
import type { Camera, Project, SightlineError } from 'sightline';

sightline.initSync({ module: readFileSync('pkg/sightline_bg.wasm') });
const camera: Camera = { id: 1, width: 2272, height: 1704, pixel_pitch: null, model: 'brown', c: 7.5, free: ['c', 'k1'], sigma: { x0: 0.1 } };
const project: Project = { format: 'sightline', version: 1, cameras: [camera], datum: { kind: 'free' } };

const imported: Project = sightline.importProject('photomodeler', { 'export.txt': readFileSync('export.txt') });
const lenses: sightline.ImportedCameras = sightline.importCamera('auto', { 'camera.yml': '%YAML:1.0' }, { region: [[0, 0], [9, 0], [9, 9]] });
const lens: sightline.ExportedCamera = sightline.exportCamera('mrcal', lenses.cameras[0]!.camera, { convert: true });
const difference: number | undefined = lens.conversion?.max_px;
export { difference };
const files: Record<string, Uint8Array> = sightline.exportProject('csv', { ...project, points: imported.points ?? [] });
console.log(sightline.version(), Object.keys(files));

// @ts-expect-error there is no such format
sightline.importProject('docx', {});
// @ts-expect-error a model needs its own parameters
const wrong: Camera = { id: 1, width: 1, height: 1, model: 'opencv', c: 3 };

try {
  sightline.exportProject('tsv', project, null);
} catch (error) {
  const { code, where, message } = error as SightlineError;
  console.log(code, where.photo, where.field, message, wrong);
}
