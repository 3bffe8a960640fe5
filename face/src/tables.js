// The long tables of a project and of an adjustment, between rows of plain objects and columns of numbers.
//
// A call across the border costs more than the row it fetches: here a table crosses in three typed arrays, on the way out as
// views of the engine's memory, which only live during the call. Identifiers are numbered by their first appearance; a number
// that is null is NaN in its column, and NaN itself is refused on the way in. A row that is not what it should be comes back as
// { row, field, expected }.

class Names {
  list = [];
  #numbers = new Map();

  /** Number of an identifier: text, or a number as many point lists have it; -1 for anything else. */
  number(id) {
    const text = typeof id === 'number' && Number.isFinite(id) ? String(id) : id;
    if (typeof text !== 'string') return -1;
    let number = this.#numbers.get(text);
    if (number === undefined) {
      number = this.list.length;
      this.list.push(text);
      this.#numbers.set(text, number);
    }
    return number;
  }
}

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
const isTarget = (value) => Number.isInteger(value) && value > 0 && value < 2 ** 32;
const isRow = (row) => typeof row === 'object' && row !== null && !Array.isArray(row);

/** Maximum number of rows of a table: their columns are made before the rows are examined. */
const ROWS = 2e7;

const named = (id) => (typeof id === 'string' ? id : typeof id === 'number' ? String(id) : undefined);

/** Reads rows that may be anything: what throws, and what is too long, is said of its row, with the names that the row has. */
function guarded(rows, read) {
  const at = { row: 0 };
  let found;
  try {
    if (rows === undefined || rows === null) return read([], at);
    if (!Array.isArray(rows)) return { row: 0, whole: true, field: '', expected: 'objects' };
    found = rows.length > ROWS ? { row: 0, whole: true, field: '', expected: 'smaller' } : read(rows, at);
    if (found.row === undefined) return found;
    const { photo, point, id } = rows[found.row] ?? {};
    return { ...found, photo: named(photo), point: named(point ?? id) };
  } catch (error) {
    if (found?.row !== undefined) return found;
    let message = 'it cannot be read';
    try {
      message = String(error?.message ?? error);
    } catch {
      // What was thrown throws itself.
    }
    return { row: at.row, field: '', expected: 'readable', message };
  }
}

/** Three numbers, each perhaps null, into a column; whether they are that. */
function three(value, column, at, nullable) {
  if (!Array.isArray(value) && !ArrayBuffer.isView(value)) return false;
  if (value.length !== 3) return false;
  for (let axis = 0; axis < 3; axis++) {
    if (isNumber(value[axis])) column[at + axis] = value[axis];
    else if (!nullable || (value[axis] !== null && value[axis] !== undefined)) return false;
  }
  return true;
}

/** Columns u, v, sigma_u, sigma_v; photo, point, flags (1: enabled, 2: two sigmas), number of the target or 0. */
export const readObservations = (rows) => guarded(rows, observationColumns);

function observationColumns(rows, at) {
  const names = new Names();
  const numbers = new Float64Array(4 * rows.length);
  const places = new Uint32Array(4 * rows.length);
  for (let row = 0; row < rows.length; row++) {
    at.row = row;
    const source = rows[row];
    if (!isRow(source)) return { row, field: '', expected: 'object' };
    const { u, v, sigma, enabled, target } = source;
    const photo = names.number(source.photo);
    if (photo < 0) return { row, field: 'photo', expected: 'photo_id' };
    const point = names.number(source.point);
    if (point < 0) return { row, field: 'point', expected: 'point_id' };
    if (!isNumber(u)) return { row, field: 'u', expected: 'finite_number' };
    if (!isNumber(v)) return { row, field: 'v', expected: 'finite_number' };
    let su = sigma;
    let sv = sigma;
    let flags = 0;
    if (typeof sigma !== 'number' && sigma?.length === 2) {
      [su, sv] = sigma;
      flags = 2;
    }
    if (!isNumber(su) || !isNumber(sv)) return { row, field: 'sigma', expected: 'one_or_two' };
    if (enabled === undefined || enabled === true) flags |= 1;
    else if (enabled !== false) return { row, field: 'enabled', expected: 'truth' };
    const none = target === undefined || target === null;
    if (!none && !isTarget(target)) return { row, field: 'target', expected: 'target_number' };
    numbers[4 * row] = u;
    numbers[4 * row + 1] = v;
    numbers[4 * row + 2] = su;
    numbers[4 * row + 3] = sv;
    places[4 * row] = photo;
    places[4 * row + 1] = point;
    places[4 * row + 2] = flags;
    places[4 * row + 3] = none ? 0 : target;
  }
  return { numbers, places, names: names.list };
}

