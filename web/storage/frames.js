// Frames: what a journal is made of. A frame is a length, a checksum (CRC-32) and a JSON array of items.
//
// A journal that was being written when everything stopped ends with the beginning of a frame: that is a cut end, and no damage. Anything
// else that is not a whole frame is damage. A frame in which one bit has changed is mended: the difference of the two checksums shows which.
// Beyond damage that cannot be mended the next whole frame is looked for.

const TABLE = Int32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});

/** Bytes before a frame's body. */
const HEAD = 8;

export function checksum(bytes) {
  let c = ~0;
  for (let i = 0; i < bytes.length; i++) c = TABLE[(c ^ bytes[i]) & 255] ^ (c >>> 8);
  return ~c >>> 0;
}

/** Items as a frame. */
export function framed(items) {
  const body = new TextEncoder().encode(JSON.stringify(items));
  const bytes = new Uint8Array(HEAD + body.length);
  const head = new DataView(bytes.buffer);
  head.setUint32(0, body.length);
  head.setUint32(4, checksum(body));
  bytes.set(body, HEAD);
  return bytes;
}

const isOneBit = (number) => number !== 0 && (number & (number - 1)) === 0;

/**
 * A body in which at most one bit differs from what its checksum was made of, as it was; none where more differs. CRC-32 is linear: the two
 * checksums differ by that of the error alone, which for one bit is found by going through all places of it, from the last byte on.
 */
function mended(body, wanted) {
  const error = (checksum(body) ^ wanted) | 0;
  // The bit is one of the checksum.
  if (isOneBit(error)) return body;
  const ofBits = Int32Array.from({ length: 8 }, (_, bit) => TABLE[1 << bit]);
  for (let at = body.length - 1; at >= 0; at--) {
    for (let bit = 0; bit < 8; bit++) {
      if (ofBits[bit] === error) {
        const whole = body.slice();
        whole[at] ^= 1 << bit;
        return whole;
      }
      ofBits[bit] = TABLE[ofBits[bit] & 255] ^ (ofBits[bit] >>> 8);
    }
  }
  return null;
}

const parsed = (body) => {
  try {
    const items = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(body));
    return Array.isArray(items) ? items : null;
  } catch {
    return null;
  }
};

/**
 * Bytes as frames: all that are whole, in their order, with where they begin and end and whether they were mended; `end` is where the first
 * gap is, or the end of the last frame; `gap` is the number of frames before the first gap, where frames follow that; `tail` is whether the
 * last frame was written whole and is damaged; `damaged` is whether anything is wrong but a cut end.
 */
export function unframed(bytes) {
  const head = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const size = bytes.length;
  const frame = (at, length, mend) => {
    if (length === 0 || at + HEAD + length > size) return null;
    const body = bytes.subarray(at + HEAD, at + HEAD + length);
    const isWhole = checksum(body) === head.getUint32(at + 4);
    const was = isWhole ? body : mend && mended(body, head.getUint32(at + 4));
    const items = was && parsed(was);
    return items && { at, end: at + HEAD + length, items, mended: !isWhole };
  };
  const frames = [];
  let [at, end, gap, damaged, tail] = [0, null, null, false, false];
  while (at + HEAD <= size) {
    const length = head.getUint32(at);
    let next = frame(at, length, true);
    if (!next) {
      // The next whole frame: its body is an array of objects.
      let from = at + 1;
      let found = null;
      for (; from + HEAD < size && !found; from++) {
        if (bytes[from + HEAD] === 0x5b && bytes[from + HEAD + 1] === 0x7b) found = frame(from, head.getUint32(from), false);
      }
      // One bit of the length itself: the frame ends where the next one begins, or the bytes do.
      const real = (found?.at ?? size) - at - HEAD;
      next = isOneBit(real ^ length) ? frame(at, real, false) : null;
      if (next) next.mended = true;
      else if (found) {
        end ??= at;
        gap ??= frames.length;
        damaged = true;
        next = found;
      } else {
        // A length beyond the end is that of a frame that was being written; zeros are a file's room that nothing was written to yet.
        tail = at + HEAD + length <= size && bytes.subarray(at).some((byte) => byte !== 0);
        damaged ||= tail;
        break;
      }
    }
    damaged ||= next.mended;
    frames.push(next);
    at = next.end;
  }
  return { frames, end: end ?? frames.at(-1)?.end ?? 0, gap, tail, damaged };
}

/** The items of frames, one after the other. */
export const itemsOf = (frames) => frames.flatMap(({ items }) => items);
