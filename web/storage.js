// Keeps projects in the browser's own storage, crash-safe: a worker of its own, so that no edit waits for a disk.
//
// A project is a journal of frames (`storage/frames.js`), whose first frame is a whole snapshot; a kill at any moment leaves a prefix of
// whole frames, which is the state before or after an edit. What is in a frame: parts (texts by number, later ones as what changed of an
// earlier one) and a note, which only the page understands. A journal that has grown is condensed: the page says what is still needed, and a
// new journal with that takes the place of the old one. Photos are kept once, by what is in them.
//
// Where the origin has a private file system its files are used (`storage/files.js`), else IndexedDB (`storage/database.js`), else nothing,
// and the page is told. Over plain HTTP there is only IndexedDB.
//
// Invariants. Each function below keeps them, and every one is there because its absence lost a project.
//
// 1. A project is there if it has a journal. Its card (name, time, figures, the photos that it needs) is of the list alone: a project whose
//    card is missing or cannot be read is listed and opened all the same, and a card without a journal is no project. A card is written for
//    a journal that is there, and makes none.
// 2. A journal has one writer at a time: the worker that holds the project. What holds it is a Web Lock; where there are none (plain HTTP), a
//    record in the database that names the writer's life (`storage/life.js`), so that a writer that has died holds nothing. With IndexedDB
//    each frame is added, never put in the place of another, in a transaction that looks first whether the record still names this worker:
//    a writer that was frozen, or was thought dead, writes nothing any more. With files the open file itself excludes others.
// 3. Whoever opens a project that is held only reads along, is told so, and can take it over. Its writer is asked first and writes all that it
//    still has; one that does not answer is skipped, and what its page could not write becomes a project of its own. A writer of files looks
//    after each frame whether a newer journal has been begun, and whoever has begun one looks after that for frames in the old one.
// 4. Renaming, deleting and purging need the hold, too: what is open in another window is not deleted there. A deleted project stays as it is,
//    out of the list; an append takes the deletion back. It is purged by nobody but the worker that deleted it, or after a day.
// 5. A photo is let go when no card names it, all cards are read at the same time as it goes, and one that cannot be read keeps all photos.
// 6. A journal is cut at its end only where its last frame is not whole: that was being written. Damage before that is mended where it is one
//    bit. Else the page is told, takes the newest state that can be read, and begins a new journal; the damaged one is put aside as it was.
//
// A browser that clears its storage under an open page leaves the files that are open then, and in Chromium whatever is stored meanwhile
// is taken away with them when the last of those is let go. Only the end of the worker lets go of them: the page ends it and starts a new
// one, which waits until those of all windows have gone.
import { database } from './storage/database.js';
import { fileSystem } from './storage/files.js';
import { framed } from './storage/frames.js';
import { buryTheDead, live, newLife } from './storage/life.js';
import { fault, pause } from './storage/common.js';

/** A part is written whole again after so many that only say what changed, or when those outgrow it: reading it stays short. */
const CHAIN = 64;
/** Bytes that must remain free when a photo is copied, for the journal. */
const RESERVE = 32 << 20;
/** The version of the journal that is written here; all up to it are read. Since 2 the tables of a project are parts of their own. */
const VERSION = 2;
/** Held by every worker that has had a file open, as long as it lives. */
const OPEN_FILES = 'sightline files';
/** How long the workers of other windows are waited for after storage was cleared, in milliseconds. */
const PATIENCE = 5000;
/** How long the writer of a project is waited for when another window takes it over, in milliseconds: it may have much to write. */
const YIELDING = 4000;
/** Between a lock that is let go and the files that were beside it, in milliseconds. */
const SETTLING = 250;
/** After so long a deleted project is purged by whoever comes, in milliseconds. */
const DAY = 86_400_000;

/** Names this worker as a writer, and as the one that deleted a project. */
const life = newLife();

