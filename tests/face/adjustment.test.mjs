// The bundle adjustment from JavaScript: a calibration with published answers, options, callbacks, errors.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { data, sightline, skip, thrown } from './engine.mjs';

/** A small free network: six aimed stations around twenty points, a scale bar, 0.1 px noise. */
const network = (more = {}) => ({
  cameras: [{ id: 'c', width: 2000, height: 1500, pixel_pitch: [0.005, 0.005], model: 'brown', c: 10, free: ['c', 'x0', 'y0'] }],
  stations: Array.from({ length: 6 }, (_, k) => ({
    id: `s${k}`,
    camera: 'c',
    position: [3000 * Math.cos(k), 3000 * Math.sin(k), 1500 + 200 * k],
    look_at: [0, 0, 0],
    roll: (k * Math.PI) / 2,
  })),
  points: Array.from({ length: 20 }, (_, k) => ({ id: `p${k}`, xyz: [400 * Math.cos(2.4 * k), 400 * Math.sin(2.4 * k), 40 * ((k * 7) % 11)], diameter: null })),
  distances: [{ from: 'p0', to: 'p7', sigma: 0.01 }],
  ...more,
});

test('a simulated network is adjusted, step by step, and every number is finite', () => {
  const project = sightline.simulate(network());
  const seen = [];
  const adjustment = sightline.adjust(project, { on_iteration: (iteration) => void seen.push(iteration) });
  assert.equal(adjustment.termination, 'converged');
  assert.deepEqual(seen, adjustment.iterations);
  assert.equal(adjustment.observations_count, 2 * 6 * 20 + 1);
  assert.equal(adjustment.observations_count - adjustment.unknowns + adjustment.constraints, adjustment.redundancy);
  assert.ok(adjustment.sigma0 > 0.8 && adjustment.sigma0 < 1.25, `sigma0 ${adjustment.sigma0}`);
  const sum = adjustment.observations.reduce((total, { rx, ry }) => total + rx + ry, 0);
  assert.ok(sum <= adjustment.redundancy + 1e-6 && sum > adjustment.redundancy - 1.01);
  const walk = (value, path) => {
    if (typeof value === 'number') assert.ok(Number.isFinite(value), path);
    else if (value && typeof value === 'object') for (const [key, child] of Object.entries(value)) walk(child, `${path}.${key}`);
    else assert.notEqual(value, undefined, path);
  };
  walk(adjustment, 'adjustment');
});

test('the fast tables say what the engine itself says', () => {
  const project = sightline.simulate(network({ seed: 7 }));
  const adjustment = sightline.adjust(project, { robust: 'huber', covariance_of: ['p0', 'p3'] });
  // Through the file and back: serde writes and reads it, the tables are not in it.
  const rows = (name) => new TextDecoder().decode(sightline.exportProject('csv', project, adjustment)[`${name}.csv`]).trim().split('\n').slice(1).map((line) => line.split(','));
  for (const [row, observation] of rows('observations').map((row, i) => [row, adjustment.observations[i]])) {
    assert.deepEqual(row.slice(0, 2), [observation.photo, observation.point]);
    const pixels = [observation.vx / 0.005, observation.vy / 0.005, observation.rx, observation.ry, observation.wx, observation.wy];
    pixels.forEach((value, k) => assert.ok(Math.abs(Number(row[6 + k]) - value) <= 1e-9 * Math.max(1, Math.abs(value))));
  }
  for (const [row, point] of rows('points').map((row, i) => [row, adjustment.points[i]])) {
    assert.equal(row[0], point.id);
    [...point.xyz, ...point.sigma].forEach((value, k) => assert.equal(Number(row[2 + k]), value));
    assert.equal(Number(row[8]), point.rays);
    assert.ok(Math.abs(Math.sqrt(point.covariance[0]) - point.sigma[0]) < 1e-9 * point.sigma[0]);
  }
  const applied = sightline.applyAdjustment(project, adjustment);
  assert.deepEqual(applied.points.map(({ xyz }) => xyz), adjustment.points.map(({ xyz }) => xyz));
  assert.equal(applied.cameras[0].c, adjustment.cameras[0].c);
});

