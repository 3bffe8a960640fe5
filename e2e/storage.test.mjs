// Storage as browsers have it: without a private file system, full, cleared under the page, in a private window; a long session.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { killRenderers, open, openPrivately, plainHttp } from './browser.mjs';
import { afresh, downloads, drop, go, idle, notice, sample, save, scratch, unzipped, verb, waitForList } from './desk.mjs';

const written = (page) => page.waitForFunction(() => /^saved \d/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 60_000 });
const figure = (page, step) => page.textContent(`[data-step=${step}] .figure`).then((text) => text.trim());
const named = (name) => JSON.stringify({ format: 'sightline', version: 1, name });
const storageLine = (page, words) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.querySelector('.foot .storage')?.textContent), words, { timeout: 60_000 });

async function goOn(page) {
  await page.click('[data-project] .do .button');
  await page.waitForSelector('.project-name');
}

async function rename(page, name) {
  await page.fill('.project-name', name);
  await page.press('.project-name', 'Enter');
}

/** The page with something put before the worker that keeps projects. */
async function openWith(prelude) {
  const opened = await open({ width: 1366, height: 768, serviceWorkers: 'block' });
  await opened.context.route('**/storage.js', async (route) => {
    const answer = await route.fetch();
    await route.fulfill({ response: answer, body: `${prelude}\n${await answer.text()}` });
  });
  await afresh(opened.page);
  return opened;
}

/** Journals in the storage, read by the functions of the page: bytes and generations. */
const journals = (page) =>
  page.evaluate(async () => {
    const top = await (await navigator.storage.getDirectory()).getDirectoryHandle('sightline');
    const all = [];
    for await (const folder of (await top.getDirectoryHandle('projects')).values()) {
      for await (const file of folder.values()) {
        // One that goes away meanwhile has been condensed.
        const content = file.name.startsWith('journal-') && (await file.getFile().catch(() => null));
        if (content) all.push({ name: file.name, bytes: content.size });
      }
    }
    return all;
  });

test('without a private file system the database keeps everything, also when the page is killed', { timeout: 600_000 }, async () => {
  const { page: first, context, url, profile, errors, close } = await openWith('delete StorageManager.prototype.getDirectory;');
  try {
    let page = first;
    await sample(page);
    await written(page);
    const [targets, results] = [await figure(page, 'targets'), await figure(page, 'results')];
    await go(page, 'control');
    for (let kill = 0; kill < 4; kill++) {
      for (let edit = 0; edit < 5; edit++) await rename(page, `${kill} ${edit}`);
      const role = page.locator('.preview select').first();
      const chosen = (await role.inputValue()) === 'check' ? 'control' : 'check';
      await role.selectOption(chosen);
      await page.waitForTimeout(1000);
      const crashed = page.waitForEvent('crash');
      assert.ok(killRenderers(profile) > 0);
      await crashed;
      const dead = page;
      page = await context.newPage();
      await dead.close().catch(() => {});
      await page.goto(url);
      await goOn(page);
      assert.equal(await page.inputValue('.project-name'), `${kill} 4`);
      await go(page, 'control');
      assert.equal(await page.locator('.preview select').first().inputValue(), chosen);
    }
    assert.equal(await figure(page, 'photos'), '8');
    assert.equal(await figure(page, 'targets'), targets);
    // The roles are as they were, and four changes of them can be undone: then the result is that of the beginning.
    for (let undo = 0; undo < 4; undo++) {
      await page.waitForFunction(() => document.querySelector('.tools .icon-button')?.disabled === false);
      await page.click('.tools .icon-button');
    }
    assert.equal(await figure(page, 'results'), results);
    const files = await downloads(page, 1, () => save(page));
    assert.equal(Object.keys(unzipped(Object.values(files)[0])).filter((name) => name.startsWith('photos/')).length, 8);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a full disk is told, the file is the way out, and what waited is written when there is room', { timeout: 600_000 }, async () => {
  const { page, context, url, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await written(page);
    const session = await context.newCDPSession(page);
    const { origin } = new URL(url);
    const { usage } = await session.send('Storage.getUsageAndQuota', { origin });
    await session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: usage + 50_000 });
    await go(page, 'control');
    let told = false;
    for (let edit = 0; edit < 400 && !told; edit++) {
      await rename(page, `Full ${edit} ${'x'.repeat(2000)}`);
      told = await page.evaluate(() => /storage of this computer is full/.test(document.querySelector('.notices')?.textContent ?? ''));
    }
    assert.ok(told, 'the full storage was not told');
    await storageLine(page, 'full.*Download the project file');
    await rename(page, 'The last name');
    // Everything is in the file.
    const files = await downloads(page, 1, () => save(page));
    const inside = unzipped(Object.values(files)[0]);
    assert.equal(JSON.parse(inside['project.json']).name, 'The last name');
    assert.equal(Object.keys(inside).filter((name) => name.startsWith('photos/')).length, 8);
    // Someone makes room: nothing has to be done for what waited.
    await session.send('Storage.overrideQuotaForOrigin', { origin });
    await written(page);
    await afresh(page);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'The last name');
    assert.equal(await figure(page, 'photos'), '8');
  } finally {
    await close();
  }
});

