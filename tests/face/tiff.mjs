// A picture as a file.

/** Grey samples of 8 or 16 bits as an uncompressed TIFF of one strip. */
export function tiff(width, height, samples) {
  const bytes = samples.BYTES_PER_ELEMENT;
  // Tag and value, each a long: width, height, bits, no compression, black is zero, where the strip lies, its rows and bytes.
  const fields = [[256, width], [257, height], [258, 8 * bytes], [259, 1], [262, 1], [273, 8], [277, 1], [278, height], [279, samples.byteLength]];
  const directory = 8 + samples.byteLength + (samples.byteLength & 1);
  const file = Buffer.alloc(directory + 2 + 12 * fields.length + 4);
  file.write('II*\0', 'latin1');
  file.writeUInt32LE(directory, 4);
  for (let i = 0; i < samples.length; i++) file.writeUIntLE(samples[i], 8 + i * bytes, bytes);
  file.writeUInt16LE(fields.length, directory);
  fields.forEach(([tag, value], i) => {
    const at = directory + 2 + 12 * i;
    file.writeUInt16LE(tag, at);
    file.writeUInt16LE(4, at + 2);
    file.writeUInt32LE(1, at + 4);
    file.writeUInt32LE(value, at + 8);
  });
  return file;
}

/** Grey samples of 8 bits as a BMP with a palette, from the bottom up in rows of whole words. */
export function bmp(width, height, samples) {
  const stride = (width + 3) & ~3;
  const start = 54 + 4 * 256;
  const file = Buffer.alloc(start + stride * height);
  file.write('BM', 'latin1');
  // Size, reserved, where the rows begin, bytes of the header, width, height, one plane of 8 bits.
  [file.length, 0, start, 40, width, height, 1 | (8 << 16)].forEach((value, i) => file.writeUInt32LE(value, 2 + 4 * i));
  for (let level = 0; level < 256; level++) file.fill(level, 54 + 4 * level, 57 + 4 * level);
  for (let y = 0; y < height; y++) file.set(samples.subarray(y * width, (y + 1) * width), start + stride * (height - 1 - y));
  return file;
}

/** Grey samples of 8 bits as a TIFF with a palette from white to black, of so many bits a pixel. */
export function paletteTiff(width, height, samples, bits) {
  const last = (1 << bits) - 1;
  const stride = Math.ceil((width * bits) / 8);
  const strip = new Uint8Array(stride * height);
  samples.forEach((sample, i) => {
    const bit = (i % width) * bits;
    strip[Math.floor(i / width) * stride + (bit >> 3)] |= (last - Math.round((sample * last) / 255)) << (8 - bits - (bit & 7));
  });
  const palette = Array.from({ length: 3 * (last + 1) }, (_, i) => Math.round((65535 * (last - (i % (last + 1)))) / last));
  const fields = [[256, width], [257, height], [258, bits], [259, 1], [262, 3], [273, 8], [278, height], [279, strip.length]];
  const map = 8 + strip.length + (strip.length & 1);
  const directory = map + 2 * palette.length;
  const file = Buffer.alloc(directory + 2 + 12 * (fields.length + 1) + 4);
  file.write('II*\0', 'latin1');
  file.writeUInt32LE(directory, 4);
  file.set(strip, 8);
  palette.forEach((colour, i) => file.writeUInt16LE(colour, map + 2 * i));
  // Tag, kind, count and value; a palette is of shorts that stand elsewhere.
  const entries = [...fields.map(([tag, value]) => [tag, 4, 1, value]), [320, 3, palette.length, map]];
  file.writeUInt16LE(entries.length, directory);
  entries.forEach(([tag, kind, count, value], i) => {
    const at = directory + 2 + 12 * i;
    file.writeUInt16LE(tag, at);
    file.writeUInt16LE(kind, at + 2);
    file.writeUInt32LE(count, at + 4);
    file.writeUInt32LE(value, at + 8);
  });
  return file;
}