test('what takes no part is listed, whatever took it out', () => {
  const project = sightline.simulate(network());
  assert.deepEqual(sightline.adjust(project).left_out, []);
  const [first, second] = project.observations;
  Object.assign(first, { enabled: false });
  Object.assign(second, { enabled: false, u: second.u + 148 });
  project.set_aside = [first, second].map(({ photo, point }) => ({ photo, point, reason: 'disagrees' }));
  const adjustment = sightline.adjust(project);
  // What fits is back, on record.
  const [item] = adjustment.left_out;
  assert.equal(adjustment.left_out.length, 1);
  assert.deepEqual([item.kind, item.photo, item.point, item.by, item.reason], ['observation', second.photo, second.point, 'orientation', 'disagrees']);
  assert.ok(Math.abs(item.size_px - 148) < 1 && item.size_sigma > 500, JSON.stringify(item));
  assert.deepEqual(adjustment.gross_errors.map(({ photo, point, action, round }) => [photo, point, action, round]), [[first.photo, first.point, 'restored', 0]]);
  const applied = sightline.applyAdjustment(project, adjustment);
  assert.deepEqual(applied.set_aside.map(({ point }) => point), [second.point]);
  assert.deepEqual(applied.observations.filter(({ enabled }) => !enabled).length, 1);
});

test('a gross error in a distance is taken out by name, with its record', () => {
  const distances = [['p0', 'p7'], ['p3', 'p12'], ['p5', 'p14']].map(([from, to]) => ({ from, to, sigma: 0.01 }));
  const project = sightline.simulate(network({ distances }));
  project.distances[1].length += 3;
  const found = sightline.adjust(project, { snooping: true });
  const { given, action, statistic, limit, consequence, photo, point } = found.gross_errors[0];
  assert.deepEqual({ given, action, consequence, photo, point }, { given: { kind: 'distance', from: 'p3', to: 'p12' }, action: 'removed', consequence: false, photo: '', point: '' });
  assert.ok(statistic > limit);
  assert.deepEqual(found.given.map(({ from, enabled }) => [from, enabled]), [['p0', true], ['p5', true], ['p3', false]]);
  assert.ok(Math.abs(found.given[2].residual + 3) < 0.1, `${found.given[2].residual}`);
  const [first] = found.given;
  assert.ok(first.effect > 0 && ['p0', 'p7'].includes(first.effect_point), JSON.stringify(first));
  const files = sightline.exportProject('csv', project, found);
  const lines = (name) => new TextDecoder().decode(files[name]).trim().split('\n');
  assert.equal(lines('given.csv').length, 4);
  assert.match(lines('gross_errors.csv')[1], /^1,removed,distance,,p3,p12,/);
  const robust = sightline.adjust(project, { robust: 'tukey' });
  assert.ok(robust.given[1].weight < 0.01 && robust.given[1].enabled, JSON.stringify(robust.given[1]));
});

test('adjusted observations, made when they are read, are a field like any other', () => {
  const project = sightline.simulate(network());
  const adjusted = () => sightline.adjust(project);
  const rows = adjusted().observations;
  assert.equal(rows.length, 6 * 20);
  const read = adjusted();
  assert.ok(Object.keys(read).includes('observations'));
  assert.equal(read.observations, read.observations);
  assert.deepEqual(structuredClone(adjusted()).observations, rows);
  assert.deepEqual(JSON.parse(JSON.stringify(adjusted())).observations, rows);
  assert.deepEqual({ ...adjusted() }.observations, rows);
  assert.deepEqual(Object.freeze(adjusted()).observations, rows);
  assert.deepEqual(Object.seal(adjusted()).observations, rows);
  const written = adjusted();
  written.observations = [];
  assert.deepEqual(written.observations, []);
  // Other calls in between take the engine's memory that the columns came from.
  const first = adjusted();
  sightline.adjust(sightline.simulate(network({ seed: 3 })));
  assert.deepEqual(first.observations, rows);
});

