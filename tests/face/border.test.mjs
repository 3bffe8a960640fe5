// What crosses the border: objects, bytes, and errors that say where.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { document, sightline, thrown } from './engine.mjs';

const decode = (bytes) => JSON.parse(new TextDecoder().decode(bytes));
const json = (project) => decode(sightline.exportProject('sightline', project)['project.json']);

test('a document crosses in both directions unchanged, by the fast tables and as JSON', () => {
  const written = sightline.exportProject('sightline', document());
  const read = sightline.importProject('sightline', written);
  // The engine's own JSON (serde) against the rows that the tables make: the fast way against the plain one.
  assert.deepEqual(read, decode(written['project.json']));
  assert.deepEqual(json(read), read);
  assert.equal(read.cameras[0].id, '1');
  assert.equal(read.observations[0].point, '1001');
  assert.deepEqual(read.observations[1].sigma, [0.1, 0.2]);
  assert.equal(read.observations[1].enabled, false);
  assert.deepEqual(read.points[0].sigma, [0.1, null, 0]);
  assert.equal(read.points[2].xyz, null);
  assert.deepEqual(read.points[1].normal, [0, 0.6, -0.8]);
  assert.ok(!('normal' in read.points[0]));
});

test('documents from nowhere are refused with a place', () => {
  const broken = (change) => {
    const project = document();
    change(project);
    return thrown(() => sightline.exportProject('sightline', project));
  };
  const cases = [
    [(p) => delete p.format, 'format'],
    [(p) => (p.version = 2), 'version'],
    [(p) => (p.cameras = {}), 'cameras'],
    [(p) => (p.cameras[0].width = 'wide'), 'cameras[0]'],
    [(p) => (p.photos[1].position = [1, 2]), 'photos[1].position'],
    [(p) => (p.photos[0].rotation = 'upright'), 'photos[0].rotation'],
    [(p) => (p.points = 'none'), 'points'],
    [(p) => (p.points[1].role = 'boss'), 'points[1].role'],
    [(p) => (p.points[1].xyz = [0, NaN, 0]), 'points[1].xyz'],
    [(p) => (p.points[1].normal = [0, 1]), 'points[1].normal'],
    [(p) => (p.points[0] = null), 'points[0]'],
    [(p) => (p.observations[2].u = '7'), 'observations[2].u'],
    [(p) => (p.observations[2].v = Infinity), 'observations[2].v'],
    [(p) => delete p.observations[0].sigma, 'observations[0].sigma'],
    [(p) => (p.observations[0].photo = {}), 'observations[0].photo'],
    [(p) => (p.observations[0].enabled = 1), 'observations[0].enabled'],
    [(p) => (p.observations[0].target = 1.5), 'observations[0].target'],
    [(p) => (p.datum.kind = 'loose'), 'datum.kind'],
  ];
  for (const [change, field] of cases) {
    const error = broken(change);
    assert.equal(error.code, 'invalid', `${field}: ${error.message}`);
    assert.ok(error.where.field?.startsWith(field), `${field}, not ${error.where.field}: ${error.message}`);
  }
  const error = broken((p) => (p.observations[1].u = null));
  assert.equal(error.where.photo, 'p2');
  assert.equal(error.where.point, 'x');
  assert.deepEqual(error.data.reason, { kind: 'not_of_kind', name: 'observations[1].u', expected: 'finite_number' });
  assert.equal(error.data.detail, 'observations[1].u is not a finite number');
  const newer = broken((p) => (p.version = '2'));
  assert.deepEqual(newer.data.reason, { kind: 'newer_version', version: '2' });
});

test('arguments of a wrong kind are errors, never traps', () => {
  const odd = [undefined, null, 0, NaN, 'text', true, [], {}, Symbol('s'), 10n, () => 1, new Uint8Array(3), new Date(), new Map()];
  const format = { format: 'sightline', version: 1 };
  for (const a of odd) {
    for (const b of odd) {
      for (const action of [() => sightline.importProject(a, b), () => sightline.importProject('sightline', { 'a.json': a, b }), () => sightline.exportProject(a, b), () => sightline.exportProject('csv', a, b)]) {
        const error = thrown(action);
        assert.ok(['invalid', 'unknown', 'empty'].includes(error.code), `${String(a)}, ${String(b)}: ${error.code} ${error.message}`);
        assert.equal(typeof error.where, 'object');
      }
    }
    if (a !== null && a !== undefined) thrown(() => sightline.exportProject('csv', format, a));
  }
});

