// Tells whether a worker lives. A worker holds a name as long as it lives, and whoever asks for that name gets it when the worker has
// ended, however that came: by closing, by a crash, by lack of memory, in the middle of a computation.
//
// The name is that of an IndexedDB database to which the worker has an open connection. To delete a database waits until every connection to it
// is closed, and the browser closes those of a worker that has ended. Web Locks, which do the same, are taken only where there is no IndexedDB:
// over plain HTTP there are none, and in Chromium a page whose storage was cleared and the workers that it starts then do not see each other's.

/** Names of lives begin with this: what dead workers left is recognised by it. */
export const LIFE = 'sightline life ';

/** A name that no other worker has. */
export const newLife = () => `${LIFE}${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`;

/** Holds a name as long as this worker lives; settled when it is held, with 'database' or 'lock', or nothing where this browser has neither. */
export const live = (name) =>
  new Promise((done) => {
    const lock = () => (navigator.locks ? navigator.locks.request(name, () => (done('lock'), new Promise(() => {}))).catch(() => done(null)) : done(null));
    try {
      const opening = indexedDB.open(name);
      // No listener for `versionchange`: the connection stays open when another connection waits for its end.
      opening.onsuccess = () => {
        self.sightlineLife = opening.result;
        done('database');
      };
      opening.onerror = lock;
    } catch {
      lock();
    }
  });

/**
 * Whether the worker that holds a name by a database lives. One that has just been ended is waited for so many milliseconds: its
 * connection is closed a moment later. A browser that does not answer in that time counts as a worker that lives.
 */
export const lives = (name, patience) =>
  new Promise((done) => {
    const waiting = setTimeout(() => done(true), patience);
    const gone = () => (clearTimeout(waiting), done(false));
    const deleting = indexedDB.deleteDatabase(name);
    deleting.onsuccess = gone;
    deleting.onerror = gone;
  });

/** Deletes what dead workers left of their names; those of workers that live go when these end. */
export async function buryTheDead() {
  if (!self.indexedDB?.databases) return;
  for (const { name } of await indexedDB.databases()) if (name.startsWith(LIFE)) indexedDB.deleteDatabase(name);
}