test('statistics are left out when they are not wanted', () => {
  const project = sightline.simulate(network());
  const lean = sightline.adjust(project, { statistics: 'none' });
  assert.equal(lean.points[0].covariance, undefined);
  assert.equal(lean.points[0].sigma, undefined);
  assert.equal(sightline.adjust(project, { max_iterations: 1 }).iterations.length, 1);
});

test('the callback stops the work; what it throws is its own', () => {
  const project = sightline.simulate(network());
  const moved = { ...project, points: project.points.map((point) => ({ ...point, xyz: point.xyz.map((x) => x + 30 * Math.sin(x)) })) };
  let calls = 0;
  const stopped = sightline.adjust(moved, { on_iteration: () => ++calls < 2 });
  assert.equal(stopped.termination, 'stopped');
  assert.equal(calls, 2);
  const own = new RangeError('mine');
  assert.equal(thrown(() => sightline.adjust(moved, { on_iteration: () => { throw own; } })), own);
});

test('what is wrong is named: options, references, networks', () => {
  const project = sightline.simulate(network());
  const field = (options) => {
    const error = thrown(() => sightline.adjust(project, options));
    assert.equal(error.code, 'invalid');
    return error.where.field;
  };
  assert.equal(field({ iterations: 3 }), 'iterations');
  assert.equal(field({ max_iterations: -1 }), 'max_iterations');
  assert.equal(field({ max_iterations: 2.5 }), 'max_iterations');
  assert.equal(field({ statistics: 'some' }), 'statistics');
  assert.equal(field({ robust: 'strong' }), 'robust');
  assert.equal(field({ snooping: 1 }), 'snooping');
  assert.equal(field({ on_iteration: 'often' }), 'on_iteration');
  assert.equal(field(7), 'options');

  const without = (change) => {
    const copy = structuredClone(project);
    change(copy);
    return thrown(() => sightline.adjust(copy));
  };
  assert.equal(without((p) => (p.observations = [])).code, 'empty');
  const missing = without((p) => (p.photos[2].position = null));
  assert.deepEqual([missing.code, missing.where.photo], ['missing_initial_values', 's2']);
  const stray = without((p) => (p.observations[5].point = 'nobody'));
  assert.equal(stray.code, 'unknown');
  const once = without((p) => (p.observations = p.observations.filter(({ point }, k) => point !== 'p4' || k < 20)));
  assert.deepEqual([once.code, once.where.point], ['rank_defect', 'p4']);
  const loose = without((p) => {
    p.distances = [];
    p.datum = { kind: 'control', points: null };
  });
  assert.equal(loose.code, 'rank_defect');
  assert.match(loose.message, /datum/);
});

