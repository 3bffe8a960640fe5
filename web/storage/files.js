// The origin's private file system: projects/ID/journal-N, card-0 or card-1 and damaged-TIME, photos/KEY, small/KEY, equipment-0 or -1.
import { PIECE, absent, fault, journalOf, pause } from './common.js';
import { framed, itemsOf, unframed } from './frames.js';

/** Held together by those who write a card, and alone by who lets go of photos that no card names. */
const PHOTOS = 'sightline photos';

/** Tries again while another holder of a file goes away: that of a killed page is there for a moment. */
const patiently = (work) => again(work, 'NoModificationAllowedError');
/** Tries again while another window writes into the file that is read: what was examined before is refused then. */
const undisturbed = (work) => again(work, 'NotReadableError');

async function again(work, name) {
  for (let attempt = 0; ; attempt++) {
    try {
      return await work();
    } catch (error) {
      if (error.name !== name || attempt === 60) throw error;
      await pause(50);
    }
  }
}

/** A file's bytes in pieces, through one buffer where its stream allows that: others lie there until the collector comes. */
async function* pieces(blob) {
  let reader;
  try {
    reader = blob.stream().getReader({ mode: 'byob' });
  } catch {
    for (let at = 0; at < blob.size; at += PIECE) yield new Uint8Array(await blob.slice(at, at + PIECE).arrayBuffer());
    return;
  }
  for (let buffer = new Uint8Array(PIECE); ; ) {
    const { value, done } = await reader.read(buffer);
    if (done) return;
    yield value;
    buffer = new Uint8Array(value.buffer);
  }
}