const ROLES = ['tie', 'control', 'check'];

/** Columns x, y, z, sx, sy, sz, diameter, normal; id, flags (0, 1, 2: role, 4: coordinates, 8: sigmas, 16: normal). */
export const readPoints = (rows) => guarded(rows, pointColumns);

function pointColumns(rows, at) {
  const list = [];
  const numbers = new Float64Array(10 * rows.length).fill(NaN);
  const places = new Uint32Array(rows.length);
  for (let row = 0; row < rows.length; row++) {
    at.row = row;
    const source = rows[row];
    if (!isRow(source)) return { row, field: '', expected: 'object' };
    const { id, role, xyz, sigma, diameter, normal } = source;
    if (typeof id === 'string') list.push(id);
    else if (isNumber(id)) list.push(String(id));
    else return { row, field: 'id', expected: 'point_id' };
    let flags = role === undefined ? 0 : ROLES.indexOf(role);
    if (flags < 0) return { row, field: 'role', expected: 'role' };
    if (xyz !== null && xyz !== undefined) {
      if (!three(xyz, numbers, 10 * row, false)) return { row, field: 'xyz', expected: 'three_or_null' };
      flags |= 4;
    }
    if (sigma !== null && sigma !== undefined) {
      if (!three(sigma, numbers, 10 * row + 3, true)) return { row, field: 'sigma', expected: 'sigmas_or_null' };
      flags |= 8;
    }
    if (diameter !== null && diameter !== undefined) {
      if (!isNumber(diameter)) return { row, field: 'diameter', expected: 'number_or_null' };
      numbers[10 * row + 6] = diameter;
    }
    if (normal !== null && normal !== undefined) {
      if (!three(normal, numbers, 10 * row + 7, false)) return { row, field: 'normal', expected: 'three_or_null' };
      flags |= 16;
    }
    places[row] = flags;
  }
  return { numbers, places, names: list };
}

const orNull = (value) => (value === value ? value : null);

/** The reverse of readObservations. */
export function writeObservations(numbers, places, names) {
  const rows = new Array(places.length / 4);
  for (let row = 0; row < rows.length; row++) {
    const [n, p] = [4 * row, 4 * row];
    const flags = places[p + 2];
    rows[row] = {
      photo: names[places[p]],
      point: names[places[p + 1]],
      u: numbers[n],
      v: numbers[n + 1],
      sigma: flags & 2 ? [numbers[n + 2], numbers[n + 3]] : numbers[n + 2],
      enabled: (flags & 1) === 1,
    };
    if (places[p + 3] > 0) rows[row].target = places[p + 3];
  }
  return rows;
}

/** The reverse of readPoints. */
export function writePoints(numbers, places, names) {
  const rows = new Array(places.length);
  for (let row = 0; row < rows.length; row++) {
    const n = 10 * row;
    const flags = places[row];
    rows[row] = {
      id: names[row],
      role: ROLES[flags & 3],
      xyz: flags & 4 ? [numbers[n], numbers[n + 1], numbers[n + 2]] : null,
      sigma: flags & 8 ? [orNull(numbers[n + 3]), orNull(numbers[n + 4]), orNull(numbers[n + 5])] : null,
      diameter: orNull(numbers[n + 6]),
    };
    if (flags & 16) rows[row].normal = [numbers[n + 7], numbers[n + 8], numbers[n + 9]];
  }
  return rows;
}