test('photos that do not fit are told, and stay in use', { timeout: 600_000 }, async () => {
  const { page, context, url, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    // The page itself is kept for times without a network: what it takes is taken before the room is measured.
    await page.evaluate(async () => (await navigator.serviceWorker?.ready)?.active);
    const session = await context.newCDPSession(page);
    const { origin } = new URL(url);
    const { usage } = await session.send('Storage.getUsageAndQuota', { origin });
    await session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: usage + 5_000_000 });
    await sample(page);
    const used = async () => (await session.send('Storage.getUsageAndQuota', { origin })).usage;
    const room = async (bytes) => session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: await used() + bytes });
    await storageLine(page, 'not copied|is full');
    // Until every photo has been tried: one that is still to come would take the room that is made.
    for (let before; before !== (before = await used());) await page.waitForTimeout(3000);
    // Photos and what is written beside them come in any order; browsers give files their room by the megabyte. Now there is enough for the
    // document, and not for all that is missing of the photos.
    await room(2_500_000);
    // The message stays as long as its cause exists, whatever else is reported.
    await storageLine(page, '\\d photos? (is|are) not copied .*\\(storage full\\).*download it with photos');
    await page.waitForFunction(() => /saved \S+( [AP]M)?, without \d photos?/.test(document.querySelector('.project span')?.textContent));
    // What cannot be written is tried every few seconds, and takes no more room for that.
    await room(0);
    await rename(page, `Without room ${'x'.repeat(20_000)}`);
    await storageLine(page, 'is full');
    const stored = await journals(page);
    await page.waitForTimeout(11_000);
    await storageLine(page, 'is full');
    assert.deepEqual(await journals(page), stored);
    await room(400_000);
    await go(page, 'targets');
    const targets = await figure(page, 'targets');
    await page.click('[data-action=detect]');
    await idle(page);
    assert.equal(await figure(page, 'targets'), targets);
    await storageLine(page, 'not copied|is full');
    // Someone makes room: with the next thing that is written the photos find it, and outlast the page.
    await room(0);
    await rename(page, `Full ${'x'.repeat(20_000)}`);
    await storageLine(page, 'is full');
    await session.send('Storage.overrideQuotaForOrigin', { origin });
    await rename(page, 'Room');
    await page.waitForFunction(() => !/not copied|is full/.test(document.querySelector('.foot .storage')?.textContent), undefined, { timeout: 60_000 });
    await written(page);
    await afresh(page);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'Room');
    assert.equal(await figure(page, 'photos'), '8');
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await idle(page);
    assert.equal(await figure(page, 'targets'), targets);
  } finally {
    await close();
  }
});

for (const [kind, prelude] of [['files', ''], ['database', 'delete StorageManager.prototype.getDirectory;']]) {
  test(`storage that is cleared under the page (${kind}) is told, and nothing is lost`, { timeout: 600_000 }, async () => {
    const { page, context, url, close } = await openWith(prelude);
    try {
      // Photos of one's own: their files are still available.
      await sample(page);
      const files = await downloads(page, 1, () => save(page));
      await page.click('.mark');
      await drop(page, [scratch('own.sightline', Object.values(files)[0])]);
      await page.waitForFunction(() => location.hash === '#results');
      await idle(page);
      await rename(page, 'Before');
      await written(page);
      // The copies are made, and in use.
      await page.waitForTimeout(2000);
      const session = await context.newCDPSession(page);
      await session.send('Storage.clearDataForOrigin', { origin: new URL(url).origin, storageTypes: 'all' });
      await rename(page, 'After');
      await page.waitForFunction(() => /cleared its storage/.test(document.querySelector('.notices')?.textContent ?? ''), undefined, { timeout: 30_000 });
      assert.match(await notice(page), /stored again with its photos/);
      await written(page);
      // The way out: everything is in the file, photos from where they came.
      const saved = unzipped(Object.values(await downloads(page, 1, () => save(page)))[0]);
      assert.equal(JSON.parse(saved['project.json']).name, 'After');
      assert.equal(Object.keys(saved).filter((name) => name.startsWith('photos/')).length, 8);
      await page.waitForTimeout(2000);
      await afresh(page);
      await goOn(page);
      assert.equal(await page.inputValue('.project-name'), 'After');
      assert.equal(await figure(page, 'photos'), '8');
      await go(page, 'targets');
      const targets = await figure(page, 'targets');
      await page.click('[data-action=detect]');
      await idle(page);
      assert.equal(await figure(page, 'targets'), targets);
    } finally {
      await close();
    }
  });
}

