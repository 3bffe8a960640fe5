// A worker of the page: it runs the engine, whose compiled module the page posts to it.
const crashed = (reason) => postMessage({ crashed: String(reason) });
addEventListener("unhandledrejection", (event) => crashed(event.reason));
const start = async ({ data }) => (await import("./sightline-worker.js")).default({ module_or_path: data.module });
addEventListener("message", (event) => start(event).catch(crashed), { once: true });