/** Gives an object a field whose value is made when it is first read: a copy, JSON or a clone read it like any other. */
function addLater(object, field, make) {
  let made;
  const set = (value) => Object.defineProperty(object, field, { value, writable: true, enumerable: true, configurable: true });
  const get = () => {
    made ??= make();
    if (Object.getOwnPropertyDescriptor(object, field)?.configurable) set(made);
    return made;
  };
  Object.defineProperty(object, field, { get, set, enumerable: true, configurable: true });
}

/**
 * Columns vx, vy, rx, ry, wx, wy, mdb_x, mdb_y, effect_x, effect_y, weight; photo, point, enabled. A weight of 1 has no field.
 *
 * Every number of a row is an object of its own for V8: the rows take four times the room of their columns, and copying them is
 * most of what its garbage collection does. Who asks for points alone, or keeps many adjustments, goes without.
 */
export function addAdjustedObservations(adjustment, numbers, places, names) {
  const [ownNumbers, ownPlaces] = [numbers.slice(), places.slice()];
  addLater(adjustment, 'observations', () => adjustedObservations(ownNumbers, ownPlaces, names));
}

function adjustedObservations(numbers, places, names) {
  const rows = new Array(places.length / 3);
  for (let row = 0; row < rows.length; row++) {
    const [n, p] = [11 * row, 3 * row];
    const observation = {
      photo: names[places[p]],
      point: names[places[p + 1]],
      vx: orNull(numbers[n]),
      vy: orNull(numbers[n + 1]),
      rx: orNull(numbers[n + 2]),
      ry: orNull(numbers[n + 3]),
      wx: orNull(numbers[n + 4]),
      wy: orNull(numbers[n + 5]),
      mdb_x: orNull(numbers[n + 6]),
      mdb_y: orNull(numbers[n + 7]),
      effect_x: orNull(numbers[n + 8]),
      effect_y: orNull(numbers[n + 9]),
      enabled: places[p + 2] === 1,
    };
    const weight = numbers[n + 10];
    if (weight === weight) observation.weight = weight;
    rows[row] = observation;
  }
  return rows;
}

/** Columns x, y, z, three sigmas, six covariances; rays, flags (1: sigmas, 2: covariances); an absent one has no field. */
export function writeAdjustedPoints(numbers, places, names) {
  const rows = new Array(places.length / 2);
  for (let row = 0; row < rows.length; row++) {
    const n = 12 * row;
    const flags = places[2 * row + 1];
    const point = { id: names[row], xyz: [numbers[n], numbers[n + 1], numbers[n + 2]] };
    if (flags & 1) point.sigma = [numbers[n + 3], numbers[n + 4], numbers[n + 5]];
    if (flags & 2) {
      point.covariance = [numbers[n + 6], numbers[n + 7], numbers[n + 8], numbers[n + 9], numbers[n + 10], numbers[n + 11]];
    }
    point.rays = places[2 * row];
    rows[row] = point;
  }
  return rows;
}

/** Columns u, v, diameter; reason. */
export function addRejected(detection, numbers, reasons, names) {
  const [ownNumbers, ownReasons] = [numbers.slice(), reasons.slice()];
  addLater(detection, 'rejected_blobs', () => rejected(ownNumbers, ownReasons, names));
}

function rejected(numbers, reasons, names) {
  const rows = new Array(reasons.length);
  for (let row = 0; row < rows.length; row++) {
    const n = 3 * row;
    rows[row] = { u: numbers[n], v: numbers[n + 1], diameter: numbers[n + 2], reason: names[reasons[row]] };
  }
  return rows;
}