let backend;
/** Whether the page began anew here after its storage was cleared. */
let anew = false;
/** Settled when this worker may have files open. */
let entered = null;
/** The project that is open: its parts as they were read, the last part of each kind, its writer unless another window has it. */
let project = null;
/** Sends the page what it did not ask for. */
let tell = () => {};
/** Tells the page by what name it will find out that this worker has ended. */
let tellLife = () => {};
const windows = self.BroadcastChannel ? new BroadcastChannel('sightline') : null;

async function reach() {
  for (const candidate of [fileSystem, database]) {
    try {
      backend = await candidate(life);
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

/**
 * `after`: where storage was cleared under the page, whether this window "noticed" or was "told" by the one that waits for all others.
 * `fresh` is whether there was nothing of this page in the storage, not even what every visit leaves.
 */
async function start({ after }) {
  if (after === 'noticed') await othersGone();
  if (after === 'told') await enter();
  anew = Boolean(after);
  // Others wait for the end of this worker by its name, which must be held first.
  tellLife(life, await live(life));
  await reach();
  if (after === 'noticed') windows?.postMessage({ word: 'anew' });
  if (!backend) return { kind: 'none', fresh: false };
  buryTheDead().catch(() => {});
  for (const id of await backend.projects()) await purge({ id }).catch(() => {});
  return { kind: backend.kind, fresh: backend.fresh };
}

const cardOf = (id) => backend.card(id).catch(() => undefined);

/** Whether a project is there (invariant 1). One that was killed while its first snapshot was written is none, and has no card yet. */
async function isThere(id) {
  if (!(await backend.hasJournal(id))) return false;
  if (await cardOf(id)) return true;
  return backend.journal(id).then(() => true, (error) => error.name !== 'NotFoundError');
}

/** A Web Lock of a project; nothing where another window has it. */
function lock(id, steal) {
  if (!navigator.locks) return Promise.resolve(() => {});
  return new Promise((done, failed) => {
    const held = (granted) => {
      if (!granted) return done(null);
      return new Promise((release) => done(release));
    };
    navigator.locks.request(`sightline ${id}`, steal ? { steal } : { ifAvailable: true }, held).catch((error) => {
      // Another window took it over.
      if (project?.id === id && project.writer) yieldProject();
      failed(error);
    });
  });
}

/** Holds a project for this window (invariant 2); gives what lets go of it, or nothing where another window has it. */
async function hold(id, steal = false) {
  if (backend.kind === 'files') await enter();
  const unlock = await lock(id, steal);
  if (!unlock) return null;
  if (backend.claim && !(await backend.claim(id, steal || Boolean(navigator.locks)))) {
    unlock();
    return null;
  }
  return () => {
    backend.disclaim?.(id).catch(() => {});
    unlock();
  };
}

/** The same for a moment; fails where another window has the project. */
async function holding(id, work) {
  const release = await hold(id);
  if (!release) throw fault('OpenElsewhereError', 'another window has this project open');
  try {
    return await work();
  } finally {
    release();
  }
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
  // The page has the last word: it writes what it still has, and lets go.
  if (data.word === 'yield' && project.writer) tell('wanted');
});

/** Lets another window go on with the project that is open. */
async function letGo({ id }) {
  if (project?.id === id && project.writer) yieldProject();
  windows?.postMessage({ id, word: 'yielded' });
}

async function close() {
  if (!project) return;
  project.writer?.close();
  project.release?.();
  project = null;
}

/** Parts and the last of each kind, out of a journal's items. */
function gathered(items) {
  // The version of a journal whose beginning is damaged is unknown: entries that are not understood are not read.
  const version = items.find((item) => item.version !== undefined)?.version ?? VERSION;
  if (!(version >= 1 && version <= VERSION)) throw fault('VersionError', String(version));
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

/**
 * Opens a project; another window's is only read along. `damage` says what was wrong with its journal: whether all of it was `mended`, and
 * whether there is a `gap` that frames follow; then the page takes what it can read and begins a new journal.
 */
async function open({ id }, _, taken) {
  await close();
  const release = taken ?? (await hold(id).catch(() => null));
  let journal, contents;
  let writer = null;
  let damage = null;
  try {
    journal = await backend.journal(id);
    if (journal.damaged && release) await backend.putAside(id, journal.generation);
    if (journal.gap !== null) {
      damage = { mended: false, gap: true };
      journal.items = journal.frames.flatMap(({ items }) => items);
    } else if (journal.damaged) {
      damage = { mended: !journal.tail, gap: false };
      if (release) journal = await writtenAnew(id, journal);
    }
    if (release && journal.gap === null) {
      writer = await backend.writer(id, journal.generation, journal.end, journal.size).catch(async (error) => {
        if (!taken || error.name !== 'NoModificationAllowedError') throw error;
        journal = await passedOver(id, journal);
        return backend.writer(id, journal.generation, journal.end, journal.size);
      });
    }
    contents = gathered(journal.items);
  } catch (error) {
    if (error.name === 'DamagedError' && release) await backend.putAside(id).catch(() => {});
    release?.();
    throw error;
  }
  const { parts, last, notes } = contents;
  project = { id, generation: journal.generation, newest: journal.newest, parts, writer, release, last: new Map() };
  // Only what is whole is a base of what comes next.
  if (journal.gap === null) for (const [kind, part] of last) project.last.set(kind, { id: part.id, words: text(parts, part.id), chain: CHAIN });
  return { reply: { notes, following: !release, nextPart: Math.max(0, ...parts.keys()) + 1, damage } };
}

/**
 * A new journal in the place of one whose file another window does not let go of. What that window writes into the old one before the new one
 * is there is taken over; what it writes later it finds out to be written in vain.
 */
async function passedOver(id, { generation, newest, items, end, ...rest }) {
  for (let [later, next] = [[], newest + 1]; ; next++) {
    const all = [...items, ...later];
    const frame = framed(all);
    const whole = await backend.begin(id, next, frame);
    const now = await backend.since(id, generation, end).catch(() => later);
    if (now.length === later.length) return { ...rest, generation: next, newest: next, items: all, end: whole, size: frame.length };
    later = now;
  }
}

/** A journal that was mended in reading, written as it was; where there is no room for that it is mended again the next time. */
async function writtenAnew(id, journal) {
  const [generation, frame] = [journal.newest + 1, framed(journal.items)];
  try {
    const end = await backend.begin(id, generation, frame);
    return { ...journal, generation, newest: generation, end, size: frame.length };
  } catch {
    return journal;
  }
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
    const waiting = setTimeout(finish, YIELDING);
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

/** Writes all changes in one step. The card is written before the photos, so it is never older. A window that writes has not deleted the project (invariant 4). */
async function append({ id, note, parts, card, snapshot }, texts) {
  if (snapshot && project?.id !== id) {
    await close();
    // A worker that was ended lets go of its locks a moment later.
    let release = await hold(id);
    for (const until = Date.now() + PATIENCE; anew && !release && Date.now() < until; release = await hold(id)) await pause(50);
    if (!release) throw fault('OpenElsewhereError', 'held');
    project = { id, generation: 0, newest: 0, parts: new Map(), writer: null, release, last: new Map() };
  }
  if (project?.id !== id) throw fault('InvalidStateError', 'not open');
  if (snapshot ? !project.release : !project.writer) throw fault('TakenError', 'following');
  const before = new Map(project.last);
  const setCard = async () => backend.setCard(id, { ...(await cardOf(id)), ...card, deleted: undefined, by: undefined });
  try {
    if (snapshot) project.last.clear();
    const items = parts.map(([number, kind], i) => partOf(number, kind, joined(texts[i]), project.last));
    items.push({ note });
    if (snapshot) {
      const frame = framed([{ version: VERSION }, ...items]);
      const generation = project.newest + 1;
      project.writer?.close();
      project.writer = null;
      const end = await backend.begin(id, generation, frame);
      project.generation = project.newest = generation;
      project.writer = await backend.writer(id, generation, end, frame.length);
      await setCard();
      // Told as stored when it can be read again: another clearing may have come between.
      if (anew && (await backend.journal(id)).size !== frame.length) throw fault('GoneError', 'cleared');
    } else {
      const takeBack = await project.writer.append(framed(items));
      // After it: a writer that was skipped has thrown, and the card is the other window's. Without room for the card the frame goes
      // again: it is sent another time, and would fill what room there comes.
      await setCard().catch(async (error) => {
        await takeBack().catch(() => {});
        throw error;
      });
    }
  } catch (error) {
    // What was not written is no base of what comes next; it is sent again.
    project.last = before;
    if (error.name === 'NotFoundError') throw fault('GoneError', 'cleared');
    // It is another window's now.
    if (error.name === 'TakenError' && project.writer) yieldProject();
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

/** Contents of the journal of the open project: its notes, and number, kind and length of each part. */
async function survey({ id }) {
  if (project?.id !== id || !project.writer) throw fault('InvalidStateError', 'not open');
  const { generation, items, end, damaged } = await backend.journal(id);
  // Read whole when it is opened again, and told then.
  if (damaged) throw fault('DamagedError', 'the journal is damaged');
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
    // In their order, so that each is stored as a difference from the one before without going back to the first.
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
      project.generation = project.newest = generation + 1;
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

/** Every project that is there (invariant 1): its card as a text, or none; whether it is deleted; how many damaged journals were put aside. */
async function list() {
  const all = [];
  for (const id of await backend.projects()) {
    // One that goes at this moment is gone; one that cannot be read is there.
    if (!(await isThere(id).catch((error) => error.name !== 'NotFoundError'))) continue;
    const card = await cardOf(id);
    const own = await backend.size(id).catch(() => 0);
    const keys = Array.isArray(card?.keys) ? card.keys : [];
    const bytes = own + [...new Set(keys)].reduce((sum, key) => sum + sizeOfKey(key), 0);
    const aside = await backend.asides(id).catch(() => 0);
    all.push({ id, bytes, card: card ? JSON.stringify(card) : null, deleted: Boolean(card?.deleted), aside, cover: keys[0], changed: card?.changed ?? Number.MAX_VALUE });
  }
  all.sort((a, b) => b.changed - a.changed);
  const extras = [];
  for (const { cover } of all) extras.push(cover ? await backend.small(cover).catch(() => null) : null);
  return { reply: all.map(({ cover, changed, ...one }) => one), extras };
}

/** The last part of a kind that can be read, out of a project that is not opened for that, and the name that it was given since. */
async function peek({ id, kind }) {
  const { frames } = await backend.journal(id);
  const { parts, notes } = gathered(frames.flatMap(({ items }) => items));
  let name = null;
  for (const note of notes) {
    const { name: given, present } = JSON.parse(note);
    name = given ?? (present ? null : name);
  }
  for (const part of [...parts.values()].reverse()) {
    try {
      if (part.kind === kind) return { reply: { name }, extras: [text(parts, part.id)] };
    } catch {
      // The table that it is a difference from is lost: one before it may be whole.
    }
  }
  throw fault('DamagedError', `no ${kind} can be read`);
}

/** The notes of a project that is not opened for that, with the texts of the parts that are wanted. */
async function look({ id, wanted }) {
  const { frames } = await backend.journal(id);
  const { parts, notes } = gathered(frames.flatMap(({ items }) => items));
  return { reply: notes, extras: wanted.map((part) => text(parts, part)) };
}

/** The damaged journals of a project, as they were. */
const aside = async ({ id }) => ({ reply: {}, extras: await backend.aside(id) });

/** Gives a project that is not open another name. */
async function rename({ id, name }) {
  if (project?.id === id) throw fault('OpenElsewhereError', 'open');
  await holding(id, async () => {
    const { generation, end, size, damaged } = await backend.journal(id);
    // To append would cut off what follows the damage.
    if (damaged) throw fault('DamagedError', 'the journal is damaged');
    const writer = await backend.writer(id, generation, end, size);
    try {
      await writer.append(framed([{ note: JSON.stringify({ name }) }]));
    } finally {
      writer.close();
    }
    await backend.setCard(id, { ...(await cardOf(id)), name });
  });
}

async function duplicate({ id, copy, name, changed }) {
  const { items, gap } = await backend.journal(id);
  if (gap !== null) throw fault('DamagedError', 'the journal is damaged');
  await holding(copy, async () => {
    await backend.begin(copy, 1, framed([...items, { note: JSON.stringify({ name }) }]));
    await backend.setCard(copy, { ...(await cardOf(id)), name, changed, deleted: undefined, by: undefined });
  });
}

/** Takes a project out of the list, or puts it back where it is there still; what is open in another window stays. */
async function remove({ id, deleted }) {
  const set = async () => backend.setCard(id, { ...(await cardOf(id)), deleted: deleted ?? undefined, by: deleted ? life : undefined });
  if (!(await backend.hasJournal(id).catch(() => false))) throw fault('NotFoundError', 'no journal');
  if (project?.id === id && project.writer) {
    return set().catch((error) => {
      if (error.name !== 'TakenError') throw error;
      // Another window took it over, which is found out only now.
      if (project?.id === id && project.writer) yieldProject();
      throw fault('OpenElsewhereError', error.message);
    });
  }
  return holding(id, set);
}

/** Lets a deleted project go, with the photos that no other has (invariants 4 and 5); and a folder in which no project was begun. */
async function purge({ id }) {
  const due = (card) => card?.deleted && (card.by === life || Date.now() - card.deleted > DAY);
  const empty = async () => !(await isThere(id)) && (await backend.asides(id)) === 0;
  if (project?.id === id || !(due(await cardOf(id)) || (await empty()))) return;
  await holding(id, async () => {
    const card = await cardOf(id);
    if (!due(card) && !(await empty())) return;
    await backend.remove(id);
    await backend.collect(card?.keys ?? []);
  });
}

/** Everything that is kept goes: all projects, photos and the equipment. Not while another window has one of the projects. */
async function wipe() {
  const held = [];
  try {
    for (const id of await backend.projects()) {
      if (project?.id === id && project.writer) continue;
      const release = await hold(id);
      if (!release) throw fault('OpenElsewhereError', 'another window has a project open');
      held.push(release);
    }
    await close();
    await backend.wipe();
  } finally {
    for (const release of held) release();
  }
}

/** Cameras and scale bars, which are of no project: the text that the page wrote last, or none. */
const equipment = async () => ({ reply: (await backend.equipment())?.words ?? null });

async function setEquipment({ words }) {
  await backend.setEquipment(words);
  windows?.postMessage({ word: 'equipment' });
}

const CALLS = {
  equipment, setEquipment, start, open, take, yield: letGo, append, survey, surveyed: surveyedTexts, leave, check, condense, parts, keep, photos, list, peek, look, aside, rename,
  duplicate, remove, purge, close, wipe,
};
/** Copying photos lasts, and so does condensing: edits do not wait for them. */
const ALONGSIDE = new Set(['keep', 'photos', 'list', 'peek', 'look', 'aside', 'survey', 'surveyed', 'leave', 'condense']);
let queue = Promise.resolve();

/** Answers calls of a page that sends and hears by way of a port. */
function serve(port) {
  tell = (word) => port.postMessage({ told: word });
  tellLife = (held, by) => by && port.postMessage({ held, by });
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
