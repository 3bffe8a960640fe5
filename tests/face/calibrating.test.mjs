// Calibrations from JavaScript: photos taken together, what photos cover, models proposed and compared, correlations in groups.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sightline, thrown } from './engine.mjs';

/** Two cameras side by side walk round thirty points. */
function stereo() {
  const stations = [];
  for (let k = 0; k < 6; k++) {
    const turn = k * 1.05;
    const place = [900 * Math.cos(turn), 900 * Math.sin(turn), 500 + 60 * (k % 3)];
    const aside = [place[0] - 200 * Math.sin(turn), place[1] + 200 * Math.cos(turn), place[2]];
    for (const [camera, position] of [['left', place], ['right', aside]]) stations.push({ id: `${camera}${k}`, camera, position, look_at: [0, 0, 0], roll: 0 });
  }
  const camera = (id) => ({ id, width: 1600, height: 1200, pixel_pitch: [0.005, 0.005], model: 'brown', c: 9, free: ['c', 'x0', 'y0', 'k1', 'k2', 'k3'] });
  const points = Array.from({ length: 30 }, (_, k) => ({ id: `p${k}`, xyz: [((k * 37) % 60) * 8 - 240, ((k * 17) % 60) * 8 - 240, ((k * 29) % 60) * 4 - 120] }));
  const project = sightline.simulate({ cameras: [camera('left'), camera('right')], stations, points, sigma: 0.1, seed: 3 });
  project.rig = { exposures: Array.from({ length: 6 }, (_, k) => [`left${k}`, `right${k}`]), sigma_position: 5, sigma_rotation: 0.01 };
  return project;
}

test('photos taken together have one relative pose in the result', () => {
  const project = stereo();
  const result = sightline.adjust(project);
  assert.equal(result.termination, 'converged');
  const [pose] = result.rig;
  assert.deepEqual([pose.camera, pose.relative_to, pose.exposures.length], ['right', 'left', 6]);
  assert.ok(Math.abs(pose.base - 200) < 5 && pose.sigma_base > 0 && pose.scatter_position >= 0, JSON.stringify(pose));
  const bare = sightline.adjust({ ...project, rig: undefined });
  assert.equal(bare.rig, undefined);
  assert.equal(result.redundancy, bare.redundancy + 30);
  const [report] = Object.values(sightline.exportProject('report', project, result));
  assert.match(new TextDecoder().decode(report), /Cameras fixed to each other/);
  const wrong = { ...project, rig: { ...project.rig, exposures: [['left0', 'left1']] } };
  wrong.rig.exposures.push(['right0', 'left2']);
  const error = thrown(() => sightline.adjust(wrong));
  assert.deepEqual([error.code, error.data.reason.kind], ['invalid', 'rig_camera']);
});

test('correlations come in groups, coverage and proposals are told', () => {
  const project = stereo();
  const result = sightline.adjust(project);
  const pairs = result.advice.filter((advice) => advice.kind === 'high_correlation');
  assert.ok(pairs.length > 2, 'K1, K2 and K3 go together');
  assert.equal(result.correlation_groups.reduce((sum, group) => sum + group.pairs.length, 0), pairs.length);
  assert.ok(result.correlation_groups.length <= 2 + project.photos.length);
  const covered = sightline.calibrationCoverage(project, 'left');
  assert.deepEqual([covered.photos, covered.rings.length, covered.cells.length], [6, 5, 6]);
  assert.ok(covered.lacks.includes('photos'));
  assert.deepEqual(sightline.proposedModels(project.cameras[0], 500)[0], 'opencv_fisheye');
  assert.deepEqual(sightline.proposedModels(project.cameras[0], 5000), []);
});

test('uncertainty by distance is that of the map, and bands have all measurements', () => {
  const project = stereo();
  const result = sightline.adjust(project);
  const found = sightline.uncertaintyOverDistance(project, result, { camera: 'left' });
  assert.deepEqual([found.distances.length, found.places.length], [33, 5]);
  assert.ok(found.measured[0] > 500 && found.measured[1] < 1500, String(found.measured));
  const distance = found.distances[20];
  const map = sightline.projectionUncertainty(project, result, { camera: 'left', grid: [3, 3], distance, reference: 'photos' });
  assert.ok(Math.abs(found.places[0].sigma[20] / map.sigma[1][1] - 1) < 1e-9);
  const bands = sightline.residualBands(project, result, { camera: 'left', bands: 4 });
  const measured = project.observations.filter(({ photo }) => photo.startsWith('left')).length;
  for (const all of [bands.columns, bands.rows]) assert.equal(all.reduce((sum, band) => sum + band.count, 0), measured);
  const error = thrown(() => sightline.uncertaintyOverDistance(project, result, { camera: 'left', places: [[-5, 0]] }));
  assert.deepEqual([error.code, error.data.reason.kind, error.where.field], ['invalid', 'calibration_places', 'places']);
});
