// IndexedDB: the same journal, a frame a record with the key [project, generation, number]. A card has its project's text for a key; the
// list ['writer', project] is the key of who writes it, ['damaged', project, time] that of a journal that was put aside.
import { fault, journalOf } from './common.js';
import { itemsOf, unframed } from './frames.js';
import { lives } from './life.js';

/** A worker that has just been ended is gone after at most so many milliseconds. */
const ENDING_MS = 500;

/** `life` is the name that this worker holds as long as it lives. */
export async function database(life) {
  if (!self.indexedDB) throw fault('NotSupportedError', 'no IndexedDB');
  const settled = (request) =>
    new Promise((done, failed) => {
      request.onsuccess = () => done(request.result);
      request.onerror = () => failed(request.error);
    });
  let fresh = false;
  const opening = indexedDB.open('sightline', 1);
  opening.onupgradeneeded = () => {
    fresh = true;
    for (const name of ['frames', 'cards', 'photos', 'small']) opening.result.createObjectStore(name);
  };
  const base = await settled(opening);
  // Another visit's version of it must not wait for this one.
  base.onversionchange = () => base.close();
  /** A connection is closed under its worker where the browser cleared the storage: there is one version only, and nobody else deletes it. */
  const begun = (stores) => {
    try {
      return base.transaction(stores, 'readwrite', { durability: 'strict' });
    } catch (error) {
      throw error.name === 'InvalidStateError' ? fault('GoneError', 'cleared') : error;
    }
  };
  const run = (stores, work) =>
    new Promise((done, failed) => {
      const transaction = begun(stores);
      let result;
      transaction.oncomplete = () => done(result);
      // Not `onerror`: what was wrong is known when the transaction is aborted.
      transaction.onabort = () => failed(transaction.error ?? fault('AbortError', 'aborted'));
      Promise.resolve(work(...[stores].flat().map((name) => transaction.objectStore(name)))).then((value) => (result = value), failed);
    });
  const range = (id, generation) => (generation === undefined ? IDBKeyRange.bound([id], [id, []]) : IDBKeyRange.bound([id, generation], [id, generation, []]));
  /** In the transaction that writes: a worker that is not the project's writer any more writes nothing. */
  const mine = async (id, frames, cards) => {
    if ((await settled(frames.getKey(range(id)))) === undefined) throw fault('NotFoundError', 'no journal');
    if ((await settled(cards.get(['writer', id])))?.life !== life) throw fault('TakenError', 'another window writes this project');
  };
  const joined = (parts) => new Blob(parts);
  return {
    kind: 'database',
    fresh,
    /** All that have a card or a frame. */
    projects: () =>
      run(['frames', 'cards'], async (frames, cards) => {
        const all = new Set((await settled(cards.getAllKeys())).filter((key) => typeof key === 'string'));
        // The first frame of each: from there to the next project.
        for (let key = await settled(frames.getKey(IDBKeyRange.lowerBound([]))); key; key = await settled(frames.getKey(IDBKeyRange.lowerBound([key[0], []], true)))) all.add(key[0]);
        return [...all];
      }),
    hasJournal: async (id) => (await run('frames', (frames) => settled(frames.getKey(range(id))))) !== undefined,
    size: (id) => run('frames', async (frames) => (await settled(frames.getAll(range(id)))).reduce((sum, frame) => sum + frame.length, 0)),
    /**
     * Makes this worker the one that writes a project; false if another does that lives. By force where a lock is held, or the person
     * wants it: the other finds that out in the transaction of what it would write next.
     */
    async claim(id, force) {
      const key = ['writer', id];
      for (;;) {
        const before = await run('cards', async (cards) => {
          const writer = await settled(cards.get(key));
          if (!writer || writer.life === life || force) await settled(cards.put({ life }, key));
          return writer;
        });
        if (!before || before.life === life || force) return true;
        if (await lives(before.life, ENDING_MS)) return false;
        // Unless yet another was faster.
        await run('cards', async (cards) => (await settled(cards.get(key)))?.life === before.life && settled(cards.delete(key)));
      }
    },
    disclaim: (id) => run('cards', async (cards) => (await settled(cards.get(['writer', id])))?.life === life && settled(cards.delete(['writer', id]))),
    async journal(id) {
      const keys = await run('frames', (frames) => settled(frames.getAllKeys(range(id))));
      if (keys.length === 0) throw fault('NotFoundError', 'no journal');
      const generation = Math.max(...keys.map((key) => key[1]));
      const [records, numbers] = await run('frames', async (store) => [await settled(store.getAll(range(id, generation))), await settled(store.getAllKeys(range(id, generation)))]);
      const all = { frames: [], gap: null, tail: false, damaged: false, end: 0 };
      let next = 0;
      for (const [i, record] of records.entries()) {
        const { frames: [frame], damaged } = unframed(record);
        const missing = numbers[i][2] !== next;
        all.damaged ||= damaged || missing || !frame;
        // A damaged record is a gap where another follows.
        if ((missing || (all.tail && frame)) && all.gap === null) all.gap = all.frames.length;
        all.tail = !frame;
        if (frame) all.frames.push(frame);
        if (all.gap === null && frame) all.end += record.length;
        next = numbers[i][2] + 1;
      }
      if (all.frames.length === 0) throw fault('DamagedError', 'no frame is whole');
      return journalOf(generation, generation, all, next);
    },
    async since(id, generation, end) {
      const later = IDBKeyRange.bound([id, generation, end], [id, generation, []]);
      return (await run('frames', (frames) => settled(frames.getAll(later)))).flatMap((record) => itemsOf(unframed(record).frames));
    },
    has: async (id, generation) => (await run('frames', (frames) => settled(frames.getKey([id, generation, 0])))) !== undefined,
    async writer(id, generation, end, size) {
      return {
        async append(frame) {
          await run(['frames', 'cards'], async (frames, cards) => {
            await mine(id, frames, cards);
            // Never in the place of another: that would mix two windows' frames.
            await settled(frames.add(frame, [id, generation, end]));
          }).catch((error) => {
            throw error.name === 'ConstraintError' ? fault('TakenError', 'another window wrote this frame') : error;
          });
          end++;
          size += frame.length;
          return async () => {
            await run(['frames', 'cards'], async (frames, cards) => {
              await mine(id, frames, cards);
              await settled(frames.delete([id, generation, end - 1]));
            });
            end--;
            size -= frame.length;
          };
        },
        close() {},
        size: () => size,
      };
    },
    begin: (id, generation, frame) =>
      run(['frames', 'cards'], async (frames, cards) => {
        if ((await settled(cards.get(['writer', id])))?.life !== life) throw fault('TakenError', 'another window writes this project');
        await settled(frames.delete(range(id)));
        await settled(frames.add(frame, [id, generation, 0]));
        return 1;
      }),
    putAside: (id, generation) =>
      run(['frames', 'cards'], async (frames, cards) => {
        const journal = joined(await settled(frames.getAll(range(id, generation))));
        const put = await settled(cards.getAll(IDBKeyRange.bound(['damaged', id], ['damaged', id, []])));
        if (!put.some(({ size }) => size === journal.size)) await settled(cards.put(journal, ['damaged', id, Date.now()]));
      }),
    asides: async (id) => (await run('cards', (cards) => settled(cards.getAllKeys(IDBKeyRange.bound(['damaged', id], ['damaged', id, []]))))).length,
    async aside(id) {
      const put = await run('cards', (cards) => settled(cards.getAll(IDBKeyRange.bound(['damaged', id], ['damaged', id, []]))));
      const records = await run('frames', (frames) => settled(frames.getAll(range(id))));
      const unread = records.length > 0 && records.every((record) => unframed(record).frames.length === 0);
      return unread && put.length === 0 ? [joined(records)] : put;
    },
    card: (id) => run('cards', (cards) => settled(cards.get(id))),
    /** Of a project that is there and that this worker holds: a card makes none. */
    setCard: (id, card) =>
      run(['frames', 'cards'], async (frames, cards) => {
        await mine(id, frames, cards);
        await settled(cards.put(card, id));
      }),
    remove: (id) =>
      run(['frames', 'cards'], async (frames, cards) => {
        await settled(frames.delete(range(id)));
        await settled(cards.delete(id));
        await settled(cards.delete(['writer', id]));
        await settled(cards.delete(IDBKeyRange.bound(['damaged', id], ['damaged', id, []])));
      }),
    photo: async (key) => (await run('photos', (photos) => settled(photos.get(key)))) ?? null,
    small: async (key) => (await run('small', (small) => settled(small.get(key)))) ?? null,
    putPhoto: async (key, blob) => {
      // Read first: a transaction does not wait for a file, and a blob that names one would not outlive it.
      const content = new Blob([await blob.arrayBuffer()], { type: blob.type });
      await run('photos', (photos) => settled(photos.put(content, key)));
    },
    putSmall: (key, blob) => run('small', (small) => settled(small.put(blob, key))),
    /** As that of the files, in one transaction with the reading of the cards. */
    collect: (keys) =>
      run(['frames', 'cards', 'photos', 'small'], async (frames, cards, photos, small) => {
        const names = await settled(cards.getAllKeys());
        const all = await settled(cards.getAll());
        const known = new Set(names);
        // A project without a card might need any photo.
        if ((await settled(frames.getAllKeys())).some(([id]) => !known.has(id))) return;
        const used = new Set();
        for (const [i, name] of names.entries()) {
          if (typeof name !== 'string') continue;
          if (!all[i]?.keys) return;
          all[i].keys.forEach((key) => used.add(key));
        }
        for (const key of keys) {
          if (used.has(key)) continue;
          await settled(photos.delete(key));
          await settled(small.delete(key));
        }
      }),
    equipment: () => run('cards', (cards) => settled(cards.get(['equipment']))),
    setEquipment: (words) => run('cards', (cards) => settled(cards.put({ words }, ['equipment']))),
    wipe: () =>
      run(['frames', 'cards', 'photos', 'small'], async (...stores) => {
        for (const store of stores) await settled(store.clear());
      }),
  };
}
