// A picture as a photo file.

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
