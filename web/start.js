// Starts the page's module, and the service worker that has the page ready without a network.
import start from './desk.js';

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

await start({ module_or_path: './desk_bg.wasm' });

if (navigator.serviceWorker && location.protocol !== 'file:') {
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
    registration.addEventListener('updatefound', () => {
      const coming = registration.installing;
      coming.addEventListener('statechange', () => coming.state === 'installed' && waits(coming));
    });
  } catch {
    // Where the browser or the host has no room for it the page works with the network only.
  }
}
