// What is written over the view: names, axes, a ruler.
import { token } from './things.js';

/** Names that are tried at a time. */
const MOST_NAMES = 500;
/** Points that names keep off: with more of them the object would be without any name. */
const MOST_FREE = 4000;

/**
 * Writes names so that none lies on another or on a point, axes and a ruler; gives what was written with its boxes. `order` is that in which names of
 * points are tried, `quick` leaves those and the photos' out, `screen` projects a place, `perPixel` is the length of a pixel at the target.
 */
export function words(draw, { scene, options, order, quick, screen, camera, perPixel, width, height, family }) {
  const shown = [];
  const [ink, quiet, paper, accent, warn] = ['--ink', '--ink-2', '--paper', '--accent', '--warn'].map(token);
  const taken = [];
  const cells = new Map();
  const free = (x, y, w, h) => {
    const key = (i, j) => i * 4096 + j;
    const range = [Math.floor(x / 64), Math.floor((x + w) / 64), Math.floor(y / 64), Math.floor((y + h) / 64)];
    for (let i = range[0]; i <= range[1]; i++) {
      for (let j = range[2]; j <= range[3]; j++) {
        for (const n of cells.get(key(i, j)) ?? []) {
          const [a, b, c, d] = taken[n];
          if (x < a + c && a < x + w && y < b + d && b < y + h) return false;
        }
      }
    }
    taken.push([x, y, w, h]);
    for (let i = range[0]; i <= range[1]; i++) for (let j = range[2]; j <= range[3]; j++) {
      const here = cells.get(key(i, j));
      if (here) here.push(taken.length - 1);
      else cells.set(key(i, j), [taken.length - 1]);
    }
    return true;
  };
  // Squares of two pixels in which a point is drawn.
  const columns = Math.ceil(width / 2) + 1;
  const points = new Uint8Array(columns * (Math.ceil(height / 2) + 1));
  const covers = (x, y, w, h) => {
    const [left, right] = [Math.max(0, x >> 1), Math.min(columns - 1, (x + w) >> 1)];
    for (let row = Math.max(0, y >> 1); row <= Math.min(height >> 1, (y + h) >> 1); row++) {
      for (let column = left; column <= right; column++) if (points[row * columns + column]) return true;
    }
    return false;
  };
  /** Below to the right of its place, else on another side; what must be said is said where it lies worst, too. */
  const beside = (text, [x, y], options) => {
    draw.font = `${options.bold ? 600 : 400} 11px ${family}`;
    const w = draw.measureText(text).width;
    const sides = [[x + 6, y + 14], [x + 6, y - 6], [x - 6 - w, y + 14], [x - 6 - w, y - 6]];
    if (!sides.some(([a, b]) => say(text, a, b, { ...options, must: false })) && options.must) say(text, ...sides[0], options);
  };
  const say = (text, x, y, { bold = false, colour = quiet, must = false } = {}) => {
    draw.font = `${bold ? 600 : 400} 11px ${family}`;
    const w = draw.measureText(text).width;
    if (x + w < 0 || x > width || y < 0 || y - 12 > height) return true;
    // Objects at the edge are not cut.
    x = Math.max(3, Math.min(x, width - w - 3));
    if (!must && (covers(x - 2, y - 11, w + 4, 14) || !free(x - 2, y - 11, w + 4, 14))) return false;
    draw.lineWidth = 3;
    draw.lineJoin = 'round';
    draw.strokeStyle = paper;
    draw.strokeText(text, x, y);
    draw.fillStyle = colour;
    draw.fillText(text, x, y);
    shown.push({ words: text, box: [x - 2, y - 11, w + 4, 14] });
    return true;
  };
  const at = (k) => screen(scene.points[3 * k], scene.points[3 * k + 1], scene.points[3 * k + 2]);
  const ring = (place, radius) => {
    draw.strokeStyle = accent;
    draw.lineWidth = 2;
    draw.beginPath();
    draw.arc(place[0], place[1], radius, 0, 2 * Math.PI);
    draw.stroke();
  };
  // Fixed objects get their place first, then the selection, forms, photos, and points.
  free(0, height - 96, 110, 96);
  free(width - 190, height - 40, 190, 40);
  if (!quick && scene.points.length / 3 <= MOST_FREE) {
    for (let k = 0; k < scene.points.length / 3; k++) {
      const place = at(k);
      const [column, row] = place ? [place[0] >> 1, place[1] >> 1] : [-1, -1];
      for (const [i, j] of [[0, 0], [-1, 0], [1, 0], [0, -1], [0, 1]]) {
        if (column + i >= 0 && column + i < columns && row + j >= 0 && row + j <= height >> 1) points[(row + j) * columns + column + i] = 1;
      }
    }
  }
  if (options.selected >= 0 && at(options.selected)) {
    const place = at(options.selected);
    ring(place, 9);
    beside(scene.names[options.selected], place, { bold: true, colour: accent, must: true });
  }
  for (const k of options.chosen) {
    const place = k !== options.selected && at(k);
    if (place) ring(place, 6);
  }
  for (const { words, place, chosen, warning } of scene.labels) {
    const where = (options.features || warning) && screen(...place);
    if (where) beside(words, where, { bold: true, colour: warning ? warn : chosen ? accent : ink, must: warning });
  }
  if (options.photos && !quick) {
    for (let k = 0; k < scene.photos.length / 15; k++) {
      const place = screen(scene.photos[15 * k], scene.photos[15 * k + 1], scene.photos[15 * k + 2]);
      if (place) beside(scene.photoNames[k], place, { bold: true, colour: k === options.photo ? accent : ink });
    }
  }
  if (options.names && !quick) {
    let tried = 0;
    for (const k of order ?? []) {
      if (tried > MOST_NAMES) break;
      if (k === options.selected) continue;
      const place = at(k);
      if (!place || place[0] < 0 || place[1] < 0 || place[0] > width || place[1] > height) continue;
      tried += 1;
      beside(scene.names[k], place, { colour: scene.roles[k] & 3 ? ink : quiet });
    }
  }
  axes(draw, camera, height, family, ink);
  ruler(draw, { scene, options, perPixel, width, height, family, ink });
  return shown;
}

