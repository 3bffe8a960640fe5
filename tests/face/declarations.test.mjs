// The declarations are written by hand: the compiler compares them with what the engine really returns.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { document, pkg, root, sightline, thrown } from './engine.mjs';

/** Compiles a text against pkg/ with literals of results in it; the compiler's complaints. */
function complaints(body) {
  const folder = join(root, 'e2e/out');
  mkdirSync(folder, { recursive: true });
  const file = join(folder, 'literals.ts');
  writeFileSync(file, `import type * as S from '${pkg}/sightline.js';\n${body}\nexport {};\n`);
  const options = ['--strict', '--exactOptionalPropertyTypes', '--noEmit', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022,dom', '--types', ''];
  const compiler = join(root, 'e2e/node_modules/typescript/bin/tsc');
  const { status, stdout } = spawnSync(process.execPath, [compiler, ...options, file], { encoding: 'utf8' });
  return status === 0 ? '' : stdout;
}

const literal = (name, type, value) => `const ${name}: ${type} = ${JSON.stringify(value)};`;

/** A network of four stations that see nine targets, to be simulated or rendered. */
const network = () => ({
  cameras: [{ id: 'c', width: 400, height: 300, pixel_pitch: null, model: 'brown', c: 500, free: ['c'], sigma: { x0: 1 } }],
  stations: [0, 1, 2, 3].map((k) => ({ id: `s${k}`, camera: 'c', position: [2 * Math.cos(1.6 * k), 2 * Math.sin(1.6 * k), 3], look_at: [0, 0, 0], roll: 1.5 * k })),
  points: Array.from({ length: 9 }, (_, k) => ({
    id: `p${k}`, xyz: [(k % 3) * 0.6 - 0.6, Math.floor(k / 3) * 0.6 - 0.6, 0.1 * (k % 2)], normal: [0, 0, 1], diameter: 0.12,
    role: k === 0 ? 'control' : k === 8 ? 'check' : 'tie', sigma: k % 8 === 0 ? [0.01, 0.01, 0.01] : null,
  })),
  distances: [{ from: 'p0', to: 'p5', sigma: 0.001 }],
});

/** A calibration of twelve photos of thirty points with depth, which its halves determine too. */
const calibration = () =>
  sightline.simulate({
    seed: 3,
    cameras: [{ id: 'c', width: 4000, height: 3000, pixel_pitch: null, model: 'brown', c: 3500, free: ['c', 'x0', 'y0', 'k1'] }],
    stations: Array.from({ length: 12 }, (_, k) => ({
      id: `s${k}`, camera: 'c', position: [2.4 * Math.cos(k), 2.4 * Math.sin(k), 2.5 + 0.1 * (k % 3)], look_at: [0, 0, 0], roll: 1.57 * k,
    })),
    points: Array.from({ length: 30 }, (_, k) => ({ id: `p${k}`, xyz: [0.4 * (k % 6) - 1, 0.45 * Math.floor(k / 6) - 0.9, 0.3 * Math.sin(5 * k)], diameter: null })),
    datum: { kind: 'free', points: null },
    sigma: 0.1,
  });

/** The same without what orientation finds. */
const bare = (project) => ({
  ...project,
  photos: project.photos.map((photo) => ({ ...photo, position: null, rotation: null })),
  points: project.points.map((point) => (point.role === 'tie' ? { ...point, xyz: null } : { ...point, role: 'tie', xyz: null, sigma: null })),
});

/** The targets of all its photos. */
const photosOf = (project) =>
  project.photos.map(({ id }) => {
    const { width, height, samples } = sightline.renderPhoto(network(), id);
    return { photo: id, targets: sightline.detectGray(width, height, samples).targets };
  });

/** States of an adjustment at its beginning, on its way and at its end. */
function stepped(project) {
  const adjuster = sightline.startAdjustment(project);
  const states = [adjuster.state(), adjuster.step()];
  while (!states.at(-1).termination) states.push(adjuster.step());
  return [...states.slice(0, 2), states.at(-1)];
}

/** Targets of one of its photos. */
function detection() {
  const { width, height, samples } = sightline.renderPhoto(network(), 's0');
  return sightline.detectGray(width, height, samples, { codes: 'ring-14' });
}

/** Targets of a photo of `rows` rows of four dots. */
function grid(photo, rows) {
  const target = (k) => ({ ...detectedDot, id: k + 1, u: 100 + 40 * (k % 4), v: 100 + 38 * Math.floor(k / 4) });
  return { photo, targets: Array.from({ length: 4 * rows }, (_, k) => target(k)) };
}

const detectedDot = {
  sigma_u: 0.02, sigma_v: 0.02, major: 16, minor: 15.2, angle: 0, contrast: 100, polarity: 'dark', code: null, quality: {},
};

test('every field that the engine returns is declared, and every declared field is there', () => {
  const found = detection();
  assert.ok(found.targets.length >= 7);
  const targets = [{ ...found.targets[0], code: 7 }];
  const photos = [{ photo: 'a', targets }];
  const marks = [{ photo: 'a', point: '7', u: targets[0].u + 1, v: targets[0].v, sigma: 0.1 }, { photo: 'b', point: '7', u: 1, v: 1, sigma: 0.1 }];
  const text = new TextEncoder().encode(JSON.stringify(document()));
  const project = sightline.simulate(network());
  const coarse = structuredClone(project);
  coarse.observations[3].u += 20;
  const measured = structuredClone(project);
  measured.distances = [['p0', 'p5'], ['p1', 'p6'], ['p2', 'p7']].map(([from, to], k) => {
    const [a, b] = [from, to].map((id) => measured.points.find((point) => point.id === id).xyz);
    return { from, to, length: Math.hypot(...a.map((x, i) => x - b[i])) + (k === 1 ? 0.5 : 0), sigma: 0.01 };
  });
  const adjustments = [
    sightline.adjust(project, { covariance_of: ['p1', 'p2'] }),
    sightline.adjust(project, { statistics: 'none' }),
    sightline.adjust(coarse, { snooping: true }),
    sightline.adjust(coarse, { robust: 'huber' }),
    ...[{ snooping: true }, { robust: 'huber' }].map((options) => sightline.adjust(measured, options)),
    sightline.adjust({ ...project, datum: { kind: 'control', points: null }, points: project.points.map((point, k) => (k % 2 ? point : { ...point, role: 'control', sigma: [0.01, null, 0.02] })) }),
    sightline.adjust(project, { variance_components: { per_camera: true, unmodelled: true } }),
  ];
  assert.equal(adjustments[4].gross_errors[0].given.kind, 'distance');
  const all = project.points.map((point) => point.id);
  const featured = {
    ...project,
    features: [
      { id: 'A', kind: 'plane', points: all },
      { id: 'B', kind: 'distance', from: { point: all[0] }, to: { feature: 'A' } },
      { id: 'C', kind: 'angle', from: { point: all[0] }, at: { point: all[1] }, to: { point: all[2] } },
      { id: 'D', kind: 'deviations', feature: 'A' },
      { id: 'E', kind: 'line', points: [all[0], 'nowhere'] },
    ],
    systems: [{ id: 'S', kind: 'automatic' }, { id: 'T', kind: 'best_fit', given: project.points.map(({ id, xyz }) => ({ id, xyz })) }],
    lines: [{ from: all[0], to: all[1], layer: 'edges' }],
    layers: [{ id: 'edges', colour: [255, 0, 0] }],
  };
  adjustments.push(sightline.adjust(featured));
  const measuredLater = sightline.measureFeatures(featured, adjustments[0]);
  // Exact observations leave a σ0 of rounding, so that values are compared and standard errors only there.
  for (const [k, { value, sigma }] of measuredLater.features.slice(1, 3).entries()) {
    assert.ok(Math.abs(value - adjustments.at(-1).features[k + 1].value) < 1e-6 && sigma >= 0);
  }
  const lateral = { shift_u: 0.1, shift_v: -0.05, linear: 0.8, cubic: -0.3, at_corner: 0.5, sigma_at_corner: 0.02, rms: 0.02, sigma0: 1, targets: 30, significant: true, covariance: [1e-4, 0, 0, 0, 1e-4, 0, 0, 2e-4, 0, 2e-4] };
  const apart = { centre: [200, 150], corner: 250, colours: [{ colour: 'red', shifts: [], lateral }] };
  // A document of an earlier version: what the format no longer has changes nothing, and is named.
  const earlier = { ...project, cameras: [{ ...project.cameras[0], colours: { red: { parameters: { c: 1.6 } } } }], photos: project.photos.map((photo) => ({ ...photo, colour: 'red' })) };
  const readAgain = sightline.applyAdjustment(earlier, adjustments[0]);
  assert.deepEqual(readAgain.origin.ignored.map(({ count }) => count), [1, project.photos.length]);
  assert.ok(!('colours' in readAgain.cameras[0]) && !('colour' in readAgain.photos[0]));
  assert.equal(sightline.adjust(earlier).sigma0, adjustments[0].sigma0);
  const listed = (phase) => project.points.map(({ id, xyz }, k) => ({ id, xyz: xyz.map((x, axis) => x + 1e-3 * Math.sin(7 * k + axis + phase)), sigma: [0.001, 0.001, 0.001] }));
  const lists = [0, 1, 2].map((k) => ({ name: `list ${k}`, date: `2026-0${k + 1}-01`, points: listed(k), sigma0: 1, redundancy: 40, unit: 'mm' }));
  lists[2].points[4].xyz = lists[2].points[4].xyz.map((x) => x + 0.05);
  lists[1].points = lists[1].points.filter(({ id }) => id !== 'p8');
  const request = {
    epochs: [...lists, { name: 'photos', project, date: null }],
    groups: ['rigid', 'similarity', 'affine'].map((model) => ({ name: model, points: all, model })),
    thresholds: { warning: 0.01, alarm: 0.02, points: { p1: { warning: 1, alarm: 2 } } },
  };
  const monitoring = sightline.compareEpochs(request);
  assert.deepEqual([monitoring.pairs.length, monitoring.series.length, monitoring.pairs[1].unstable.join()], [5, 9, 'p4']);
  assert.deepEqual(monitoring.pairs[0].left_out, [{ id: 'p8', reason: { code: 'only_in', epoch: 'list 0' } }]);
  const refusal = thrown(() => sightline.compareEpochs({ ...request, epochs: [lists[0], { ...lists[1], unit: 'm' }] }));
  assert.deepEqual([refusal.code, refusal.where.field, refusal.data.reason.kind], ['invalid', 'epochs[1].unit', 'epoch_unit']);
  assert.equal(thrown(() => sightline.compareEpochs({ ...request, referencs: [] })).data.reason.kind, 'no_such_option');
  const exported = (format, options) => new TextDecoder().decode(sightline.exportEpochs(monitoring, format, options));
  assert.equal(exported('csv').trim().split('\n').length, 1 + monitoring.pairs.reduce((sum, pair) => sum + pair.points.length, 0));
  assert.deepEqual(JSON.parse(exported('json')), monitoring);
  assert.match(exported('gltf', { pair: 1, factor: 100 }), /^glTF.*arrows/s);
  assert.match(exported('dxf', { pair: 1, factor: 100 }), /displacements x 100/);
  assert.match(exported('report', { settings: { language: 'ko' } }), /lang="ko".*변위/s);
  assert.equal(thrown(() => sightline.exportEpochs(monitoring, 'obj')).code, 'unknown');
  assert.equal(thrown(() => sightline.exportEpochs(monitoring, 'dxf', { pair: 99 })).code, 'unknown');
  const shown = sightline.displacementsInPhotos(project, adjustments[0], monitoring.pairs[1], 10);
  assert.equal(shown.length, project.photos.length);
  const arrow = shown[0].vectors.find(({ point }) => point === 'p4');
  assert.ok(arrow.moved && Math.hypot(arrow.to[0] - arrow.from[0], arrow.to[1] - arrow.from[1]) > 1, JSON.stringify(arrow));
  const noisy = calibration();
  const literals = [
    literal('shown', 'S.PhotoDisplacements[]', shown),
    literal('request', 'S.CompareOptions', request),
    literal('monitoring', 'S.Monitoring', monitoring),
    literal('cross', 'S.CrossValidation', sightline.crossValidate(noisy, { grid: [3, 3], camera: 'c' })),
    literal('overDistance', 'S.DistanceUncertainty', sightline.uncertaintyOverDistance(noisy, sightline.adjust(noisy), { camera: 'c', places: [[320, 240], [0, 0]] })),
    literal('bands', 'S.ResidualBands', sightline.residualBands(noisy, sightline.adjust(noisy), { camera: 'c', bands: 3 })),
    literal('coverage', 'S.Coverage', sightline.calibrationCoverage(noisy, 'c')),
    literal('proposed', 'S.CameraModelName[]', sightline.proposedModels(noisy.cameras[0], 300)),
    literal('models', 'S.ComparedModel[]', sightline.compareModels(noisy)),
    literal('converted', 'S.ConvertedCamera', sightline.convertCamera(project, 'c', 'opencv')),
    literal('list', 'S.PointList', sightline.readList('id,X,Y,Z,sigma,diameter\na,1.5,2.5,3.5,0.1,12.5\nb,4,x,6,0.1,5\n', { sigma: { constant: 2, unit: 'mm', ppm: 2 } })),
    literal('coordinates', 'S.CoordinateList', sightline.readCoordinates('a,1,2,3,0.1,0.1,0.1\nb,4,5,6,0.1,0.1,0.1\n')),
    literal('matrix', 'S.ListedCovariance', sightline.readCovariance('1\n0 1\n0 0 1\n', ['a'])),
    literal('apart', 'S.ColoursApart', apart),
    literal('readAgain', 'S.Project', readAgain),
    literal('network', 'S.Network', network()),
    literal('simulated', 'S.Project', project),
    literal('oriented', 'S.OrientedProject', sightline.orient(bare(project))),
    literal('partly', 'S.OrientedProject', sightline.orient({ ...bare(project), observations: project.observations.filter(({ photo, point }, k) => photo !== 's3' && (point !== 'p4' || k < 9)) })),
    literal('film', 'S.ReducedFilm', sightline.reduceFilm({ 'plate.txt': 'c 100\nfiducial a 0 0\nfiducial b 50 0\nfiducial c 0 40\nfiducial d 50 40\ndistortion 10 1\ndistortion 20 2\ndistortion 30 4\ndistortion 40 6\n1 a 0 0\n1 b 50 0\n1 c 0 40\n1 d 50 40\n1 7 10 10' })),
    literal('experiment', 'S.Experiment', sightline.runExperiment('film')),
    literal('matching', 'S.Matching', sightline.matchUncoded(project, photosOf(project))),
    literal('gridNaming', 'S.GridNaming', sightline.nameGrid(project, [grid('a', 3), grid('b', 1)], { rows: 3, columns: 4, pitch: 20, sigma: 0.1 })),
    literal('prediction', 'S.Prediction', sightline.predict(project, 'p1', adjustments[0])),
    ...adjustments.map((adjustment, k) => literal(`adjustment${k}`, 'S.Adjustment', adjustment)),
    literal('measured', 'S.Measured', measuredLater),
    literal('linear', 'S.LinearSystem', sightline.linearise(project)),
    literal('normal', 'S.NormalEquations', sightline.normalEquations(project)),
    ...stepped(project).map((state, k) => literal(`state${k}`, 'S.StepState', state)),
    literal('renaming', 'S.Renaming', sightline.nearestNames(featured.points, [{ id: 'near', xyz: project.points[0].xyz }], 1)),
    literal('featured', 'S.Project', sightline.applyAdjustment(featured, adjustments.at(-1))),
    literal('project', 'S.Project', sightline.importProject('sightline', { 'project.json': text })),
    literal('detection', 'S.Detection', found),
    literal('coded', 'S.Coded', sightline.nameCoded([{ photo: 'a', targets: [...targets, ...targets] }, { photo: 'b', targets }])),
    literal('spread', 'S.CodeSpread', sightline.spreadCodes('ring-12')),
    literal('snapped', 'S.Snapped', sightline.snapMarks(marks, photos, 3)),
  ];
  assert.equal(complaints(literals.join('\n')), '');
});

test('what is done before the photos is declared as it is returned', () => {
  const sheet = sightline.targetSheet({ codes: 3, dots: 2, bars: 1, bar_length: 100, field: { columns: 1, rows: 1 }, measured: 99.5 });
  assert.deepEqual(Object.keys(sheet.files).sort(), ['control.csv', 'distances.csv', 'sheets.pdf', 'targets.csv']);
  const { files, ...drawn } = sheet;
  const form = { kind: 'plane', width: 2000, height: 1200, columns: 4, rows: 3, upright: true, diameter: 12 };
  const targets = sightline.targetsOn(form);
  const example = sightline.planExample('kim');
  const plan = { ...example, stations: example.stations.slice(0, 2) };
  const literals = [
    literal('drawn', "Omit<S.TargetSheet, 'files'>", drawn),
    literal('counts', 'S.CodeCount[]', sightline.codeCounts('ring-12')),
    literal('advised', 'S.TargetAdvice[]', sightline.targetAdvice({ c_px: 4000, distances: [1000], angles: [0, 1], diameter: 10 })),
    literal('targets', 'S.FormTargets', targets),
    ...['kang', 'lee-calibration', 'lee-structure', 'kim'].map((name, k) => literal(`example${k}`, 'S.Plan', sightline.planExample(name))),
    literal('again', 'S.Plan', sightline.planOfProject(sightline.simulate(network()))),
    literal('predicted', 'S.PlanPrediction', sightline.plan(plan)),
    literal('alone', 'S.PlanPrediction', sightline.plan({ ...plan, stations: plan.stations.slice(0, 1), forbidden: [{ low: [-1e6, -1e6, -1e6], high: [1e6, 1e6, 1e6] }] })),
    literal('next', 'S.SuggestedPhoto[]', sightline.nextPhoto(plan, { kind: 'mean' })),
    literal('made', 'S.MadePlan', sightline.makePlan({ ...plan, ...targets, form, stations: [], control: [], distances: [], datum: { kind: 'free' } }, { most: 4 })),
  ];
  assert.equal(complaints(literals.join('\n')), '');
});

test('the comparison notices a field too many and one too few', () => {
  const target = detection().targets[0];
  assert.match(complaints(literal('target', 'S.Target', { ...target, extra: 1 })), /extra/);
  const { sigma_u, ...less } = target;
  assert.match(complaints(literal('target', 'S.Target', less)), /sigma_u/);
});

test('the options that are declared are those that exist', () => {
  const declared = readFileSync(join(pkg, 'sightline.d.ts'), 'utf8');
  for (const [name, action] of [
    ['AdjustOptions', (options) => sightline.adjust(sightline.simulate(network()), options)],
    ['DetectOptions', (options) => sightline.detectGray(1, 1, new Uint8Array(1), options)],
    ['ExperimentOptions', (options) => sightline.runExperiment('film', options)],
    ['NameCodedOptions', (options) => sightline.nameCoded([], options)],
    ['PredictOptions', (options) => sightline.predict(sightline.simulate(network()), 'p1', null, options)],
    ['SheetOptions', (options) => sightline.targetSheet(options)],
    ['MakePlanOptions', (options) => sightline.makePlan(sightline.planExample('kim'), options)],
    ['GridOptions', (options) => sightline.nameGrid(sightline.simulate(network()), [], { rows: 3, columns: 4, pitch: 20 }, options)],
    ['MatchOptions', (options) => sightline.matchUncoded(sightline.simulate(network()), [], options)],
  ]) {
    const body = declared.split(`export interface ${name} {`)[1].split('\n}')[0];
    const fields = [...body.matchAll(/^\s+(\w+)\?:/gm)].map((match) => match[1]);
    const error = thrown(() => action({ no_such_option: 1 }));
    const known = error.message.match(/the options are (\w+(?:, \w+)*)/)[1].split(', ');
    assert.deepEqual(fields.sort(), known.sort(), name);
  }
});