test('storage cleared under two windows is stored again by both, whichever is closed first', { timeout: 600_000 }, async () => {
  const { page: first, context, url, close } = await open({ width: 1366, height: 768 });
  try {
    const second = await context.newPage();
    await second.goto(url);
    for (const [page, name] of [[first, 'One'], [second, 'Two']]) {
      await page.bringToFront();
      await drop(page, [scratch(`${name}.json`, named(name))]);
      await page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted, name);
      await written(page);
    }
    const session = await context.newCDPSession(first);
    await session.send('Storage.clearDataForOrigin', { origin: new URL(url).origin, storageTypes: 'all' });
    // The first one notices; the other one is informed and was not used.
    await first.bringToFront();
    await rename(first, 'One after');
    for (const page of [first, second]) {
      await page.waitForFunction(() => /cleared its storage/.test(document.querySelector('.notices')?.textContent ?? ''), undefined, { timeout: 30_000 });
      await written(page);
    }
    await second.close();
    await first.waitForTimeout(1000);
    await afresh(first);
    await first.waitForSelector('[data-project]');
    const names = await first.$$eval('[data-project]', (all) => all.map((row) => row.textContent));
    assert.equal(names.length, 2, names.join());
    for (const name of ['One after', 'Two']) assert.ok(names.some((text) => text.includes(name)), `${name} in ${names.join()}`);
  } finally {
    await close();
  }
});

