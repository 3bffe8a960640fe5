// Calls of every function of the face with arguments that are damaged anywhere, all on one instance: each gives a result or an error
// with a code, in time, and memory does not grow with them. SIGHTLINE_CALLS is how many: a million in `cargo xtask bench field`.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { document, sightline } from './engine.mjs';

const CALLS = Number(process.env.SIGHTLINE_CALLS ?? 20_000);
/** No call takes longer. */
const LONGEST_MS = 10_000;
/** Maximum growth of memory after the first tenth of all calls, by when every function has been called. */
const GROWTH = 64 << 20;

let state = Number(process.env.SIGHTLINE_SEED ?? 7);
const random = () => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
const below = (n) => Math.floor(n * random());
const one = (all) => all[below(all.length)];

const ODD = [
  () => undefined, () => null, () => NaN, () => Infinity, () => -1, () => 0, () => 1e300, () => -0.5, () => 65_536, () => 4_294_967_295, () => 4_294_967_296, () => '', () => 'tie', () => '1001', () => '\u0000',
  () => '=1+1', () => 'x'.repeat(below(3000)), () => true, () => [], () => ({}), () => [null], () => [[], {}], () => Symbol('s'), () => 10n, () => () => 1, () => new Date(NaN),
  () => new Map(), () => new Uint8Array(below(100)), () => new Float64Array(3), () => new Array(5), () => Object.create(null), () => ({ toJSON: null }),
];

/** A copy with something odd in some places. */
function damaged(value) {
  const copy = structuredClone(value);
  for (let times = below(3); times >= 0; times--) {
    let at = copy;
    for (;;) {
      if (at === null || typeof at !== 'object' || ArrayBuffer.isView(at)) break;
      const keys = Object.keys(at);
      if (keys.length === 0) break;
      const key = one(keys);
      const inner = at[key];
      if (inner === null || typeof inner !== 'object' || ArrayBuffer.isView(inner) || random() < 0.1) {
        if (ArrayBuffer.isView(inner) && random() < 0.9) {
          for (let n = below(4); n >= 0; n--) inner[below(inner.length)] = below(256);
        } else if (random() < 0.05) delete at[key];
        else if (typeof inner === 'number' && random() < 0.5) at[key] = inner * (6 * random() - 3);
        else at[key] = one(ODD)();
        break;
      }
      at = inner;
    }
  }
  return copy;
}

/** A network that can be adjusted: a cube of points in four photos, seen by a plain projection. */
function network() {
  const points = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((k) => ({ id: `${k}`, role: k < 3 ? 'control' : 'tie', xyz: [k % 3, Math.floor(k / 3), k === 4 ? 1 : (k % 2) / 2], sigma: k < 3 ? [0.01, 0.01, 0.01] : null }));
  const cameras = [{ id: 'c', width: 1000, height: 800, pixel_pitch: [0.01, 0.01], model: 'brown', c: 10, free: [] }];
  const photos = [[0, 0], [2, 0], [0, 2], [2, 2]].map(([x, y], k) => ({ id: `p${k}`, camera: 'c', file: `${k}.jpg`, position: [x, y, 6], rotation: [0, 0, 0] }));
  const observations = photos.flatMap((photo) =>
    points.map((point) => {
      const [x, y, z] = [0, 1, 2].map((axis) => point.xyz[axis] - photo.position[axis]);
      return { photo: photo.id, point: point.id, u: 500 - (1000 * x) / z, v: 400 + (1000 * y) / z, sigma: 0.1 };
    }),
  );
  return { format: 'sightline', version: 1, cameras, photos, points, observations, datum: { kind: 'control', points: null } };
}

/** A network on paper, small enough that a photo of it is rendered in a moment. */
const paper = () => ({
  cameras: [{ id: 'c', width: 100, height: 80, pixel_pitch: null, model: 'brown', c: 120, free: ['c'], sigma: { x0: 1 } }],
  stations: [0, 1, 2].map((k) => ({ id: `s${k}`, camera: 'c', position: [2 * Math.cos(1.6 * k), 2 * Math.sin(1.6 * k), 3], look_at: [0, 0, 0], roll: 1.5 * k })),
  points: Array.from({ length: 6 }, (_, k) => ({ id: `p${k}`, xyz: [(k % 3) * 0.6 - 0.6, Math.floor(k / 3) * 0.6, 0.1 * (k % 2)], normal: [0, 0, 1], diameter: 0.2, role: k === 0 ? 'control' : 'tie', sigma: k ? null : [0.01, 0.01, 0.01] })),
  distances: [{ from: 'p0', to: 'p5', sigma: 0.001 }],
});

const plate =
  'c 100\nfiducial a 0 0\nfiducial b 50 0\nfiducial c 0 40\nfiducial d 50 40\ndistortion 10 1\ndistortion 20 2\ndistortion 30 4\ndistortion 40 6\n1 a 0 0\n1 b 50 0\n1 c 0 40\n1 d 50 40\n1 7 10 10';

