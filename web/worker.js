// A worker of the page: it runs the engine, whose compiled module the page posts to it.
import { live } from "./storage/life.js";

const crashed = (reason) => postMessage({ crashed: String(reason) });
addEventListener("unhandledrejection", (event) => crashed(event.reason));

/** Holds a name as long as this worker lives: the page hears when it is gone, however that came. */
const hold = async (name) => {
  const by = await live(name);
  if (by) postMessage({ held: name, by });
};

/** The decoders of HEIC and RAW: fetched when the first such file comes. */
let codecs;
const load = async (address) => {
  const glue = await import("./sightline-codecs.js");
  await glue.default({ module_or_path: address });
  return glue;
};

const start = async ({ data }) => {
  self.sightlineCodecs = () =>
    (codecs ??= load(data.codecs).catch((error) => {
      codecs = undefined;
      throw error;
    }));
  await hold(data.life);
  await (await import("./sightline-worker.js")).default({ module_or_path: data.module });
};
addEventListener("message", (event) => start(event).catch(crashed), { once: true });
