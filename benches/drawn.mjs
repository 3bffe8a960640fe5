// Photos for benches that drive the page: dots in noise, drawn and compressed by the browser.

/** Semi-axes of the smallest dot in pixels; the others are up to 8 and 5 pixels larger. */
const SMALLEST = [14, 13];

/** Bytes of a JPEG with dots at { u, v } in noise; noise and sizes of the dots come from the seed. */
export async function drawn(page, { width, height, seed, dots }) {
  const text = await page.evaluate(
    async ([width, height, seed, dots, [a, b]]) => {
      let state = seed;
      const random = () => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
      const canvas = new OffscreenCanvas(width, height);
      const pen = canvas.getContext('2d');
      const tile = new ImageData(512, 512);
      for (let i = 0; i < tile.data.length; i += 4) {
        const grey = 60 + 24 * (random() + random() + random() - 1.5);
        tile.data.set([grey, grey, grey, 255], i);
      }
      for (let y = 0; y < height; y += 512) for (let x = 0; x < width; x += 512) pen.putImageData(tile, x, y);
      for (const { u, v } of dots) {
        pen.fillStyle = '#e8e8e8';
        pen.beginPath();
        pen.ellipse(u, v, a + 8 * random(), b + 5 * random(), random(), 0, 7);
        pen.fill();
      }
      const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg', quality: 0.95 })).arrayBuffer());
      let text = '';
      for (let at = 0; at < bytes.length; at += 32_768) text += String.fromCharCode(...bytes.subarray(at, at + 32_768));
      return btoa(text);
    },
    [width, height, seed, dots, SMALLEST],
  );
  return Buffer.from(text, 'base64');
}

/** The same photo with `name` as a JPEG comment, so that its bytes differ and the page takes it for a new photo. */
export function copied(photo, name) {
  const length = Buffer.alloc(2);
  length.writeUInt16BE(name.length + 2);
  const comment = Buffer.concat([Buffer.from('\xff\xfe', 'latin1'), length, Buffer.from(name, 'latin1')]);
  return Buffer.concat([photo.subarray(0, 2), comment, photo.subarray(2)]);
}
