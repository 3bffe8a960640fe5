// Arguments as JSON text and bytes. Every value is examined here, once, before anything is made of it, and nothing is thrown
// across the border: what cannot be taken comes back as { path, expected, message }.

/** Deepest nesting of objects and lists. */
const DEPTH = 32;
/** Maximum number of values of an argument. */
const VALUES = 5e7;
/** Maximum number of characters of all its texts. */
const CHARACTERS = 2 ** 28;
/** Maximum number of bytes of a file. */
const BYTES = 2 ** 31 - 1;
/** Maximum number of files. */
const FILES = 20_000;

class Fault {
  constructor(expected) {
    this.expected = expected;
  }
}

const pathOf = (name, steps) =>
  steps.reduce((path, step) => (typeof step === 'number' ? `${path}[${step}]` : path ? `${path}.${step}` : step), name);

/** Error in reading a caller's object: a getter or a proxy that throws, a detached array. */
function told(name, steps, error) {
  let path = name;
  let message = '';
  try {
    path = pathOf(name, steps);
    if (!(error instanceof Fault)) message = String(error?.message ?? error);
  } catch {
    message = 'it cannot be read';
  }
  return { path, expected: error instanceof Fault ? error.expected : 'readable', message };
}

/** Whether it is an object with fields: no list, no bytes. */
const hasFields = (value) =>
  typeof value === 'object' && value !== null && !Array.isArray(value) && !ArrayBuffer.isView(value) && !(value instanceof ArrayBuffer);

/** JSON of any value; fields of the outermost object that are named in `without` are left out, undefined ones too. */
export function readPlain(value, name, without) {
  const steps = [];
  const open = [];
  let json = '';
  let [values, characters] = [0, 0];

  function text(string) {
    characters += string.length;
    if (characters > CHARACTERS) throw new Fault('smaller');
    json += JSON.stringify(string);
  }

  function write(value) {
    if (++values > VALUES) throw new Fault('smaller');
    switch (typeof value) {
      case 'string':
        return text(value);
      case 'number':
        if (!Number.isFinite(value)) throw new Fault('finite_number');
        json += String(value);
        return;
      case 'boolean':
        json += value ? 'true' : 'false';
        return;
      case 'undefined':
        json += 'null';
        return;
      case 'object':
        break;
      default:
        throw new Fault('plain');
    }
    if (value === null) {
      json += 'null';
      return;
    }
    if (open.includes(value)) throw new Fault('tree');
    if (open.length >= DEPTH) throw new Fault('shallower');
    open.push(value);
    if (Array.isArray(value)) list(value);
    else if (hasFields(value)) fields(value);
    else throw new Fault('plain');
    open.pop();
  }

  function list(value) {
    const length = value.length;
    if (values + length > VALUES) throw new Fault('smaller');
    json += '[';
    for (let k = 0; k < length; k++) {
      if (k > 0) json += ',';
      steps.push(k);
      write(value[k]);
      steps.pop();
    }
    json += ']';
  }

  function fields(value) {
    const outermost = open.length === 1;
    json += '{';
    let first = true;
    for (const key of Object.keys(value)) {
      if (outermost && without.includes(key)) continue;
      steps.push(key);
      const field = value[key];
      if (field !== undefined) {
        if (!first) json += ',';
        first = false;
        text(key);
        json += ':';
        write(field);
      }
      steps.pop();
    }
    json += '}';
  }

  try {
    write(value);
    return { text: json };
  } catch (error) {
    return told(name, steps, error);
  }
}

/** A field of an object, however it is kept. */
export function readField(value, name) {
  try {
    return { value: hasFields(value) ? value[name] : undefined };
  } catch (error) {
    return told(name, [], error);
  }
}

/** Whether a buffer has been given away: nothing can be laid over it. */
function isDetached(buffer) {
  try {
    return new Uint8Array(buffer).buffer !== buffer;
  } catch {
    return true;
  }
}

function bytesOf(value) {
  if (value instanceof ArrayBuffer && isDetached(value)) throw new Fault('attached');
  const bytes = value instanceof ArrayBuffer ? new Uint8Array(value) : value;
  if (!(bytes instanceof Uint8Array)) throw new Fault('bytes');
  if (isDetached(bytes.buffer)) throw new Fault('attached');
  if (bytes.length > BYTES) throw new Fault('smaller');
  return bytes;
}

/** Bytes of a file. */
export function readBytes(value, name) {
  try {
    return { value: bytesOf(value) };
  } catch (error) {
    return told(name, [], error);
  }
}

/** Samples of a picture: bytes or words. */
export function readSamples(value, name) {
  try {
    const known = [Uint8Array, Uint8ClampedArray, Uint16Array].some((kind) => value instanceof kind);
    if (!known) throw new Fault('samples');
    if (isDetached(value.buffer)) throw new Fault('attached');
    if (value.byteLength > BYTES) throw new Fault('smaller');
    return { value };
  } catch (error) {
    return told(name, [], error);
  }
}

/** Files by name, bytes or text, as [names, bytes]. */
export function readFiles(value, name) {
  const steps = [];
  try {
    if (!hasFields(value)) throw new Fault('object');
    const [names, contents] = [Object.keys(value), []];
    if (names.length > FILES) throw new Fault('smaller');
    const encoder = new TextEncoder();
    let total = 0;
    for (const file of names) {
      steps.push(file);
      const content = value[file];
      if (typeof content === 'string' && content.length > CHARACTERS) throw new Fault('smaller');
      const bytes = typeof content === 'string' ? encoder.encode(content) : bytesOf(content);
      total += bytes.length;
      if (total > BYTES) throw new Fault('smaller');
      contents.push(bytes);
      steps.pop();
    }
    return { value: [names, contents] };
  } catch (error) {
    return told(name, steps, error);
  }
}