test('arguments that fight back have codes, and later calls work', () => {
  const detached = () => {
    const buffer = new ArrayBuffer(8);
    structuredClone(buffer, { transfer: [buffer] });
    return buffer;
  };
  const withoutBytes = () => {
    const bytes = new Uint8Array(8);
    structuredClone(bytes.buffer, { transfer: [bytes.buffer] });
    return bytes;
  };
  const cyclic = document();
  cyclic.cameras[0].self = cyclic;
  const deep = document();
  deep.name = Array.from({ length: 5000 }).reduce((inner) => ({ inner }), {});
  const throwing = Object.defineProperty({}, 'format', {
    enumerable: true,
    get() {
      throw { toString: () => { throw new Error('again'); } };
    },
  });
  const rows = document();
  rows.observations = new Proxy([], { get: () => { throw new Error('no'); } });
  const row = document();
  row.points[1] = new Proxy({}, { get: () => { throw new Error('no'); } });
  const revoked = Proxy.revocable([], {});
  revoked.revoke();
  const half = document();
  half.cameras[0].sigma = [null];
  const long = document();
  long.photos = new Array(4e9);
  const longRows = { ...document(), observations: new Array(4e9) };
  const at = (field) => (error) => assert.ok(error.where.field?.startsWith(field), `${field}: ${error.where.field} ${error.message}`);
  const adjust = (project) => () => sightline.adjust(project);
  const cases = [
    [adjust(half), at('cameras[0]')],
    [adjust(cyclic), at('cameras[0].self')],
    [adjust(deep), at('name.inner')],
    [adjust(throwing), at('format')],
    [adjust(rows), at('observations')],
    [adjust(row), at('points[1]')],
    [adjust(long), at('photos')],
    [adjust(longRows), at('observations')],
    [adjust({ ...document(), points: revoked.proxy }), at('points')],
    [adjust(new Proxy({}, { ownKeys: () => { throw new Error('no'); } })), () => {}],
    [() => sightline.adjust(document(), { get robust() { throw new Error('no'); } }), at('robust')],
    [() => sightline.adjust(document(), { covariance_of: new Array(4e9) }), at('covariance_of')],
    [() => sightline.adjust(document(), { get on_iteration() { throw new Error('no'); } }), at('on_iteration')],
    [() => sightline.photoInfo(detached()), at('bytes')],
    [() => sightline.photoInfo(withoutBytes()), at('bytes')],
    [() => sightline.detectGray(2, 2, withoutBytes()), at('samples')],
    [() => sightline.importProject('sightline', { 'a.json': detached() }), at('files.a.json')],
    [() => sightline.importProject('sightline', { get a() { throw new Error('no'); } }), at('files.a')],
    [() => sightline.nameCoded([{ photo: 'a', targets: [10n] }]), at('photos[0].targets[0]')],
  ];
  for (let round = 0; round < 400; round++) {
    for (const [action, look] of cases) {
      const error = thrown(action);
      assert.equal(error.code, 'invalid', error.message);
      look(error);
    }
  }
  assert.equal(decode(sightline.exportProject('sightline', document())['project.json']).format, 'sightline');
});

test('formats that do not exist are named with those that do', () => {
  const error = thrown(() => sightline.importProject('docx', { 'a.docx': new Uint8Array(3) }));
  assert.equal(error.code, 'unknown');
  assert.match(error.message, /photomodeler/);
  assert.deepEqual([error.data.kind, error.data.name], ['format', 'docx']);
  assert.equal(thrown(() => sightline.exportProject('docx', document())).code, 'unknown');
});

test('files may be bytes of any kind or text', () => {
  const text = '1,2,3.5,4.5,0.1\n';
  const bytes = new TextEncoder().encode(text);
  for (const file of [text, bytes, bytes.buffer, Buffer.from(text)]) {
    const project = sightline.importProject('mark-points', { 'marks.txt': file });
    assert.deepEqual(project.observations, [{ photo: '1', point: '2', u: 3.5, v: 4.5, sigma: 0.1, enabled: true }]);
  }
  const error = thrown(() => sightline.importProject('mark-points', { 'marks.txt': '1,2,x,4' }));
  assert.deepEqual(error.where, { file: 'marks.txt', line: 1, field: 'u' });
});

test('a project file with everything survives', () => {
  const files = sightline.exportProject('package', document());
  assert.deepEqual(Object.keys(files), ['project.sightline']);
  assert.deepEqual(sightline.importProject('package', files), sightline.importProject('sightline', sightline.exportProject('sightline', document())));
  const bytes = files['project.sightline'];
  for (const cut of [0, 10, bytes.length >> 1, bytes.length - 1]) {
    assert.equal(thrown(() => sightline.importProject('package', { 'a.sightline': bytes.slice(0, cut) })).code, 'invalid');
  }
});