const grey = Uint8Array.from({ length: 64 * 48 }, (_, k) => ((k % 64) - 30) ** 2 + (Math.floor(k / 64) - 22) ** 2 < 60 ? 220 : 30);

/** Two epochs of a cube, one of them a network. */
function epochs() {
  const points = network().points.map(({ id, xyz }, k) => ({ id, xyz: xyz.map((x, axis) => x + 1e-3 * Math.sin(7 * k + axis)), sigma: [0.001, 0.001, 0.001] }));
  const groups = [{ name: 'g', points: ['0', '1', '2', '4'], model: 'rigid' }];
  const list = { name: 'list', date: '2026-03-14', points, sigma0: 1, redundancy: 20 };
  return { epochs: [list, { ...list, name: 'later', date: '2026-04-14' }, { name: 'photos', project: network() }], reference: ['0', '1', '2', '3', '4'], groups, thresholds: { warning: 0.1, alarm: 1 } };
}

/** Sound arguments of every function that is not asynchronous, and how often it is called beside the others. */
function calls() {
  const project = network();
  const adjustment = sightline.adjust(project);
  const detection = sightline.detectGray(64, 48, grey);
  const pack = sightline.exportProject('package', project, adjustment);
  const json = sightline.exportProject('sightline', document());
  const marks = sightline.exportProject('mark-points', project);
  const control = sightline.exportProject('control-csv', project);
  const lens = sightline.exportCamera('opencv', project.cameras[0]);
  // The smallest of pictures: 2 x 2, grey, as a BMP.
  const bmp = Uint8Array.from(Buffer.from('424d4600000000000000360000002800000002000000020000000100180000000000100000000000000000000000000000000000000000000000ffffff000000808080ffffff0000', 'hex'));
  const form = { kind: 'plane', width: 2000, height: 1200, columns: 4, rows: 3, upright: true, diameter: 12 };
  const kim = sightline.planExample('kim');
  const plan = { ...kim, stations: kim.stations.slice(0, 2), ...sightline.targetsOn(form) };
  const film = sightline.runExperiment('film');
  const named = [{ photo: 'p0', targets: detection.targets }, { photo: 'p1', targets: detection.targets }];
  const known = {
    version: [[], 1],
    detect: [[bmp, {}], 4],
    detectGray: [[64, 48, grey, { codes: 'auto' }], 4],
    measureAt: [[bmp, 1, 1, {}], 2],
    measureAtGray: [[64, 48, grey, 30, 22, {}], 2],
    photoInfo: [[bmp], 20],
    nameCoded: [[named, {}], 20],
    spreadCodes: [['ring-12'], 1],
    snapMarks: [[project, named, {}], 20],
    nameGrid: [[project, named, { rows: 4, columns: 5, pitch: 20 }, {}], 5],
    matchUncoded: [[project, named, {}], 2],
    predict: [[project, null, '4', {}], 10],
    exchangeAxes: [[project, 'xy'], 1],
    orient: [[project], 2],
    adjust: [[project, { max_iterations: 10 }], 4],
    applyAdjustment: [[project, adjustment], 10],
    measureFeatures: [[project, {}], 5],
    projectionUncertainty: [[project, adjustment, { grid: [3, 3] }], 5],
    uncertaintyOverDistance: [[project, adjustment, { distances: [500, 2000], places: [[10, 10]] }], 5],
    residualBands: [[project, adjustment, { bands: 4 }], 5],
    compareCameras: [[project.cameras[0], project.cameras[0], { grid: [3, 3] }], 10],
    crossValidate: [[project, { grid: [3, 3], adjust: { max_iterations: 5 } }], 2],
    compareModels: [[project, { adjust: { max_iterations: 5 } }], 1],
    calibrationCoverage: [[project, project.cameras[0].id], 10],
    proposedModels: [[project.cameras[0], 1500], 10],
    convertCamera: [[project, project.cameras[0].id, 'opencv'], 5],
    nearestNames: [[project, project, 0.1], 10],
    compareEpochs: [[epochs()], 10],
    exportEpochs: [[sightline.compareEpochs(epochs()), 'gltf', { factor: 10 }], 5],
    displacementsInPhotos: [[project, adjustment, sightline.compareEpochs(epochs()).pairs[0], 10], 5],
    readList: [['a,1,2,3,0.1,0.1,0.1\nb,4,5,6,0.1,0.1,0.1', {}], 10],
    readCoordinates: [['a,1,2,3,0.1,0.1,0.1\nb,4,5,6,0.1,0.1,0.1', {}], 10],
    readCovariance: [['1\n0 1\n0 0 1', ['a']], 10],
    importProject: [['package', pack], 10],
    importCamera: [['auto', lens.files], 10],
    exportCamera: [['mrcal', project.cameras[0], { region: [[0, 0], [900, 0], [900, 700]], covariance: { parameters: ['c', 'k1'], matrix: [[1e-6, 0], [0, 1e-12]] } }], 5],
    exportProject: [['csv', project, adjustment], 10],
    simulate: [[paper()], 5],
    renderPhoto: [[paper(), 's0'], 2],
    coloursApart: [[bmp, {}], 4],
    reduceFilm: [[{ 'plate.txt': new TextEncoder().encode(plate) }], 20],
    experimentCsv: [[film], 2],
    runExperiment: [['film', {}], 0.1],
    codeCounts: [['ring-12'], 1],
    targetAdvice: [[{ c_px: 4000, distances: [1000], angles: [0, 1], diameter: 10 }], 5],
    targetSheet: [[{ codes: 3, dots: 2, bars: 1, bar_length: 100, field: { columns: 1, rows: 1 }, measured: 99.5 }], 0.5],
    targetsOn: [[form], 10],
    planOfProject: [[project], 5],
    planExample: [['kim'], 1],
    plan: [[plan], 2],
    nextPhoto: [[plan, { kind: 'mean' }], 0.02],
    makePlan: [[{ ...plan, form, stations: [], control: [], distances: [], datum: { kind: 'free' } }, { most: 4 }], 0.02],
  };
  // The same functions again with other formats.
  const more = [
    ['importProject', ['sightline', json], 20],
    ['importProject', ['mark-points', marks], 20],
    ['importProject', ['control-csv', control], 20],
    ['importProject', ['photomodeler', marks], 5],
    ['importProject', ['aicon', control], 5],
    ['importProject', ['dbat', json], 5],
    ['importProject', ['comparator', marks], 5],
    ...['sightline', 'package', 'mark-points', 'control-csv', 'dxf', 'dxf-2010', 'landxml', 'calibration', 'spreadsheet', 'spreadsheet-cp949', 'ply', 'gltf', 'tsv'].map((format) => ['exportProject', [format, project, adjustment], 5]),
    ...['colmap', 'colmap-binary', 'metashape', 'bal', 'bundler', 'meshroom'].flatMap((format) => [
      ['exportProject', [format, project, adjustment, { convert: true }], 3],
      ['importProject', ['auto', sightline.exportProject(format, project, adjustment)], 3],
    ]),
    ...['ros', 'kalibr', 'mrcal', 'colmap', 'agisoft-lens', 'micmac'].map((format) => ['importCamera', [format, sightline.exportCamera(format, project.cameras[0]).files], 3]),
    ['exportProject', ['report', project, adjustment], 0.2],
    ['exportProject', ['plots', project, adjustment], 0.2],
  ];
  const all = [...Object.entries(known).map(([name, [sound, weight]]) => [name, sound, weight]), ...more];
  // What is not listed has come lately, and is called with what is odd alone.
  const starting = new Set(['default', 'initSync', 'initCodecs', 'initCodecsSync', 'start']);
  for (const name of Object.keys(sightline)) {
    if (typeof sightline[name] === 'function' && !starting.has(name) && !(name in known)) all.push([name, [{}, {}, {}], 5]);
  }
  return all;
}

