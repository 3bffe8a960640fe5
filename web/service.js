// Has the page ready without a network: all files of one build, each checked against its digest, or none. The build writes before this
// FILES, names with digests, LATER, those of files that few need and that are kept when they have been asked for, and DIGEST, that of all.
const BUILD = `sightline ${DIGEST}`;
const scope = new URL('./', location.href);

const hex = (bytes) => Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, '0')).join('');
const digest = async (response) => hex(await crypto.subtle.digest('SHA-256', await response.arrayBuffer()));

const wanted = (name) => FILES[name] ?? LATER[name];

/** Files that few need, of those who have needed them: an earlier build has them. */
async function asked() {
  const builds = (await caches.keys()).filter((key) => key.startsWith('sightline '));
  const kept = await Promise.all(builds.map(async (key) => (await (await caches.open(key)).keys()).map(({ url }) => url)));
  return Object.keys(LATER).filter((name) => kept.flat().includes(new URL(name, scope).href));
}

/** A file of this build: from an earlier one where it is the same, else from the host; anything else ends the installation. */
async function fetched(name) {
  const address = new URL(name, scope);
  for (const key of await caches.keys()) {
    const kept = key.startsWith('sightline ') && (await (await caches.open(key)).match(address));
    if (kept && (await digest(kept.clone())) === wanted(name)) return kept;
  }
  const response = await fetch(address, { cache: 'no-store' });
  if (!response.ok || (await digest(response.clone())) !== wanted(name)) throw new Error(`${name} is not of this build`);
  // Without the mark of a redirection, which a page does not accept.
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

// The person has agreed to the new build: the page that asked reloads.
addEventListener('message', (event) => event.data === 'go on' && skipWaiting());

addEventListener('fetch', (event) => {
  const address = new URL(event.request.url);
  if (event.request.method !== 'GET' || !address.href.startsWith(scope.href)) return;
  const name = decodeURIComponent(address.pathname.slice(scope.pathname.length)) || 'index.html';
  if (!wanted(name)) return;
  const answer = async () => {
    const cache = await caches.open(BUILD);
    const kept = await cache.match(new URL(name, scope));
    if (kept || !(name in LATER)) return kept ?? fetch(event.request);
    const response = await fetched(name);
    await cache.put(new URL(name, scope), response.clone());
    return response;
  };
  event.respondWith(answer());
});
