// What both kinds of storage have in common.

export const fault = (name, message) => Object.assign(new Error(message), { name });
export const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
export const absent = (error) => error.name === 'NotFoundError';

/** Bytes read or written of a photo at a time. */
export const PIECE = 1 << 20;

/**
 * A journal out of what one generation of it has. `items` are those before damage that cannot be mended, or all of them; `end` and `size` are
 * where its writer goes on; `newest` is the highest generation there is.
 */
export const journalOf = (generation, newest, read, end) => {
  const before = read.gap === null ? read.frames : read.frames.slice(0, read.gap);
  return { generation, newest, frames: read.frames, gap: read.gap, tail: read.tail, damaged: read.damaged, items: before.flatMap(({ items }) => items), end, size: read.end };
};