export async function fileSystem() {
  // Where there are no locks two windows would write one journal: the database has means of its own against that.
  if (!navigator.locks) throw fault('NotSupportedError', 'no locks');
  const all = await navigator.storage.getDirectory();
  let fresh = false;
  await all.getDirectoryHandle('sightline').catch(() => (fresh = true));
  const top = await all.getDirectoryHandle('sightline', { create: true });
  const [projects, photos, small] = await Promise.all(['projects', 'photos', 'small'].map((name) => top.getDirectoryHandle(name, { create: true })));
  const open = async (folder, name) => patiently(async () => (await folder.getFileHandle(name, { create: true })).createSyncAccessHandle());
  // Files that can be read but not written at once are of no use: found out before anything depends on it.
  (await open(top, 'probe')).close();

  const whole = (handle, bytes, at = 0) => {
    while (bytes.length > 0) {
      const written = handle.write(bytes, { at });
      if (written === 0) throw fault('QuotaExceededError', 'no room');
      at += written;
      bytes = bytes.subarray(written);
    }
  };
  const write = async (folder, name, bytes) => {
    const handle = await open(folder, name);
    try {
      handle.truncate(0);
      whole(handle, bytes);
      handle.flush();
    } finally {
      handle.close();
    }
  };
  const names = async (folder) => {
    const found = [];
    for await (const name of folder.keys()) found.push(name);
    return found;
  };
  const file = async (folder, name) => {
    try {
      return await (await folder.getFileHandle(name)).getFile();
    } catch (error) {
      if (absent(error)) return null;
      throw error;
    }
  };
  const bytes = (folder, name) =>
    undisturbed(async () => {
      const found = await file(folder, name);
      return found ? new Uint8Array(await found.arrayBuffer()) : new Uint8Array();
    });
  const generations = async (folder) => (await names(folder)).filter((name) => name.startsWith('journal-')).map((name) => Number(name.slice(8))).sort((a, b) => b - a);
  const drop = (folder, name) => folder.removeEntry(name, { recursive: true }).catch(() => {});
  /** The newer of two files that are written in turns: one of them is always whole. */
  const newer = async (folder, name) => {
    const both = await Promise.all([0, 1].map((turn) => bytes(folder, `${name}-${turn}`)));
    return both.flatMap((content) => itemsOf(unframed(content).frames)).sort((a, b) => b.turn - a.turn)[0];
  };
  const inTurn = async (folder, name, content) => {
    const turn = ((await newer(folder, name))?.turn ?? 0) + 1;
    await write(folder, `${name}-${turn % 2}`, framed([{ ...content, turn }]));
  };

  return {
    kind: 'files',
    fresh,
    projects: () => names(projects),
    hasJournal: async (id) => (await generations(await projects.getDirectoryHandle(id))).length > 0,
    async size(id) {
      const folder = await projects.getDirectoryHandle(id);
      const sizes = (await names(folder)).map(async (name) => (await file(folder, name))?.size ?? 0);
      return (await Promise.all(sizes)).reduce((sum, size) => sum + size, 0);
    },
    /** The newest journal of which a frame is whole: a newer one without was being written. */
    async journal(id) {
      const folder = await projects.getDirectoryHandle(id);
      for (let [all, damaged] = [await generations(folder), false]; ; damaged = false) {
        for (const generation of all) {
          const read = unframed(await bytes(folder, `journal-${generation}`));
          if (read.frames.length > 0) return journalOf(generation, all[0], read, read.end);
          damaged ||= read.damaged;
        }
        // A new one that was being written when it was examined may be whole by now, and those before it gone.
        const now = await generations(folder);
        if (now.join() === all.join()) throw damaged ? fault('DamagedError', 'no frame is whole') : fault('NotFoundError', 'no journal');
        all = now;
      }
    },
    /** Entries appended to a journal since it was read. */
    async since(id, generation, end) {
      const folder = await projects.getDirectoryHandle(id);
      return undisturbed(async () => {
        const found = await file(folder, `journal-${generation}`);
        return itemsOf(unframed(new Uint8Array(await found.slice(end).arrayBuffer())).frames);
      });
    },
    /** Whether a journal is there still: a browser that makes room takes it away under a page that is open. */
    async has(id, generation) {
      return (await (await projects.getDirectoryHandle(id)).getFileHandle(`journal-${generation}`)) !== null;
    },
    async writer(id, generation, end) {
      const folder = await projects.getDirectoryHandle(id);
      const handle = await open(folder, `journal-${generation}`);
      handle.truncate(end);
      return {
        append: async (frame) => {
          // What is written to a file that was taken away is nowhere: the page has everything, and begins anew with another worker.
          // Closing such a file would wait for ever in Chromium.
          if (!(await this.has(id, generation).catch(() => false))) throw fault('GoneError', 'cleared');
          try {
            whole(handle, frame, end);
            handle.flush();
            end += frame.length;
          } catch (error) {
            handle.truncate(end);
            throw error;
          }
          // Another window that could not wait for this one has begun a new journal, and may have read this one before the frame was here.
          if ((await generations(folder))[0] > generation) throw fault('TakenError', 'another window writes this project');
          return async () => handle.truncate((end -= frame.length));
        },
        close: () => handle.close(),
        size: () => end,
      };
    },
    /** A new journal that begins with a snapshot, and where it ends; those before it go when it is whole. */
    async begin(id, generation, frame) {
      const folder = await projects.getDirectoryHandle(id, { create: true });
      await write(folder, `journal-${generation}`, frame);
      for (const old of await generations(folder)) if (old < generation) await drop(folder, `journal-${old}`);
      return frame.length;
    },
    /** A copy of a damaged journal, for the person to download; one of it, however often it is opened. */
    async putAside(id, generation) {
      const folder = await projects.getDirectoryHandle(id);
      const journal = await bytes(folder, `journal-${generation ?? (await generations(folder))[0]}`);
      for (const name of await names(folder)) if (name.startsWith('damaged-') && (await file(folder, name)).size === journal.length) return;
      await write(folder, `damaged-${Date.now()}`, journal);
    },
    asides: async (id) => (await names(await projects.getDirectoryHandle(id))).filter((name) => name.startsWith('damaged-')).length,
    /** Damaged journals: those that were put aside, and those of which nothing can be read. */
    async aside(id) {
      const folder = await projects.getDirectoryHandle(id);
      const all = (await names(folder)).filter((name) => name.startsWith('damaged-')).sort();
      for (const generation of all.length > 0 ? [] : await generations(folder)) {
        const content = await bytes(folder, `journal-${generation}`);
        if (content.length > 0 && unframed(content).frames.length === 0) all.push(`journal-${generation}`);
      }
      return Promise.all(all.map((name) => file(folder, name)));
    },
    card: async (id) => newer(await projects.getDirectoryHandle(id), 'card'),
    /** Of a project that is there: a card makes none. */
    setCard: (id, card) => navigator.locks.request(PHOTOS, { mode: 'shared' }, async () => inTurn(await projects.getDirectoryHandle(id), 'card', card)),
    remove: (id) => drop(projects, id),
    photo: (key) => file(photos, key),
    small: (key) => file(small, key),
    async putPhoto(key, blob) {
      const handle = await open(photos, key);
      try {
        handle.truncate(0);
        let at = 0;
        for await (const piece of pieces(blob)) {
          whole(handle, piece, at);
          at += piece.length;
        }
        handle.flush();
      } catch (error) {
        handle.truncate(0);
        throw error;
      } finally {
        handle.close();
      }
    },
    putSmall: async (key, blob) => write(small, key, new Uint8Array(await blob.arrayBuffer())),
    /** Lets go of those of some photos that no card names; of none where a card cannot be read. */
    collect: (keys) =>
      navigator.locks.request(PHOTOS, async () => {
        const used = new Set();
        for (const id of await names(projects)) {
          const card = await newer(await projects.getDirectoryHandle(id), 'card');
          if (!card?.keys) return;
          card.keys.forEach((key) => used.add(key));
        }
        for (const key of keys) if (!used.has(key)) await Promise.all([drop(photos, key), drop(small, key)]);
      }),
    equipment: () => newer(top, 'equipment'),
    setEquipment: (words) => inTurn(top, 'equipment', { words }),
    /** Everything goes. */
    async wipe() {
      for (const folder of [projects, photos, small]) for (const name of await names(folder)) await folder.removeEntry(name, { recursive: true });
      for (const turn of [0, 1]) await drop(top, `equipment-${turn}`);
    },
  };
}