test(`${CALLS} calls with damaged arguments on one instance`, { timeout: 600_000 + 10 * CALLS }, () => {
  const { memory } = sightline.initSync();
  const all = calls();
  const total = all.reduce((sum, [, , weight]) => sum + weight, 0);
  const draw = () => {
    let at = total * random();
    return all.find(([, , weight]) => (at -= weight) < 0) ?? all[0];
  };
  const codes = new Map();
  const began = Date.now();
  let [results, longest, early] = [0, 0, 0];
  for (let call = 0; call < CALLS; call++) {
    const [name, sound] = draw();
    const given = random() < 0.1 ? sound.map((argument) => (random() < 0.5 ? one(ODD)() : argument)) : damaged(sound);
    const start = performance.now();
    try {
      sightline[name](...given);
      results++;
    } catch (error) {
      assert.ok(error instanceof Error && !(error instanceof WebAssembly.RuntimeError), `call ${call}, ${name}: ${String(error)}`);
      assert.equal(typeof error.code, 'string', `call ${call}, ${name}: ${error.stack}`);
      assert.notEqual(error.code, 'internal', `call ${call}, ${name}: ${error.message}`);
      codes.set(error.code, (codes.get(error.code) ?? 0) + 1);
    }
    const took = performance.now() - start;
    assert.ok(took < LONGEST_MS, `call ${call}, ${name}: ${took} ms`);
    longest = Math.max(longest, took);
    if (call === Math.floor(CALLS / 10)) early = memory.buffer.byteLength;
    if (call % 100_000 === 99_999) console.log(`${call + 1} calls in ${((Date.now() - began) / 60_000).toFixed(1)} min, ${(memory.buffer.byteLength / 1e6).toFixed(0)} MB, the longest ${longest.toFixed(0)} ms`);
  }
  const grown = memory.buffer.byteLength - early;
  assert.ok(grown <= GROWTH, `memory grew by ${grown} bytes`);
  // It works still, and both ends were reached.
  assert.equal(sightline.adjust(network()).termination, 'converged');
  assert.ok(results > CALLS / 50 && [...codes.values()].reduce((sum, n) => sum + n, 0) > CALLS / 5, `${results} results, ${JSON.stringify([...codes])}`);
});
