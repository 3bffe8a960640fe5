// Lists of points and of distances from JavaScript: the axes of the user, scale bars.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sightline, thrown } from './engine.mjs';

const bytes = (text) => new TextEncoder().encode(text);
const text = (content) => new TextDecoder().decode(content);

test('a list with the north first brings its axes, and every list is written in them', () => {
  const files = { 'list.csv': bytes('id,N [m],E [m],H [m],sN,sE,sH\nA,5000.25,3000.5,31.125,0.001,0.002,0.003\n') };
  const project = sightline.importProject('control-csv', files);
  assert.equal(project.axes, 'neh');
  // The document is right-handed: X to the east.
  assert.deepEqual(project.points[0].xyz, [3000.5, 5000.25, 31.125]);
  assert.deepEqual(project.points[0].sigma, [0.002, 0.001, 0.003]);
  const control = sightline.exportProject('control-csv', project);
  assert.equal(text(control['control.csv']), 'id,N,E,H,sN,sE,sH,role\nA,5000.25,3000.5,31.125,0.001,0.002,0.003,control\n');
  assert.match(text(sightline.exportProject('csv', project)['points.csv']), /^id,role,N \[m\],E \[m\],H \[m\],sN \[m\],/);
  assert.equal(thrown(() => sightline.exportProject('csv', { ...project, axes: 'nuh' })).code !== undefined, true);
  // Rows without a heading stand as the coordinates of their project do; letters X and Y say no direction.
  const pasted = sightline.importProject('control-csv', { 'rows.txt': bytes('A 5000.25 3000.5 31.125\n') }, { project_axes: 'neh' });
  assert.deepEqual(pasted.points[0].xyz, [3000.5, 5000.25, 31.125]);
  const lettered = sightline.importProject('control-csv', { 'rows.csv': bytes('id;Y;X;H\nA;1.5;2.5;3.5\n') });
  assert.equal(lettered.axes ?? null, null);
});

test('a list of distances becomes scale bars, and what it leaves open is refused', () => {
  const read = (content, choices) => sightline.importProject('distances', { 'bars.csv': bytes(content) }, choices);
  const { distances, unit } = read('from,to,length [mm],sigma [µm]\nA,B,500.25,20\n');
  assert.equal(unit, 'mm');
  assert.deepEqual({ ...distances[0], sigma: Math.round(distances[0].sigma * 1e6) / 1e6, check: false }, { from: 'A', to: 'B', length: 500.25, sigma: 0.02, check: false });
  const { where } = thrown(() => read('from,to,length\nA,B,500.25\n'));
  assert.equal(where.field, 'sigma');
  assert.equal(read('from,to,length\nA,B,500.25\n', { unit: 'mm', sigma: { constant: 0.02, ppm: 0 } }).distances.length, 1);
});
