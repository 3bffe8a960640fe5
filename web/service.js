// The service worker: makes the page available offline. It caches all files of one build, each verified by its digest, or none. The build
// writes before this: FILES, names with digests; LATER, the same for rarely needed files, which are cached on first use; DIGEST, of all.
const BUILD = `sightline ${DIGEST}`;
const scope = new URL('./', location.href);

const hex = (bytes) => Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, '0')).join('');
const digest = async (response) => hex(await crypto.subtle.digest('SHA-256', await response.arrayBuffer()));

const wanted = (name) => FILES[name] ?? LATER[name];

/** A file's name without the folder of its build. */
const last = (address) => String(address).split('/').pop();

/** Cached files of this name of earlier builds: [cache, request] pairs. */
async function kept(name) {
  const found = [];
  for (const key of (await caches.keys()).filter((key) => key.startsWith('sightline '))) {
    const cache = await caches.open(key);
    for (const request of await cache.keys()) if (last(request.url) === last(new URL(name, scope))) found.push([cache, request]);
  }
  return found;
}

/** Names of the rarely needed files that were used with an earlier build. */
async function asked() {
  const wants = await Promise.all(Object.keys(LATER).map(async (name) => ((await kept(name)).length > 0 ? [name] : [])));
  return wants.flat();
}

/** A file of this build: from the cache of an earlier build if it is identical, else from the host; an error ends the installation. */
async function fetched(name) {
  const address = new URL(name, scope);
  for (const [cache, request] of await kept(name)) {
    const same = await cache.match(request);
    if (same && (await digest(same.clone())) === wanted(name)) return same;
  }
  const response = await fetch(address, { cache: 'no-store' });
  if (!response.ok || (await digest(response.clone())) !== wanted(name)) throw new Error(`${name} is not of this build`);
  // A new response without the flag of a redirection, which a page does not accept.
  return new Response(await response.blob(), { headers: { 'Content-Type': response.headers.get('Content-Type') ?? '' } });
}

addEventListener('install', (event) => {
  const install = async () => {
    const all = await Promise.all([...Object.keys(FILES), ...(await asked())].map(async (name) => [name, await fetched(name)]));
    const cache = await caches.open(BUILD);
    await Promise.all(all.map(([name, response]) => cache.put(new URL(name, scope), response)));
  };
  event.waitUntil(install());
});

addEventListener('activate', (event) => {
  const others = async () => (await caches.keys()).filter((key) => key.startsWith('sightline ') && key !== BUILD);
  event.waitUntil(others().then((keys) => Promise.all(keys.map((key) => caches.delete(key)))));
});

// The user has accepted the new build: the page that asked reloads.
addEventListener('message', (event) => event.data === 'go on' && skipWaiting());

addEventListener('fetch', (event) => {
  const address = new URL(event.request.url);
  if (event.request.method !== 'GET' || !address.href.startsWith(scope.href)) return;
  const name = decodeURIComponent(address.pathname.slice(scope.pathname.length)) || 'index.html';
  if (!wanted(name)) return;
  const answer = async () => {
    const cache = await caches.open(BUILD);
    const own = await cache.match(new URL(name, scope));
    if (own || !(name in LATER)) return own ?? fetch(event.request);
    const response = await fetched(name);
    await cache.put(new URL(name, scope), response.clone());
    return response;
  };
  event.respondWith(answer());
});
