// A long session of edits on a large network: how long each holds up the page's own thread, what the page's memory grows by, what an edit
// writes to the journal, and how long the project takes to open again.
//   cd e2e && npm ci; cd ..; node benches/edits.mjs --network NETWORK.json [--edits 1000] [dist]
// NETWORK.json is a project file with control, for example P2 of ../shared/bench (`python3 ../shared/bench/problems.py OUT P2`).
import { readFileSync, readdirSync } from 'node:fs';
import { parseArgs } from 'node:util';

import { served } from './served.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { network: { type: 'string' }, edits: { type: 'string', default: '1000' } } });
const [dist = 'dist'] = positionals;
process.env.CHROMIUM ??= 'chromium';
const server = await served(dist);
const { open } = await import('../e2e/browser.mjs');
const { drop, go, written } = await import('../e2e/desk.mjs');
const at = (all, share) => all.toSorted((a, b) => a - b)[Math.min(all.length - 1, Math.floor(share * all.length))];

/** The largest process that draws pages, in MB: it is this page's. */
function renderer() {
  const sizes = readdirSync('/proc').filter((name) => /^\d+$/.test(name)).map((pid) => {
    try {
      if (!readFileSync(`/proc/${pid}/cmdline`, 'utf8').includes('--type=renderer')) return 0;
      return Number(/^Pss:\s+(\d+) kB/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))[1]) / 1024;
    } catch {
      return 0;
    }
  });
  return Math.max(...sizes);
}

const journal = (page) => page.evaluate(async () => {
  let size = 0;
  const walk = async (folder) => {
    for await (const [name, entry] of folder.entries()) {
      if (entry.kind === 'directory') await walk(entry);
      else if (name.startsWith('journal')) size += (await entry.getFile()).size;
    }
  };
  await walk(await navigator.storage.getDirectory());
  return size;
});

/**
 * Makes edits and returns how long each blocked the page's thread, in ms. `kind` is "datum" (the datum is switched) or "observations" (one
 * observation after the other is excluded and restored).
 */
const edited = (page, count, kind) => page.evaluate(async ([count, kind]) => {
  const { port1, port2 } = new MessageChannel();
  const task = () => new Promise((done) => {
    port2.onmessage = done;
    port1.postMessage(0);
  });
  const timed = async (element) => {
    const began = performance.now();
    element.click();
    await task();
    return performance.now() - began;
  };
  // As fast as a person who is in a hurry, so that the page draws between.
  const pause = () => new Promise((done) => setTimeout(done, 30));
  const times = [];
  for (let k = 0; times.length < count; k++) {
    if (kind === 'datum') {
      const radios = document.querySelectorAll('input[name=datum]');
      if (!radios[k % radios.length].checked) times.push(await timed(radios[k % radios.length]));
    } else {
      const rows = document.querySelectorAll('.sheet tr.data');
      rows[(k >> 1) % rows.length].querySelector('td[data-col]').click();
      await pause();
      times.push(await timed(document.querySelector(`[data-action=${k & 1 ? 'restore' : 'exclude'}]`)));
    }
    await pause();
  }
  return times;
}, [count, kind]);

const { page, close } = await open({ width: 1366, height: 768 });
try {
  await page.waitForSelector('.desk');
  await drop(page, [values.network]);
  await written(page);
  const count = Number(values.edits);
  for (const kind of ['datum', 'observations']) {
    if (kind === 'datum') {
      await go(page, 'control');
      await page.waitForSelector('input[name=datum]');
    } else {
      await page.click('.to-tables');
      await page.click('[data-table=Observations]');
      await page.waitForSelector('.sheet tr.data');
    }
    // The first edits also draw the page for the first time: they are not measured.
    await edited(page, 6, kind);
    await written(page);
    await page.waitForTimeout(3000);
    const [memory, stored] = [renderer(), await journal(page)];
    const times = await edited(page, count / 2, kind);
    await written(page);
    await page.waitForTimeout(3000);
    const [more, size] = [renderer(), await journal(page)];
    console.log(`${times.length} edits, ${kind}: median ${at(times, 0.5).toFixed(1)} ms, nine tenths within ${at(times, 0.9).toFixed(1)}, the longest ${at(times, 1).toFixed(1)}; the page ${memory.toFixed(0)} MB before and ${more.toFixed(0)} after; the journal ${((size - stored) / times.length / 1000).toFixed(1)} kB an edit`);
  }
  await page.reload();
  const began = performance.now();
  await page.waitForFunction(() => document.querySelectorAll('tbody tr').length > 5, undefined, { timeout: 60_000 });
  console.log(`open again after ${((performance.now() - began) / 1000).toFixed(2)} s`);
} finally {
  await close();
  server.close();
}
