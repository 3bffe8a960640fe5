// A worker runs the page's own compiled module with the page's own glue; main() sees that it is not on a page and waits.
const crashed = (reason) => postMessage({ crashed: String(reason) });
addEventListener("unhandledrejection", (event) => crashed(event.reason));
const start = async ({ data }) => (await import(data.glue)).default({ module_or_path: data.module });
addEventListener("message", (event) => start(event).catch(crashed), { once: true });