/** The directions of the axes. */
function axes(draw, camera, height, family, ink) {
  const [x, y] = [48, height - 44];
  const turned = camera.matrixWorldInverse;
  draw.font = `600 11px ${family}`;
  draw.lineWidth = 1.25;
  for (const [axis, name] of ['X', 'Y', 'Z'].entries()) {
    const [dx, dy] = [turned.elements[4 * axis], -turned.elements[4 * axis + 1]];
    draw.strokeStyle = draw.fillStyle = ink;
    draw.beginPath();
    draw.moveTo(x, y);
    draw.lineTo(x + 26 * dx, y + 26 * dy);
    draw.stroke();
    if (Math.hypot(dx, dy) > 0.15) draw.fillText(name, x + 36 * dx - 4, y + 36 * dy + 4);
  }
}

/** A length at the target, and the mesh of the grid. */
function ruler(draw, { scene, options, perPixel, width, height, family, ink }) {
  const wanted = perPixel() * 90;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const digit = wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1;
  const length = (digit * power) / perPixel();
  const [right, y] = [width - 18, height - 16];
  draw.strokeStyle = draw.fillStyle = ink;
  draw.lineWidth = 1.25;
  draw.beginPath();
  draw.moveTo(right - length, y - 6);
  draw.lineTo(right - length, y);
  draw.lineTo(right, y);
  draw.lineTo(right, y - 6);
  draw.stroke();
  draw.font = `400 11px ${family}`;
  const words = `${Number((digit * power).toPrecision(1))} ${scene.unit}`;
  draw.fillText(words, right - length - draw.measureText(words).width - 8, y);
  const mesh = `${Number(scene.grid.toPrecision(1))} ${scene.unit}`;
  if (options.grid) draw.fillText(`□ ${mesh}`, right - draw.measureText(`□ ${mesh}`).width, y - 14);
}
