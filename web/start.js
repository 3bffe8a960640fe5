// Starts the page's module, and the service worker that has the page ready without a network.
import start from './desk.js';

/** Where the files of this build lie: those of another build lie elsewhere, so that none is ever taken for one of this. */
self.sightlineBase = new URL('./', import.meta.url).href;

/** Tells the page; what comes before it listens waits in `sightlineTold`. */
self.sightlineTold = [];
const tell = (word, detail) => {
  sightlineTold.push({ word, detail });
  dispatchEvent(new Event('sightline'));
};

// A project file or photos opened with the installed page.
self.launchQueue?.setConsumer(async ({ files }) => {
  if (files?.length) tell('files', await Promise.all(files.map((file) => file.getFile())));
});

/** Loads a part of the page that is a file of its own, when it is asked for. */
self.sightlineLoad = (name) => import(`./${name}`);

/** Lets go of the copies of the page, and of the service worker that has them. */
self.sightlineForget = async () => {
  const scope = new URL('./', location.href).href;
  for (const registration of (await navigator.serviceWorker?.getRegistrations()) ?? []) if (registration.scope === scope) await registration.unregister();
  if (self.caches) for (const key of await caches.keys()) if (key.startsWith('sightline ')) await caches.delete(key);
};

// The missing browser features have been reported (`check.js`).
if (!self.sightlineTrouble) {
  await start({ module_or_path: new URL('./desk_bg.wasm', import.meta.url) });
  self.sightlineStarted = true;
  document.getElementById('static')?.remove();
  serve();
}

/** Keeps the page for times without a network; where that cannot be, the page says that it works only with one. */
async function serve() {
  if (location.protocol === 'file:') return;
  if (!navigator.serviceWorker) return tell('network');
  // Without a worker in charge this is the first visit: then nothing is replaced.
  const replaced = Boolean(navigator.serviceWorker.controller);
  const waits = (worker) => {
    if (!worker || !replaced) return;
    tell('update');
    addEventListener('sightline-update', () => worker.postMessage('go on'), { once: true });
  };
  navigator.serviceWorker.addEventListener('controllerchange', () => replaced && location.reload());
  try {
    const registration = await navigator.serviceWorker.register('service.js');
    waits(registration.waiting);
    const watch = (coming) =>
      coming?.addEventListener('statechange', () => {
        if (coming.state === 'installed') waits(coming);
        // It could not be installed, and there is none from an earlier visit.
        if (coming.state === 'redundant' && !registration.active) tell('network');
      });
    watch(registration.installing);
    registration.addEventListener('updatefound', () => watch(registration.installing));
  } catch {
    tell('network');
  }
}
