// Two results of the engine, number by number. The comparison of node:assert would write out how large ones differ, for minutes.
import assert from 'node:assert/strict';

/** Fails at the first difference; numbers may differ by `limit`, those above 1 by that share of them, and at 0 not in a bit. */
export function compare(a, b, limit, path) {
  if (typeof a === 'number' && typeof b === 'number') {
    const share = /\.[uv]$/.test(path) ? 1 : Math.max(1, Math.abs(b));
    assert.ok(Object.is(a, b) || (limit > 0 && Math.abs(a - b) <= limit * share), `${path}: ${a} and ${b}`);
  } else if (a === null || b === null || typeof a !== 'object' || typeof b !== 'object') {
    assert.equal(a, b, path);
  } else {
    assert.deepEqual(Object.keys(a).sort(), Object.keys(b).sort(), path);
    for (const key of Object.keys(a)) compare(a[key], b[key], limit, `${path}.${key}`);
  }
}
