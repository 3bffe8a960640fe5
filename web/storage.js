// Keeps projects in the browser's own storage, crash-safe: a worker of its own, so that no edit waits for a disk.
//
// A project is a journal of frames, each with its length and checksum, whose first frame is a whole snapshot; a kill at any moment leaves
// a prefix of whole frames, which is the state before or after an edit. What is in a frame: parts (texts by number, later ones as what
// changed of an earlier one) and a note, which only the page understands. A journal that has grown is condensed: the page says what is
// still needed, and a new journal with that takes the place of the old one. Photos are kept once, by what is in them.
//
// Where the origin has a private file system its files are used, else IndexedDB, else nothing, and the page is told.
//
// A browser that clears its storage under an open page leaves the files that are open then, and in Chromium whatever is stored meanwhile
// is taken away with them when the last of those is let go. Only the end of the worker lets go of them: the page ends it and starts a new
// one, which waits until those of all windows have gone.

/** A part is written whole again after so many that only say what changed, or when those outgrow it: reading it stays short. */
const CHAIN = 64;
/** Bytes read or written of a photo at a time. */
const PIECE = 1 << 20;
/** What must stay free when a photo is copied: room for the journal. */
const RESERVE = 32 << 20;
/** Versions of the journal that are read here. */
const VERSION = 1;
/** Held by every worker that has had a file open, as long as it lives. */
const OPEN_FILES = 'sightline files';
/** How long the workers of other windows are waited for after storage was cleared, in milliseconds. */
const PATIENCE = 5000;
/** Between a lock that is let go and the files that were beside it, in milliseconds. */
const SETTLING = 250;

const TABLE = Int32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});

function checksum(bytes) {
  let c = ~0;
  for (let i = 0; i < bytes.length; i++) c = TABLE[(c ^ bytes[i]) & 255] ^ (c >>> 8);
  return ~c >>> 0;
}

/** Items as a frame: length, checksum, JSON. */
function framed(items) {
  const body = new TextEncoder().encode(JSON.stringify(items));
  const bytes = new Uint8Array(8 + body.length);
  const head = new DataView(bytes.buffer);
  head.setUint32(0, body.length);
  head.setUint32(4, checksum(body));
  bytes.set(body, 8);
  return bytes;
}

/** The items of whole frames, and where they end: what follows was being written when everything stopped. */
function unframed(bytes) {
  const head = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const items = [];
  let at = 0;
  while (at + 8 <= bytes.length) {
    const end = at + 8 + head.getUint32(at);
    if (end > bytes.length) break;
    const body = bytes.subarray(at + 8, end);
    if (checksum(body) !== head.getUint32(at + 4)) break;
    for (const item of JSON.parse(new TextDecoder().decode(body))) items.push(item);
    at = end;
  }
  return { items, end: at };
}

const fault = (name, message) => Object.assign(new Error(message), { name });
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
const absent = (error) => error.name === 'NotFoundError';

