// Two windows of one browser work on the same projects, over loopback and over plain HTTP (without Web Locks). No edit of either window is
// lost, and the list shows every project.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open, plainHttp } from './browser.mjs';
import { afresh, drop, go, goOn, idle, listed, named, notice, owns, rename, sample, verb, waitForList, written } from './desk.mjs';

const WAYS = [['loopback', () => undefined], ['plain HTTP', plainHttp]];

/** A project of a name, opened from a file and stored. */
async function begin(page, name) {
  await drop(page, [named(name)]);
  await page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted, name);
  await written(page);
}

/** Another window on the page, with its list read. */
async function another({ context, url }) {
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForSelector('.sample');
  return page;
}

/** The worker that keeps projects. */
const storageOf = (page) => page.workers().find((worker) => worker.url().endsWith('/storage.js'));

const start = async (page) => {
  await page.click('.mark');
  await page.waitForSelector('.sample');
};

for (const [way, address] of WAYS) {
  test(`a deletion is undone after another window was opened (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address() });
    const { page, errors, close } = opened;
    try {
      await begin(page, 'One');
      await begin(page, 'Two');
      await start(page);
      await waitForList(page, ['One', 'Two']);
      await verb(page, 'One', 'Delete');
      await waitForList(page, ['Two']);
      const second = await another(opened);
      await waitForList(second, ['Two']);
      await afresh(second);
      await waitForList(second, ['Two']);
      // It can be got back there, too.
      assert.equal(await second.locator('[data-deleted]').count(), 1);
      await page.bringToFront();
      await page.locator('.notice').getByRole('button', { name: 'Undo' }).click();
      await waitForList(page, ['One', 'Two']);
      await afresh(second);
      await waitForList(second, ['One', 'Two']);
      assert.equal(await second.locator('[data-deleted]').count(), 0);
      await goOn(second, 'One');
      // Deleted in one, put back in the other.
      await start(page);
      await verb(page, 'Two', 'Delete');
      await waitForList(page, ['One']);
      await afresh(second);
      await second.waitForSelector('[data-deleted]');
      await second.locator('[data-deleted]').getByRole('button', { name: 'Put back' }).click();
      await waitForList(second, ['One', 'Two']);
      await afresh(page);
      await waitForList(page, ['One', 'Two']);
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });

  test(`what is open in another window is neither deleted nor renamed here (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address() });
    const { page, errors, close } = opened;
    try {
      await begin(page, 'One');
      const second = await another(opened);
      await waitForList(second, ['One']);
      await verb(second, 'One', 'Delete');
      await second.waitForSelector('.notice:has-text("open in another window")');
      await waitForList(second, ['One']);
      await verb(second, 'One', 'Rename');
      await second.fill('[data-project] input', 'Other');
      await second.press('[data-project] input', 'Enter');
      await second.waitForSelector('.notice:has-text("open in another window")');
      await page.bringToFront();
      await rename(page, 'One more');
      await written(page);
      await afresh(second);
      await waitForList(second, ['One more']);
      // Where it is open it is deleted, with what was done last, and comes back with it.
      await rename(page, 'One at last');
      await start(page);
      await verb(page, 'One at last', 'Delete');
      await waitForList(page, []);
      await page.locator('.notice').getByRole('button', { name: 'Undo' }).click();
      await waitForList(page, ['One at last']);
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });

  test(`the only project is deleted, and nobody says that storage was cleared (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address() });
    const { page, errors, close } = opened;
    try {
      await begin(page, 'One');
      await start(page);
      await verb(page, 'One', 'Delete');
      await waitForList(page, []);
      for (const window of [page, await another(opened)]) {
        await afresh(window);
        await window.waitForSelector('[data-deleted]');
        assert.doesNotMatch(await window.textContent('.notices'), /cleared/);
      }
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });

  test(`a second window only reads along, and takes over with all that was done (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address() });
    const { page, errors, close } = opened;
    try {
      await begin(page, 'One');
      const second = await another(opened);
      await goOn(second, 'One');
      await second.waitForSelector('.notice:has-text("open in another window")');
      // Changes of the same length from both windows: those of the one that only reads are refused.
      await rename(page, '1234.567');
      await second.waitForFunction(() => document.querySelector('.project-name')?.value === '1234.567');
      await rename(second, '9876.543');
      assert.match(await second.textContent('.notices'), /Read-only/);
      await rename(page, '1234.568');
      await written(page);
      for (let round = 0; round < 6; round++) {
        const [from, to] = round % 2 ? [second, page] : [page, second];
        await to.bringToFront();
        // Not all of it is written when it is taken over.
        await from.evaluate((value) => {
          const field = document.querySelector('.project-name');
          for (let i = 0; i < 20; i++) {
            field.value = `${value} ${i}`;
            field.dispatchEvent(new Event('change', { bubbles: true }));
          }
        }, `Round ${round}`);
        await to.getByRole('button', { name: 'Take over' }).click();
        await to.waitForFunction((name) => document.querySelector('.project-name')?.value === name, `Round ${round} 19`, { timeout: 20_000 });
        await owns(to);
        await from.waitForSelector('.notice:has-text("open in another window")');
        await rename(to, `Taken ${round}`);
        await written(to);
        await from.waitForFunction((name) => document.querySelector('.project-name')?.value === name, `Taken ${round}`);
      }
      const third = await another(opened);
      await waitForList(third, ['Taken 5']);
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });

  test(`what a writer that was passed over could not store is a project of its own (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address() });
    const { page, close } = opened;
    try {
      await begin(page, 'One');
      const second = await another(opened);
      await goOn(second, 'One');
      await second.waitForSelector('.notice:has-text("open in another window")');
      // It answers nobody for a while, like one that the system has suspended.
      storageOf(page).evaluate('{ const until = Date.now() + 9000; while (Date.now() < until); }').catch(() => {});
      await page.waitForTimeout(200);
      await rename(page, 'Late');
      await second.getByRole('button', { name: 'Take over' }).click();
      await owns(second);
      await rename(second, 'Two');
      await written(second);
      await page.bringToFront();
      await page.waitForSelector('.notice:has-text("Late (copy)")', { timeout: 30_000 });
      await written(page);
      const third = await another(opened);
      await waitForList(third, ['Late (copy)', 'Two']);
    } finally {
      await close();
    }
  });

  test(`the end of the storage worker is noticed, and what was not written is written by another (${way})`, { timeout: 300_000 }, async () => {
    const opened = await open({ width: 1366, height: 768, address: address(), serviceWorkers: 'block' });
    const { page, context, url, close } = opened;
    try {
      await begin(page, 'One');
      for (let round = 0; round < 4; round++) {
        const worker = storageOf(page);
        // Now, or when it has written and would say so.
        const dying = round % 2 ? 'setTimeout(() => self.close())' : 'self.postMessage = () => self.close()';
        await worker.evaluate(`${dying}; 0`).catch(() => {});
        await rename(page, `Round ${round}`);
        await written(page);
        assert.notEqual(storageOf(page), worker);
        await rename(page, `Round ${round} and on`);
        await written(page);
      }
      // Renaming cannot be undone, so that the last stored name is what tells whether everything was written.
      await afresh(page);
      await waitForList(page, ['Round 3 and on']);
      await goOn(page, 'Round 3 and on');
      // If the worker cannot be started again, the page says so in red and keeps trying.
      await context.route('**/storage.js', (route) => route.abort());
      await storageOf(page).evaluate('setTimeout(() => self.close()); 0').catch(() => {});
      await rename(page, 'Waiting');
      await page.waitForSelector('.project span.bad', { timeout: 10_000 });
      assert.match(await page.textContent('.project span.bad'), /not saved/);
      await context.unroute('**/storage.js');
      await written(page);
      const second = await another(opened);
      await waitForList(second, ['Waiting']);
    } finally {
      await close();
    }
  });
}

test('over plain HTTP the end of an engine worker is noticed, too, and cells are copied', { timeout: 300_000 }, async () => {
  const { page, close } = await open({ width: 1366, height: 768, address: plainHttp(), cores: 1 });
  try {
    await sample(page);
    await idle(page);
    const engine = page.workers().find((worker) => worker.url().endsWith('/worker.js'));
    await engine.evaluate('{ const post = self.postMessage.bind(self); self.postMessage = (message, ...rest) => (message.body === undefined ? post(message, ...rest) : self.close()); }');
    await go(page, 'targets');
    const targets = (await page.textContent('[data-step=targets] .figure')).trim();
    await page.click('[data-action=detect]');
    await idle(page, 60_000);
    assert.equal((await page.textContent('[data-step=targets] .figure')).trim(), targets);
    await page.click('.to-tables');
    await page.click('[data-action=copy]');
    assert.equal(await page.locator('.notice.warning').count(), 0, await page.textContent('.notices'));
    // What it put there is there to be pasted.
    await page.evaluate(() => document.body.appendChild(Object.assign(document.createElement('textarea'), { id: 'elsewhere' })).focus());
    await page.keyboard.press('Control+v');
    assert.match(await page.inputValue('#elsewhere'), /\t/);
  } finally {
    await close();
  }
});

/** Writes a project's card anew, by the page's own means. */
const harmCard = (page, name, harm) =>
  page.evaluate(async ([name, harm]) => {
    const harmed = (card) => ({ nothing: {}, list: [], types: { ...card, photos: 'many', outcome: 7 }, newer: { ...card, outcome: 'Splendid' } })[harm];
    if (navigator.storage?.getDirectory) {
      const { default: frames } = { default: await import(`${sightlineBase}storage/frames.js`) };
      const top = await (await navigator.storage.getDirectory()).getDirectoryHandle('sightline');
      for await (const folder of (await top.getDirectoryHandle('projects')).values()) {
        const cards = [];
        for await (const file of folder.values()) if (file.name.startsWith('card-')) cards.push(file);
        const read = await Promise.all(cards.map(async (file) => frames.unframed(new Uint8Array(await (await file.getFile()).arrayBuffer())).frames[0].items[0]));
        if (!read.some((card) => card.name === name)) continue;
        for (const [i, file] of cards.entries()) {
          const out = await file.createWritable();
          await out.write(harm === 'noise' ? crypto.getRandomValues(new Uint8Array(300)) : harm === 'none' ? new Uint8Array() : frames.framed([{ turn: read[i].turn, ...harmed(read[i]) }]));
          await out.close();
        }
      }
      return;
    }
    const base = await new Promise((done) => (indexedDB.open('sightline').onsuccess = ({ target }) => done(target.result)));
    const store = base.transaction('cards', 'readwrite').objectStore('cards');
    await new Promise((done) => {
      store.openCursor().onsuccess = ({ target: { result: cursor } }) => {
        if (!cursor) return done();
        if (typeof cursor.key === 'string' && cursor.value?.name === name) {
          if (harm === 'none') cursor.delete();
          else cursor.update(harm === 'noise' ? 'noise' : harmed(cursor.value));
        }
        cursor.continue();
      };
    });
    base.close();
  }, [name, harm]);

for (const [way, address] of WAYS) {
  test(`a card that is lost or damaged hides no project (${way})`, { timeout: 300_000 }, async () => {
    const { page, errors, close } = await open({ width: 1366, height: 768, address: address() });
    try {
      for (const name of ['One', 'Two', 'Three']) await begin(page, name);
      for (const harm of ['nothing', 'list', 'types', 'newer', 'none', 'noise']) {
        await start(page);
        await waitForList(page, ['One', 'Two', 'Three']);
        await afresh(page);
        await waitForList(page, ['One', 'Two', 'Three']);
        await harmCard(page, 'Two', harm);
        await afresh(page);
        await waitForList(page, ['One', 'Two', 'Three']);
        await goOn(page, 'Two');
        // The next change writes a card again.
        await rename(page, 'Two again');
        await rename(page, 'Two');
        await written(page);
      }
      assert.deepEqual(errors, []);
      assert.equal((await listed(page)).length, 0);
      assert.ok(!(await notice(page).catch(() => '')).includes('could not'));
    } finally {
      await close();
    }
  });
}
