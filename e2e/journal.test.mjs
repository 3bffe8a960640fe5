// The bytes of a journal: cut ends, flipped bits and larger damage, drawn at random with a seed (SIGHTLINE_SEED).
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

// As a module whatever its folder says: Node before 20.19 asks a package.json.
const source = readFileSync(new URL('../web/storage/frames.js', import.meta.url), 'base64');
const { checksum, framed, unframed } = await import(`data:text/javascript;base64,${source}`);

let state = Number(process.env.SIGHTLINE_SEED ?? 20_251_127);
const random = (n) => Math.floor(((state = (state * 48_271) % 2_147_483_647) / 2_147_483_647) * n);

/** A journal of some frames, with where each begins. */
function journal(count) {
  const all = Array.from({ length: count }, (_, k) => [{ part: { id: k, kind: 'project', words: `${'x[{"á'.repeat(random(60))}${k}` } }, { note: `n${k}` }]);
  const frames = all.map(framed);
  const starts = frames.map((_, k) => frames.slice(0, k).reduce((sum, frame) => sum + frame.length, 0));
  return { all, starts, frames, bytes: Uint8Array.from(frames.flatMap((frame) => [...frame])) };
}

const items = ({ frames }) => frames.map((frame) => frame.items);

test('the checksum is the CRC-32 of everybody', () => {
  assert.equal(checksum(new TextEncoder().encode('123456789')), 0xcbf43926);
});

test('a journal that is cut anywhere gives its whole frames, and is not damaged', () => {
  for (let round = 0; round < 200; round++) {
    const { all, starts, bytes } = journal(1 + random(8));
    const cut = random(bytes.length + 1);
    const read = unframed(bytes.slice(0, cut));
    const whole = [...starts.slice(1), bytes.length].filter((end) => end <= cut).length;
    assert.deepEqual(items(read), all.slice(0, whole));
    assert.deepEqual([read.damaged, read.gap, read.end], [false, null, starts[whole] ?? bytes.length]);
    // Room that nothing was written to yet.
    const roomy = new Uint8Array(cut + random(600));
    roomy.set(bytes.subarray(0, cut));
    if (cut === (starts[whole] ?? bytes.length)) assert.equal(unframed(roomy).damaged, false);
  }
});

test('one flipped bit loses nothing wherever it is, and is told', () => {
  for (let round = 0; round < 2000; round++) {
    const { all, starts, bytes } = journal(1 + random(8));
    const [at, bit] = [random(bytes.length), random(8)];
    bytes[at] ^= 1 << bit;
    const read = unframed(bytes);
    // The length of the last frame, made longer, looks like that of a frame that was being written; its checksum says that it is whole.
    assert.deepEqual(items(read), all, `byte ${at}, bit ${bit}, the last frame at ${starts.at(-1)}`);
    assert.deepEqual([read.damaged, read.gap, read.tail], [true, null, false]);
  }
});

test('larger damage loses the frames that it is in, and no other', () => {
  for (let round = 0; round < 1000; round++) {
    const { all, starts, bytes } = journal(3 + random(8));
    const [from, length] = [random(bytes.length - 12), 3 + random(600)];
    const to = Math.min(bytes.length, from + length);
    for (let i = from; i < to; i++) bytes[i] = random(256);
    const hurt = (k) => (starts[k + 1] ?? bytes.length) > from && starts[k] < to;
    const read = unframed(bytes);
    assert.deepEqual(items(read), all.filter((_, k) => !hurt(k)));
    assert.equal(read.damaged || hurt(all.length - 1), true);
    const first = all.findIndex((_, k) => hurt(k));
    assert.equal(read.gap, all.some((_, k) => k > first && !hurt(k)) ? first : null);
    assert.equal(read.end, starts[first]);
  }
});
