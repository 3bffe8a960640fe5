// The decoders of HEIC and RAW: a module of their own beside this one, loaded when the first such file comes.
import * as glue from '../../../codecs.js';

const address = () => new URL('../../../codecs_bg.wasm', import.meta.url);
let loaded = false;
// Only in Node: there a file is read at once.
const files = () => globalThis.process?.getBuiltinModule?.('node:fs');

/** Loads the decoders: from what is given, else from beside this module. */
export async function loadDecoders(source) {
  const fs = files();
  if (source === undefined && fs) glue.initSync({ module: fs.readFileSync(address()) });
  else await glue.default({ module_or_path: source ?? address() });
  loaded = true;
}

/** The same at once, from bytes or from a compiled module. */
export function loadDecodersSync(module) {
  glue.initSync({ module });
  loaded = true;
}

/** Loads them at once where that is possible: in Node and in workers. */
function load() {
  const fs = files();
  if (fs) return loadDecodersSync(fs.readFileSync(address()));
  if (typeof WorkerGlobalScope === 'undefined') throw new Error('await initCodecs() first');
  const request = new XMLHttpRequest();
  request.open('GET', address(), false);
  request.responseType = 'arraybuffer';
  request.send();
  if (request.status !== 200) throw new Error(`${address().pathname}: ${request.status}`);
  return loadDecodersSync(request.response);
}

/**
 * A file opened: [header, samples, small picture]; or what is wrong, as JSON of an error; or why the decoders are missing.
 * Nothing is thrown across the border.
 */
export function unpack(bytes, channel, samples, maxSide) {
  try {
    if (!loaded) load();
  } catch (error) {
    return { missing: String(error?.message ?? error) };
  }
  try {
    return { unpacked: glue.unpack(bytes, channel, samples, maxSide) };
  } catch (error) {
    return { fault: typeof error === 'string' ? error : glue.trapped(String(error?.message ?? error)) };
  }
}