test('storage that was cleared since the last visit is told', { timeout: 300_000 }, async () => {
  const { page, context, url, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [scratch('one.json', named('One'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'One');
    await written(page);
    await page.click('.mark');
    await page.waitForSelector('[data-project]');
    const session = await context.newCDPSession(page);
    await session.send('Storage.clearDataForOrigin', { origin: new URL(url).origin, storageTypes: 'file_systems,indexeddb' });
    await afresh(page);
    await page.waitForFunction(() => /cleared its storage: 1 project/.test(document.querySelector('.notices')?.textContent ?? ''), undefined, { timeout: 30_000 });
  } finally {
    await close();
  }
});

test('a private window keeps what it can, and says that it may go', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await openPrivately({ width: 1366, height: 768 });
  try {
    await sample(page);
    await written(page);
    await storageLine(page, 'may clear it|stores nothing');
    await rename(page, 'Private');
    await written(page);
    await afresh(page);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'Private');
    const files = await downloads(page, 1, () => save(page));
    assert.equal(JSON.parse(unzipped(Object.values(files)[0])['project.json']).name, 'Private');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('the journal of a long session is condensed, and nothing of it is lost', { timeout: 900_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    // A large document, so that every whole part counts.
    const points = Array.from({ length: 9000 }, (_, k) => ({ id: `p${k}`, role: 'control', xyz: [k / 7, k / 11, k / 13], sigma: [0.1, 0.1, 0.1] }));
    await drop(page, [scratch('large.json', JSON.stringify({ format: 'sightline', version: 1, name: 'Large', unit: 'mm', points }))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Large');
    await written(page);
    const [{ bytes: whole }] = await journals(page);
    await page.click('.to-tables');
    await page.click('[data-table=Points]');
    await page.waitForSelector('.sheet tr.data');
    let most = 0;
    let generation = 1;
    for (let round = 0; round < 8; round++) {
      // An edit of one thing writes little; one of every point is written whole, and stays as long as it can be undone.
      for (const role of round < 3 ? ['check', 'control'] : []) {
        await page.locator('.sheet table').focus();
        await page.keyboard.press('Control+a');
        await page.selectOption('.sheet-actions select[name=role]', role);
      }
      for (let edit = 0; edit < 70; edit++) await rename(page, `Large ${round} ${edit}`);
      await written(page);
      await page.waitForTimeout(4000);
      let all = await journals(page);
      // While a journal is condensed the new one stands beside it.
      for (let tries = 0; tries < 60 && all.length !== 1; tries++) {
        await page.waitForTimeout(500);
        all = await journals(page);
      }
      assert.equal(all.length, 1, JSON.stringify(all));
      most = Math.max(most, all[0].bytes);
      generation = Number(all[0].name.slice(8));
    }
    assert.ok(generation > 1, `never condensed: ${most} bytes after 566 edits of a document of ${whole}`);
    assert.ok(most < 12e6, `${most} bytes`);
    await afresh(page);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'Large 7 69');
    // What was done after condensing is kept as well.
    await rename(page, 'The end');
    await written(page);
    await afresh(page);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'The end');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** Changes the bytes of the one journal that is stored, by the page's own means; gives how many frames it has. */
const harmJournal = (page, harm) =>
  page.evaluate(async (harm) => {
    const { unframed } = await import(`${sightlineBase}storage/frames.js`);
    const harmed = (bytes, [from, to]) => {
      if (harm === 'bit') bytes[Math.floor((from + to) / 2)] ^= 4;
      if (harm === 'length') bytes[from + 2] ^= 1;
      if (harm === 'sector') bytes.fill(0, Math.floor((from + to) / 2), Math.min(to, Math.floor((from + to) / 2) + 64));
      return bytes;
    };
    if (navigator.storage?.getDirectory) {
      const top = await (await navigator.storage.getDirectory()).getDirectoryHandle('sightline');
      for await (const folder of (await top.getDirectoryHandle('projects')).values()) {
        for await (const file of folder.values()) {
          if (!file.name.startsWith('journal-')) continue;
          const bytes = new Uint8Array(await (await file.getFile()).arrayBuffer());
          const { frames } = unframed(bytes);
          const { at, end } = frames[harm === 'first' ? 0 : 4];
          if (harm === 'first') bytes.fill(7, at, at + 40);
          const out = await file.createWritable();
          await out.write(harm === 'tail' ? bytes.slice(0, frames.at(-1).end - 3) : harmed(bytes, [at, end]));
          await out.close();
          return frames.length;
        }
      }
    }
    const base = await new Promise((done) => (indexedDB.open('sightline').onsuccess = ({ target }) => done(target.result)));
    const store = base.transaction('frames', 'readwrite').objectStore('frames');
    const keys = await new Promise((done) => (store.getAllKeys().onsuccess = ({ target }) => done(target.result)));
    const key = harm === 'first' ? keys[0] : harm === 'tail' ? keys.at(-1) : keys[4];
    const bytes = await new Promise((done) => (store.get(key).onsuccess = ({ target }) => done(target.result)));
    if (harm === 'first') bytes.fill(7, 0, 40);
    const written = harm === 'tail' ? bytes.slice(0, bytes.length - 3) : harmed(bytes, [0, bytes.length]);
    await new Promise((done) => (store.put(written, key).onsuccess = done));
    base.close();
    return keys.length;
  }, harm);

test('a copy whose card could not be written is listed by its own name', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [scratch('origin.json', named('Origin'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Origin');
    await written(page);
    await page.click('.mark');
    await waitForList(page, ['Origin']);
    await verb(page, 'Origin', 'Duplicate');
    await waitForList(page, ['Origin (copy)', 'Origin']);
    const taken = await page.evaluate(async () => {
      const top = await (await navigator.storage.getDirectory()).getDirectoryHandle('sightline');
      const projects = await top.getDirectoryHandle('projects');
      let taken = 0;
      for await (const folder of projects.values()) {
        for (const name of ['card-0', 'card-1']) {
          const card = await folder.getFileHandle(name).catch(() => null);
          if (card && (await (await card.getFile()).text()).includes('(copy)')) taken += (await folder.removeEntry(name), 1);
        }
      }
      return taken;
    });
    assert.equal(taken, 1);
    await afresh(page);
    await page.waitForSelector('[data-project]');
    await page.waitForTimeout(500);
    assert.deepEqual((await page.$$eval('[data-project] .name', (all) => all.map((one) => one.textContent.trim()))).sort(), ['Origin', 'Origin (copy)']);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** Changes of the journal, and the report about them. */
const harms = [['bit', /repaired; no data are lost/], ['length', /repaired; no data are lost/], ['sector', /was damaged/], ['first', null], ['tail', null]];
for (const [kind, address] of [['files', () => undefined], ['database', plainHttp]]) {
  test(`a damaged journal (${kind}) is mended or told, what can be read of it is open, and the damaged one can be downloaded`, { timeout: 600_000 }, async () => {
    for (const [harm, known] of harms) {
      // A database writes a record whole or not at all: one that is cut was damaged.
      const told = harm === 'tail' && kind === 'database' ? /The end of this stored project was damaged/ : known;
      // A browser for each: a deleted project's journal is kept for a day.
      const { page, errors, close } = await open({ width: 1366, height: 768, address: address() });
      try {
        // Large enough that the journal stores later names as differences from the first snapshot.
        const points = Array.from({ length: 60 }, (_, k) => ({ id: `p${k}`, role: 'control', xyz: [k, k, k], sigma: [0.1, 0.1, 0.1] }));
        await drop(page, [scratch('harmed.json', JSON.stringify({ format: 'sightline', version: 1, name: 'Edit 0', unit: 'mm', points }))]);
        await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Edit 0');
        await go(page, 'control');
        for (let edit = 1; edit <= 11; edit++) {
          // A step of the history as well.
          if (edit % 4 === 0) {
            await page.fill('[name=unit]', edit % 8 ? 'm' : 'mm');
            await page.press('[name=unit]', 'Enter');
            await page.locator('.asking').getByRole('button', { name: /^Convert/ }).click();
          }
          await rename(page, `Edit ${edit}`);
          await written(page);
        }
        await page.click('.mark');
        await afresh(page);
        await page.waitForSelector('[data-project]');
        const frames = await harmJournal(page, harm);
        assert.ok(frames >= 12, `${frames} frames`);
        await afresh(page);
        await page.waitForSelector('[data-project]');
        if (harm === 'first') {
          // What everything after it builds on is gone: that is said, and the journal can be downloaded, once however often it is opened.
          for (let time = 0; time < 2; time++) {
            await page.click('[data-project] .do .button');
            await page.waitForSelector('.notice.warning:has-text("could not be read")');
            await page.waitForTimeout(500);
            const files = await downloads(page, 1, () => verb(page, 'Edit 11', 'Download damaged file'));
            assert.ok(Object.values(files)[0].length > 500);
            await afresh(page);
            await page.waitForSelector('[data-project]');
          }
          continue;
        }
        await goOn(page);
        const name = await page.inputValue('.project-name');
        if (told) assert.match(await page.textContent('.notices'), told, harm);
        else assert.equal(await page.locator('.notice.warning').count(), 0, harm);
        if (['bit', 'length'].includes(harm)) {
          assert.equal(name, 'Edit 11', harm);
          // What could be undone still can.
          await page.waitForFunction(() => document.querySelector('.tools .icon-button')?.disabled === false);
        }
        if (harm === 'tail') assert.equal(name, 'Edit 10');
        console.log(`${kind}, ${harm}: ${name} of Edit 11`);
        // It is stored anew, and goes on.
        await rename(page, `Saved ${harm}`);
        await written(page);
        await afresh(page);
        await page.waitForSelector('[data-project]');
        await goOn(page);
        assert.equal(await page.inputValue('.project-name'), `Saved ${harm}`);
        assert.equal(await page.locator('.notice.warning').count(), 0);
        await page.click('.mark');
        await page.waitForSelector('[data-project]');
        await page.waitForTimeout(300);
        if (told) {
          const files = await downloads(page, 1, () => verb(page, `Saved ${harm}`, 'Download damaged file'));
          assert.ok(Object.values(files)[0].length > 500);
        }
        assert.deepEqual(errors, []);
      } finally {
        await close();
      }
    }
  });
}

test('one button deletes everything that the page keeps, and not while another window has a project', { timeout: 300_000 }, async () => {
  const { page, context, url, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [scratch('one.json', named('One'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'One');
    await written(page);
    const second = await context.newPage();
    await second.goto(url);
    await second.waitForSelector('[data-project]');
    const wipe = async (window) => {
      await window.click('.wipe');
      await window.locator('.asking').getByRole('button', { name: 'Delete everything' }).click();
    };
    await wipe(second);
    await second.waitForSelector('.notice:has-text("open in another window")');
    await afresh(page);
    await page.waitForSelector('[data-project]');
    await second.close();
    await page.evaluate(() => localStorage.setItem('sightline.theme', 'dark'));
    await page.click('.wipe');
    await Promise.all([page.waitForEvent('load'), page.locator('.asking').getByRole('button', { name: 'Delete everything' }).click()]);
    await page.waitForSelector('.sample');
    await page.waitForTimeout(500);
    assert.equal(await page.locator('[data-project]').count(), 0);
    assert.doesNotMatch(await page.textContent('.notices'), /cleared/);
    assert.equal(await page.evaluate(() => localStorage.getItem('sightline.theme')), null);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