/** Tries again while another holder of a file goes away: that of a killed page is there for a moment. */
async function patiently(work) {
  for (let attempt = 0; ; attempt++) {
    try {
      return await work();
    } catch (error) {
      if (error.name !== 'NoModificationAllowedError' || attempt === 60) throw error;
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

/** The origin's private file system: projects/ID/journal-N and card-0 or card-1, photos/KEY, small/KEY, equipment-0 or -1. */
async function fileSystem() {
  const top = await (await navigator.storage.getDirectory()).getDirectoryHandle('sightline', { create: true });
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
    const all = [];
    for await (const name of folder.keys()) all.push(name);
    return all;
  };
  const file = async (folder, name) => {
    try {
      return await (await folder.getFileHandle(name)).getFile();
    } catch (error) {
      if (absent(error)) return null;
      throw error;
    }
  };
  const bytes = async (folder, name) => {
    const found = await file(folder, name);
    return found ? new Uint8Array(await found.arrayBuffer()) : new Uint8Array();
  };
  const generations = async (folder) => (await names(folder)).filter((name) => name.startsWith('journal-')).map((name) => Number(name.slice(8))).sort((a, b) => b - a);
  const drop = (folder, name) => folder.removeEntry(name, { recursive: true }).catch(() => {});

  return {
    kind: 'files',
    projects: () => names(projects),
    async size(id) {
      const folder = await projects.getDirectoryHandle(id);
      const sizes = (await names(folder)).map(async (name) => (await file(folder, name))?.size ?? 0);
      return (await Promise.all(sizes)).reduce((sum, size) => sum + size, 0);
    },
    /** The newest journal whose snapshot is whole. */
    async journal(id) {
      const folder = await projects.getDirectoryHandle(id);
      for (const generation of await generations(folder)) {
        const content = await bytes(folder, `journal-${generation}`);
        const { items, end } = unframed(content);
        if (end > 0) return { generation, items, end, size: end };
      }
      throw fault('NotFoundError', 'no journal');
    },
    /** What was appended since a journal was read to its end. */
    async since(id, generation, end) {
      const found = await file(await projects.getDirectoryHandle(id), `journal-${generation}`);
      return unframed(new Uint8Array(await found.slice(end).arrayBuffer())).items;
    },
    /** Whether a journal is there still: a browser that makes room takes it away under a page that is open. */
    async has(id, generation) {
      return (await (await projects.getDirectoryHandle(id)).getFileHandle(`journal-${generation}`)) !== null;
    },
    async writer(id, generation, end) {
      const handle = await open(await projects.getDirectoryHandle(id), `journal-${generation}`);
      handle.truncate(end);
      return {
        append(frame) {
          try {
            whole(handle, frame, end);
            handle.flush();
            end += frame.length;
          } catch (error) {
            handle.truncate(end);
            throw error;
          }
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
    async card(id) {
      const folder = await projects.getDirectoryHandle(id);
      const both = await Promise.all(['card-0', 'card-1'].map((name) => bytes(folder, name)));
      const cards = both.flatMap((content) => unframed(content).items).sort((a, b) => b.turn - a.turn);
      return cards[0];
    },
    /** In turns: one of the two is always whole. */
    async setCard(id, card) {
      const folder = await projects.getDirectoryHandle(id, { create: true });
      const turn = ((await this.card(id))?.turn ?? 0) + 1;
      await write(folder, `card-${turn % 2}`, framed([{ ...card, turn }]));
    },
    remove: (id) => drop(projects, id),
    photo: (key) => file(photos, key),
    small: (key) => file(small, key),
    photos: () => names(photos),
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
    removePhoto: (key) => Promise.all([drop(photos, key), drop(small, key)]),
    async equipment() {
      const both = await Promise.all(['equipment-0', 'equipment-1'].map((name) => bytes(top, name)));
      return both.flatMap((content) => unframed(content).items).sort((a, b) => b.turn - a.turn)[0];
    },
    /** In turns, as cards. */
    async setEquipment(words) {
      const turn = ((await this.equipment())?.turn ?? 0) + 1;
      await write(top, `equipment-${turn % 2}`, framed([{ turn, words }]));
    },
  };
}

/** IndexedDB: the same journal, a frame a record. */
async function database() {
  if (!self.indexedDB) throw fault('NotSupportedError', 'no IndexedDB');
  const settled = (request) =>
    new Promise((done, failed) => {
      request.onsuccess = () => done(request.result);
      request.onerror = () => failed(request.error);
    });
  const opening = indexedDB.open('sightline', 1);
  opening.onupgradeneeded = () => {
    for (const name of ['frames', 'cards', 'photos', 'small']) opening.result.createObjectStore(name);
  };
  const base = await settled(opening);
  // Another visit's version of it must not wait for this one.
  base.onversionchange = () => base.close();
  const run = (stores, work) =>
    new Promise((done, failed) => {
      const transaction = base.transaction(stores, 'readwrite', { durability: 'strict' });
      let result;
      transaction.oncomplete = () => done(result);
      transaction.onabort = transaction.onerror = () => failed(transaction.error ?? fault('AbortError', 'aborted'));
      Promise.resolve(work(...[stores].flat().map((name) => transaction.objectStore(name)))).then((value) => (result = value), failed);
    });
  const range = (id, generation) => (generation === undefined ? IDBKeyRange.bound([id], [id, []]) : IDBKeyRange.bound([id, generation], [id, generation, []]));
  return {
    kind: 'database',
    // Projects have a text for a key; what is of all of them has a list.
    projects: async () => (await run('cards', (cards) => settled(cards.getAllKeys()))).filter((key) => typeof key === 'string'),
    size: (id) => run('frames', async (frames) => (await settled(frames.getAll(range(id)))).reduce((sum, frame) => sum + frame.length, 0)),
    async journal(id) {
      const keys = await run('frames', (frames) => settled(frames.getAllKeys(range(id))));
      if (keys.length === 0) throw fault('NotFoundError', 'no journal');
      const generation = Math.max(...keys.map((key) => key[1]));
      const frames = await run('frames', (store) => settled(store.getAll(range(id, generation))));
      const items = [];
      let whole = 0;
      let size = 0;
      for (const frame of frames) {
        const read = unframed(frame);
        if (read.end === 0) break;
        for (const item of read.items) items.push(item);
        size += frame.length;
        whole++;
      }
      return { generation, items, end: whole, size };
    },
    async since(id, generation, end) {
      const later = IDBKeyRange.bound([id, generation, end], [id, generation, []]);
      return (await run('frames', (frames) => settled(frames.getAll(later)))).flatMap((frame) => unframed(frame).items);
    },
    has: async (id, generation) => (await run('frames', (frames) => settled(frames.getKey([id, generation, 0])))) !== undefined,
    async writer(id, generation, end, size) {
      return {
        async append(frame) {
          await run('frames', (frames) => settled(frames.put(frame, [id, generation, end])));
          end++;
          size += frame.length;
        },
        close() {},
        size: () => size,
      };
    },
    begin: (id, generation, frame) =>
      run('frames', async (frames) => {
        await settled(frames.delete(range(id)));
        await settled(frames.put(frame, [id, generation, 0]));
        return 1;
      }),
    card: (id) => run('cards', (cards) => settled(cards.get(id))),
    setCard: (id, card) => run('cards', (cards) => settled(cards.put(card, id))),
    remove: (id) =>
      run(['frames', 'cards'], async (frames, cards) => {
        await settled(frames.delete(range(id)));
        await settled(cards.delete(id));
      }),
    photo: async (key) => (await run('photos', (photos) => settled(photos.get(key)))) ?? null,
    small: async (key) => (await run('small', (small) => settled(small.get(key)))) ?? null,
    photos: () => run('photos', (photos) => settled(photos.getAllKeys())),
    putPhoto: async (key, blob) => {
      // Read first: a transaction does not wait for a file, and a blob that names one would not outlive it.
      const content = new Blob([await blob.arrayBuffer()], { type: blob.type });
      await run('photos', (photos) => settled(photos.put(content, key)));
    },
    putSmall: (key, blob) => run('small', (small) => settled(small.put(blob, key))),
    removePhoto: (key) =>
      run(['photos', 'small'], async (photos, small) => {
        await settled(photos.delete(key));
        await settled(small.delete(key));
      }),
    equipment: () => run('cards', (cards) => settled(cards.get(['equipment']))),
    setEquipment: (words) => run('cards', (cards) => settled(cards.put({ words }, ['equipment']))),
  };
}

let backend;
/** Whether the page began anew here after its storage was cleared. */
let anew = false;
/** Settled when this worker may have files open. */
let entered = null;
/** The project that is open: its parts as they were read, the last part of each kind, its writer unless another window has it. */
let project = null;
/** Sends the page what it did not ask for. */
let tell = () => {};
const windows = self.BroadcastChannel ? new BroadcastChannel('sightline') : null;

async function reach() {
  for (const candidate of [fileSystem, database]) {
    try {
      backend = await candidate();
      break;
    } catch {
      // The next one, or none.
    }
  }
}

/** Before the first file is opened for writing: whoever waits for all files to be closed goes first. */
function enter() {
  if (!navigator.locks) return null;
  entered ??= new Promise((done) => navigator.locks.request(OPEN_FILES, { mode: 'shared' }, () => (done(), new Promise(() => {}))));
  return entered;
}

/** Waits until no window has a file of the storage that was cleared. */
async function othersGone() {
  windows?.postMessage({ word: 'cleared' });
  if (!navigator.locks) return pause(4 * SETTLING);
  try {
    await navigator.locks.request(OPEN_FILES, { signal: AbortSignal.timeout(PATIENCE) }, () => pause(SETTLING));
  } catch (error) {
    throw ['AbortError', 'TimeoutError'].includes(error.name) ? fault('HeldError', 'another window has files of the cleared storage') : error;
  }
}

/** `after`: where storage was cleared under the page, whether this window "noticed" or was "told" by the one that waits for all others. */
async function start({ after }) {
  if (after === 'noticed') await othersGone();
  if (after === 'told') await enter();
  anew = Boolean(after);
  await reach();
  if (after === 'noticed') windows?.postMessage({ word: 'anew' });
  if (!backend) return { kind: 'none' };
  // Deleted in an earlier visit, when it could still be undone.
  for (const id of await backend.projects()) if ((await cardOf(id))?.deleted) await purge({ id });
  return { kind: backend.kind };
}

const cardOf = (id) => backend.card(id).catch(() => undefined);

/** Holds a project for this window, or finds that another has it. */
async function hold(id, steal) {
  if (backend.kind === 'files') await enter();
  if (!navigator.locks) return Promise.resolve(() => {});
  return new Promise((done, failed) => {
    const held = (lock) => {
      if (!lock) return done(null);
      return new Promise((release) => done(release));
    };
    navigator.locks.request(`sightline ${id}`, steal ? { steal } : { ifAvailable: true }, held).catch((error) => {
      // Another window took it over.
      if (project?.id === id && project.writer) yieldProject();
      failed(error);
    });
  });
}

/** Another window goes on with the project; this one reads along. */
function yieldProject() {
  project.writer.close();
  project.release?.();
  project.writer = project.release = null;
  tell('yielded');
}

windows?.addEventListener('message', ({ data }) => {
  if (data.word === 'equipment') return tell('equipment');
  // Without open files it is enough to look for the folders again, when the one who waits for the others has made them.
  if (data.word === 'cleared' && entered) return tell('cleared');
  if (data.word === 'anew') return (queue = queue.then(reach));
  if (!project || data.id !== project.id) return;
  if (data.word === 'changed' && !project.writer) tell('changed');
  if (data.word === 'yield' && project.writer) {
    queue = queue.then(() => {
      if (project?.id === data.id && project.writer) yieldProject();
      windows.postMessage({ id: data.id, word: 'yielded' });
    });
  }
});

async function close() {
  if (!project) return;
  project.writer?.close();
  project.release?.();
  project = null;
}

/** Parts and the last of each kind, out of a journal's items. */
function gathered(items) {
  const [{ version } = {}] = items;
  if (version !== VERSION) throw fault('VersionError', String(version));
  const parts = new Map();
  const last = new Map();
  const notes = [];
  for (const { part, note } of items) {
    if (part) {
      parts.set(part.id, part);
      last.set(part.kind, part);
    }
    if (note !== undefined) notes.push(note);
  }
  return { parts, last, notes };
}

/** A part's text, from the last whole one on. */
function text(parts, id) {
  const chain = [];
  let part = parts.get(id);
  while (part && part.base !== undefined) {
    chain.push(part);
    part = parts.get(part.base);
  }
  if (!part) throw fault('DataError', `part ${id} is missing`);
  return chain.reduceRight((words, { from, to, words: put }) => words.slice(0, from) + put + words.slice(to), part.words);
}

async function open({ id }, _, taken) {
  await close();
  const release = taken ?? (await hold(id).catch(() => null));
  let journal, contents, writer;
  try {
    journal = await backend.journal(id);
    contents = gathered(journal.items);
    writer = release ? await backend.writer(id, journal.generation, journal.end, journal.size) : null;
  } catch (error) {
    release?.();
    throw error;
  }
  const { parts, last, notes } = contents;
  project = { id, generation: journal.generation, parts, writer, release, last: new Map() };
  for (const [kind, part] of last) project.last.set(kind, { id: part.id, words: text(parts, part.id), chain: CHAIN });
  return { reply: { notes, following: !writer, nextPart: Math.max(0, ...parts.keys()) + 1 } };
}

/** Goes on with a project that another window has: that one is asked first, and not asked any more when it does not answer. */
async function take({ id }) {
  await new Promise((done) => {
    const answered = ({ data }) => data.id === id && data.word === 'yielded' && finish();
    const finish = () => {
      windows?.removeEventListener('message', answered);
      clearTimeout(waiting);
      done();
    };
    const waiting = setTimeout(finish, 2000);
    windows?.addEventListener('message', answered);
    windows?.postMessage({ id, word: 'yield' });
  });
  return open({ id }, [], (await hold(id)) ?? (await hold(id, true)));
}

/** A part's text, of pieces that are texts or bytes of one. */
const joined = (pieces) => pieces.map((piece) => (typeof piece === 'string' ? piece : new TextDecoder().decode(piece))).join('');

/** A part, as what changed since the last of its kind where that is shorter. */
function partOf(id, kind, words, last) {
  const before = last.get(kind);
  const remember = (chain, inserted) => last.set(kind, { id, words, chain, inserted });
  if (before && before.chain < CHAIN) {
    const most = Math.min(before.words.length, words.length);
    let from = 0;
    while (from < most && before.words.charCodeAt(from) === words.charCodeAt(from)) from++;
    let tail = 0;
    while (tail < most - from && before.words.charCodeAt(before.words.length - 1 - tail) === words.charCodeAt(words.length - 1 - tail)) tail++;
    const put = words.slice(from, words.length - tail);
    const inserted = (before.inserted ?? 0) + put.length;
    if (inserted < words.length) {
      remember(before.chain + 1, inserted);
      return { part: { id, kind, base: before.id, from, to: before.words.length - tail, words: put } };
    }
  }
  remember(0, 0);
  return { part: { id, kind, words } };
}

/** What changed, at once and whole. The card is of the list of projects; it may be ahead of the journal, never behind a photo. */
async function append({ id, note, parts, card, snapshot }, texts) {
  if (snapshot && project?.id !== id) {
    await close();
    // A worker that was ended lets go of its locks a moment later.
    let release = await hold(id, false);
    for (const until = Date.now() + PATIENCE; anew && !release && Date.now() < until; release = await hold(id, false)) await pause(50);
    if (!release) throw fault('InvalidStateError', 'held');
    project = { id, generation: 0, parts: new Map(), writer: null, release, last: new Map() };
  }
  if (project?.id !== id) throw fault('InvalidStateError', 'not open');
  if (!project.writer && !snapshot) throw fault('InvalidStateError', 'following');
  if (!snapshot && !(await backend.has(id, project.generation).catch(() => false))) {
    // What is written to a file that was taken away is nowhere: the page has everything, and begins anew with another worker. Closing
    // such a file would wait for ever in Chromium.
    throw fault('GoneError', 'cleared');
  }
  const before = new Map(project.last);
  try {
    const items = parts.map(([number, kind], i) => partOf(number, kind, joined(texts[i]), project.last));
    items.push({ note });
    await backend.setCard(id, { ...(await cardOf(id)), ...card });
    if (snapshot) {
      const frame = framed([{ version: VERSION }, ...items]);
      const end = await backend.begin(id, 1, frame);
      project.generation = 1;
      project.writer = await backend.writer(id, 1, end, frame.length);
      // Told as stored when it can be read again: another clearing may have come between.
      if (anew && (await backend.journal(id)).size !== frame.length) throw fault('GoneError', 'cleared');
    } else {
      await project.writer.append(framed(items));
    }
  } catch (error) {
    // What was not written is no base of what comes next; it is sent again.
    project.last = before;
    throw error;
  }
  windows?.postMessage({ id, word: 'changed' });
  return { size: project.writer.size() };
}

/** Whether what was stored is there still. */
async function check({ id }) {
  if (project?.id === id && project.writer && !(await backend.has(id, project.generation).catch(() => false))) throw fault('GoneError', 'cleared');
}

/** A journal as it was read to be condensed, until that is done. */
let surveyed = null;

/** What the journal of the open project has: its notes, and of each part its number, its kind and how many characters it takes. */
async function survey({ id }) {
  if (project?.id !== id || !project.writer) throw fault('InvalidStateError', 'not open');
  const { generation, items, end } = await backend.journal(id);
  const { parts, last, notes } = gathered(items);
  surveyed = { id, generation, end, parts, last };
  const sizes = [...parts.values()].map((part) => [part.id, part.kind, part.words.length]);
  return { reply: { notes, parts: sizes } };
}

const surveyedTexts = ({ ids }) => ({ reply: {}, extras: ids.map((id) => text(surveyed.parts, id)) });

const leave = () => {
  surveyed = null;
};

/**
 * Puts a journal with some of the parts and one note in the place of the one that was surveyed. What was appended meanwhile follows, in the
 * same frame: a kill leaves the one journal or the other. The last part of each kind stays, for what follows says what changed of it.
 */
async function condense({ id, note, ids }) {
  const { generation, end, parts, last } = surveyed;
  surveyed = null;
  const wanted = new Set(ids);
  for (const part of last.values()) wanted.add(part.id);
  const items = [{ version: VERSION }];
  const read = new Map();
  const written = new Map();
  for (const part of parts.values()) {
    // In their order, so that each is told from the one before without going back to the first.
    const before = read.get(part.kind);
    const words = part.base !== undefined && before?.id === part.base ? before.words.slice(0, part.from) + part.words + before.words.slice(part.to) : text(parts, part.id);
    read.set(part.kind, { id: part.id, words });
    if (wanted.has(part.id)) items.push(partOf(part.id, part.kind, words, written));
  }
  items.push({ note });
  const size = queue.then(async () => {
    if (project?.id !== id || project.generation !== generation || !project.writer) throw fault('InvalidStateError', 'not open');
    for (const item of await backend.since(id, generation, end)) items.push(item);
    const frame = framed(items);
    project.writer.close();
    project.writer = null;
    try {
      const whole = await backend.begin(id, generation + 1, frame);
      project.generation = generation + 1;
      project.writer = await backend.writer(id, generation + 1, whole, frame.length);
    } catch (error) {
      // The old one is whole still.
      const { end: whole, size: before } = await backend.journal(id);
      project.writer = await backend.writer(id, generation, whole, before);
      throw error;
    }
    windows?.postMessage({ id, word: 'changed' });
    return project.writer.size();
  });
  queue = size.catch(() => {});
  return { size: await size };
}

/** Texts of parts, of the project as it was opened. */
const parts = ({ ids }) => ({ reply: {}, extras: ids.map((id) => text(project.parts, id)) });

const sizeOfKey = (key) => Number(key.split('-')[1]);

/** Copies photos that are not kept yet; gives those that are. */
async function keep({ keys }, extras) {
  const missed = [];
  let failure = null;
  for (const [i, key] of keys.entries()) {
    const [blob, bitmap] = [extras[2 * i], extras[2 * i + 1]];
    try {
      if ((await backend.photo(key))?.size !== blob.size) {
        const { quota, usage } = (await navigator.storage?.estimate?.().catch(() => null)) ?? {};
        if (quota !== undefined && quota - usage < blob.size + RESERVE) throw fault('QuotaExceededError', 'no room');
        await backend.putPhoto(key, blob);
      }
    } catch (error) {
      missed.push(key);
      failure ??= { name: error.name, detail: error.message };
    }
    if (bitmap && !(await backend.small(key).catch(() => null))) await putSmall(key, bitmap).catch(() => {});
    bitmap?.close?.();
  }
  return { missed, failure };
}

async function putSmall(key, bitmap) {
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  canvas.getContext('2d').drawImage(bitmap, 0, 0);
  await backend.putSmall(key, await canvas.convertToBlob({ type: 'image/jpeg', quality: 0.85 }));
}

/** Photos and their small pictures; nothing for what is not here or not whole. */
async function photos({ keys }) {
  const extras = [];
  for (const key of keys) {
    const blob = await backend.photo(key);
    extras.push(blob?.size === sizeOfKey(key) ? blob : null, await backend.small(key));
  }
  return { reply: {}, extras };
}

async function list() {
  const all = [];
  const extras = [];
  for (const id of await backend.projects()) {
    const card = await cardOf(id);
    if (!card || card.deleted) continue;
    const own = await backend.size(id).catch(() => 0);
    const bytes = own + [...new Set(card.keys)].reduce((sum, key) => sum + sizeOfKey(key), 0);
    all.push({ id, bytes, card });
  }
  all.sort((a, b) => b.card.changed - a.card.changed);
  for (const { card } of all) extras.push(card.keys[0] ? await backend.small(card.keys[0]) : null);
  return { reply: all.map(({ id, bytes, card: { keys, ...card } }) => ({ id, bytes, ...card })), extras };
}

/** Gives a project that is not open another name. */
async function rename({ id, name }) {
  if (project?.id === id) throw fault('InvalidStateError', 'open');
  const release = await hold(id);
  if (!release) throw fault('InvalidStateError', 'held');
  try {
    const { generation, end, size } = await backend.journal(id);
    const writer = await backend.writer(id, generation, end, size);
    await writer.append(framed([{ note: JSON.stringify({ name }) }]));
    writer.close();
    await backend.setCard(id, { ...(await cardOf(id)), name });
  } finally {
    release();
  }
}

async function duplicate({ id, copy, name, changed }) {
  const { items } = await backend.journal(id);
  await backend.setCard(copy, { ...(await cardOf(id)), name, changed });
  await backend.begin(copy, 1, framed([...items, { note: JSON.stringify({ name }) }]));
}

/** Takes a project out of the list; it is gone when that cannot be undone any more. */
async function remove({ id, deleted }) {
  if (project?.id === id) await close();
  await backend.setCard(id, { ...(await cardOf(id)), deleted });
}

/** Lets a deleted project go, with the photos that no other has. */
async function purge({ id }) {
  const card = await cardOf(id);
  if (!card?.deleted) return;
  await backend.remove(id);
  const used = new Set();
  for (const other of await backend.projects()) {
    const { keys } = (await cardOf(other)) ?? {};
    // A card that cannot be read might name any photo.
    if (!keys) return;
    keys.forEach((key) => used.add(key));
  }
  for (const key of card.keys ?? []) if (!used.has(key)) await backend.removePhoto(key);
}

/** Cameras and scale bars, which are of no project: the text that the page wrote last, or none. */
const equipment = async () => ({ reply: (await backend.equipment())?.words ?? null });

async function setEquipment({ words }) {
  await backend.setEquipment(words);
  windows?.postMessage({ word: 'equipment' });
}

const CALLS = { equipment, setEquipment, start, open, take, append, survey, surveyed: surveyedTexts, leave, check, condense, parts, keep, photos, list, rename, duplicate, remove, purge, close };
/** Copying photos lasts, and so does condensing: edits do not wait for them. */
const ALONGSIDE = new Set(['keep', 'photos', 'list', 'survey', 'surveyed', 'leave', 'condense']);
let queue = Promise.resolve();

/** Answers calls of a page that sends and hears by way of a port. */
function serve(port) {
  tell = (word) => port.postMessage({ told: word });
  port.onmessage = ({ data: { call, name, text: words, extras } }) => {
    const work = async () => {
      try {
        const done = (await CALLS[name](JSON.parse(words), extras)) ?? {};
        const { reply, extras: more = [] } = 'reply' in done ? done : { reply: done };
        port.postMessage({ call, text: JSON.stringify(reply), extras: more });
      } catch (error) {
        port.postMessage({ call, fault: error.name, text: String(error.message ?? error), extras: [] });
      }
    };
    if (ALONGSIDE.has(name)) work();
    else queue = queue.then(work);
  };
}

serve(self);