test('camcal: the published calibration from the marks alone', { skip }, () => {
  const marks = sightline.importProject('mark-points', { 'markpts.txt': data('camcal/markpts.txt') });
  const control = sightline.importProject('control-csv', { 'fixed.txt': data('camcal/camcal-fixed.txt') });
  const start = sightline.importProject('photomodeler', { 'export.txt': data('camcal/camcal-pmexport.txt') });
  const published = { c: 7.457, x0: 3.61546, y0: 2.61329, k1: 0.00458861, k2: -4.51351e-5, k3: -2.05253e-6, p1: -6.12803e-5, p2: -4.41172e-5 };
  const sigmas = { c: 0.00105, x0: 0.00082, y0: 0.00098, k1: 2.21e-5, k2: 2.65e-6, k3: 1.01e-7, p1: 3.52e-6, p2: 3.94e-6 };
  // The published affinity multiplies x before the distortion: here it is a matter of the pixel pitch.
  const [square, affinity] = [5.43764 / 1704, 1 + 3.89598e-4];
  const pitch = [square * affinity, square];
  published.x0 = published.x0 * affinity - (pitch[0] * 2272) / 2;
  published.y0 = 5.43764 / 2 - published.y0;

  const camera = { ...start.cameras[0], pixel_pitch: pitch, free: Object.keys(published) };
  // Photos are counted from 0 in the export and from 1 among the marks; 1001 to 1004 are the sheet's corners.
  const photos = start.photos.map((photo) => ({ ...photo, id: String(Number(photo.id) + 1) }));
  const known = new Map([...start.points, ...control.points].map((point) => [point.id, point]));
  const points = marks.points.map(({ id }) => known.get(id));
  const project = { ...marks, unit: 'm', cameras: [camera], photos, points, datum: { kind: 'control', points: null } };

  // Published with residuals at the corrected place.
  const options = { residuals: 'corrected' };
  const adjustment = sightline.adjust(project, options);
  assert.equal(adjustment.termination, 'converged');
  assert.deepEqual([adjustment.observations_count, adjustment.unknowns, adjustment.redundancy], [4148, 422, 3726]);
  assert.ok(Math.abs(adjustment.sigma0 / 1.6148 - 1) < 0.01, `sigma0 ${adjustment.sigma0}`);
  const [found] = adjustment.cameras;
  for (const [name, value] of Object.entries(published)) {
    assert.ok(Math.abs(found[name] - value) < 0.1 * sigmas[name], `${name}: ${found[name]}, published ${value}`);
  }
  // With the affinity estimated, as published: one unknown more.
  const with_b1 = sightline.adjust({ ...project, cameras: [{ ...camera, pixel_pitch: [square, square], free: [...camera.free, 'b1'] }] }, options);
  assert.equal(with_b1.redundancy, 3725);
  assert.ok(Math.abs(with_b1.sigma0 / 1.6148 - 1) < 0.01, `sigma0 ${with_b1.sigma0}`);
  // The published sigmas hold with the affinity estimated.
  for (const [name, sigma] of Object.entries(sigmas)) {
    const ratio = with_b1.cameras[0].sigma[name] / sigma;
    assert.ok(Math.abs(ratio - 1) < 0.02, `sigma of ${name}: ${with_b1.cameras[0].sigma[name]}, published ${sigma}`);
  }
});

test('equations and steps are laid open, and agree with each other and with the adjustment', () => {
  const project = sightline.simulate(network({ seed: 11 }));
  for (const point of project.points) if (point.role === 'tie') point.xyz = point.xyz.map((x, k) => x + 0.5 * (k - 1));
  const { unknowns, observations, A, l, p, constraints } = sightline.linearise(project);
  assert.deepEqual([A.rows, A.columns, l.length, p.length], [observations.length, unknowns.length, observations.length, observations.length]);
  // A'Pl by hand.
  const b = new Array(A.columns).fill(0);
  for (let row = 0; row < A.rows; row++) for (let k = A.row_starts[row]; k < A.row_starts[row + 1]; k++) b[A.column_indices[k]] += A.values[k] * p[row] * l[row];
  const equations = sightline.normalEquations(project);
  b.forEach((value, k) => assert.ok(Math.abs(value - equations.b[k]) <= 1e-9 * Math.max(1, Math.abs(value)), unknowns[k].name));
  assert.equal(equations.null_space.length, constraints.rows);
  assert.equal(equations.rank, unknowns.length - constraints.rows);
  assert.match(sightline.matrixMarket(equations.N), new RegExp(`^%%MatrixMarket matrix coordinate real general\n${A.columns} ${A.columns} ${equations.N.values.length}\n`));
  const adjuster = sightline.startAdjustment(project);
  assert.equal(adjuster.state().step, 0);
  let state;
  do state = adjuster.step();
  while (!state.termination);
  const whole = adjuster.finish();
  assert.equal(state.step, whole.iterations.length);
  assert.ok(Math.abs(state.sigma0 / whole.sigma0 - 1) < 1e-9);
  assert.equal(adjuster.back().step, state.step - 1);
  assert.throws(() => sightline.linearise({ ...project, observations: [] }), { code: 'empty' });
});
