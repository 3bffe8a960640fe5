// What is drawn, made of the page's arrays: lines, grid, frusta with all photos on one sheet; and the colours of the theme.
import { BufferAttribute, BufferGeometry, CanvasTexture, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, SRGBColorSpace } from 'three';

/** Side of the sheet with all photos. */
const SHEET = 2048;

export const POINT_SHADER = {
  vertexShader: `
    attribute vec3 tint; attribute float size; varying vec3 vTint; uniform float ratio;
    void main() { vTint = tint; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_PointSize = size * ratio; }`,
  fragmentShader: `
    varying vec3 vTint;
    void main() { vec2 d = gl_PointCoord - 0.5; if (dot(d, d) > 0.25) discard; gl_FragColor = vec4(vTint, 1.0); }`,
};

/** A colour of the page's theme. */
export const token = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim() || '#888';
/** As the shader takes it: what it writes is shown as it is. */
export const parts = (colour) => {
  const { r, g, b } = new Color(colour).convertLinearToSRGB();
  return [r, g, b];
};

export const segments = (positions, material) => {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  return new LineSegments(geometry, material);
};

export const line = (colour, opacity = 1) => new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity });

/** A surface that what lies behind it is seen through, lighter where it faces whoever looks. */
export function surface(positions, opacity) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ side: DoubleSide, transparent: true, opacity, depthWrite: false }));
  mesh.frustumCulled = false;
  return mesh;
}

/** Numbers below n in an order whose every beginning is spread over them: bits turned around. */
export function spread(n) {
  const bits = Math.max(1, Math.ceil(Math.log2(Math.max(2, n))));
  const all = [];
  for (let k = 0; k < 2 ** bits; k++) {
    let turned = 0;
    for (let b = 0; b < bits; b++) turned |= ((k >> b) & 1) << (bits - 1 - b);
    if (turned < n) all.push(turned);
  }
  return Uint32Array.from(all);
}

/** Edges of all frusta. */
export function edges(scene) {
  const photos = scene.photos.length / 15;
  const all = new Float32Array(photos * 48);
  const corner = (k, c) => scene.photos.subarray(15 * k + 3 * c, 15 * k + 3 * c + 3);
  for (let k = 0; k < photos; k++) {
    for (let c = 0; c < 4; c++) {
      all.set(corner(k, 0), 48 * k + 12 * c);
      all.set(corner(k, 1 + c), 48 * k + 12 * c + 3);
      all.set(corner(k, 1 + c), 48 * k + 12 * c + 6);
      all.set(corner(k, 1 + ((c + 1) % 4)), 48 * k + 12 * c + 9);
    }
  }
  return all;
}

/** All photos on one texture: one draw for three hundred of them. */
export function sheet(scene) {
  const photos = scene.photos.length / 15;
  const columns = Math.ceil(Math.sqrt(photos));
  const cell = Math.floor(Math.min(SHEET / columns, 512));
  const page = document.createElement('canvas');
  page.width = page.height = cell * columns;
  const draw = page.getContext('2d');
  draw.fillStyle = token('--photo');
  draw.fillRect(0, 0, page.width, page.height);
  const positions = new Float32Array(photos * 12);
  const places = new Float32Array(photos * 8);
  const faces = new Uint32Array(photos * 6);
  const side = page.width;
  for (let k = 0; k < photos; k++) {
    const [x, y] = [(k % columns) * cell, Math.floor(k / columns) * cell];
    const picture = scene.pictures[k];
    if (picture) draw.drawImage(picture, x, y, cell, cell);
    positions.set(scene.photos.subarray(15 * k + 3, 15 * k + 15), 12 * k);
    const [left, right, top, bottom] = [(x + 0.5) / side, (x + cell - 0.5) / side, 1 - (y + 0.5) / side, 1 - (y + cell - 0.5) / side];
    places.set([left, top, right, top, right, bottom, left, bottom], 8 * k);
    faces.set([0, 1, 2, 0, 2, 3].map((c) => 4 * k + c), 6 * k);
  }
  const texture = new CanvasTexture(page);
  texture.colorSpace = SRGBColorSpace;
  texture.generateMipmaps = false;
  texture.minFilter = 1006; // linear
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('uv', new BufferAttribute(places, 2));
  geometry.setIndex(new BufferAttribute(faces, 1));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ map: texture, side: DoubleSide }));
  mesh.frustumCulled = false;
  return mesh;
}

/** A grid in the plane of the lowest points, its mesh 1, 2 or 5 times a power of ten. */
export function grid(scene) {
  const step = scene.grid;
  const lines = [];
  const [low, high] = [0, 1].map((k) => [0, 1].map((axis) => (k ? Math.ceil : Math.floor)(scene.box[3 * k + axis] / step + (k ? 1 : -1))));
  const z = scene.box[2];
  for (let i = low[0]; i <= high[0]; i++) lines.push(i * step, low[1] * step, z, i * step, high[1] * step, z);
  for (let j = low[1]; j <= high[1]; j++) lines.push(low[0] * step, j * step, z, high[0] * step, j * step, z);
  return segments(Float32Array.from(lines), line(token('--line')));
}
