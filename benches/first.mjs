// The first minute: how long until there is something to read over a slow line (4 Mbit/s, 40 ms there and back, nothing kept from before), until
// the desk takes input, and what holds the page's own thread up while the sample opens.
//   cd e2e && npm ci; cd ..; node benches/first.mjs [--runs 5] [dist]
import { parseArgs } from 'node:util';

import { served } from './served.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { runs: { type: 'string', default: '5' } } });
process.env.CHROMIUM ??= 'chromium';
const RUNS = Number(values.runs);
/** The longest that may pass until the first content, and the longest task, in ms. */
const [FIRST, STALL] = [1000, 100];
const server = await served(positionals[0] ?? 'dist', { compressed: true });
const { open } = await import('../e2e/browser.mjs');
const median = (all) => all.toSorted((a, b) => a - b)[Math.floor(all.length / 2)];
const shown = (all) => `${median(all).toFixed(0)} ms (${Math.min(...all).toFixed(0)} to ${Math.max(...all).toFixed(0)})`;

const [content, ready] = [[], []];
for (let run = 0; run < RUNS; run += 1) {
  const { page, context, close } = await open({ width: 1366, height: 768, address: `${process.env.SIGHTLINE_URL}icon.svg` });
  try {
    const line = await context.newCDPSession(page);
    await line.send('Network.enable');
    await line.send('Network.setCacheDisabled', { cacheDisabled: true });
    await line.send('Network.emulateNetworkConditions', { offline: false, latency: 40, downloadThroughput: 4e6 / 8, uploadThroughput: 4e6 / 8 });
    await page.goto(process.env.SIGHTLINE_URL, { waitUntil: 'commit' });
    await page.waitForSelector('.desk', { timeout: 60_000 });
    ready.push(await page.evaluate(() => performance.now()));
    content.push(await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0].startTime));
  } finally {
    await close();
  }
}
console.log(`first content after ${shown(content)}, limit ${FIRST} ms; the desk stands after ${shown(ready)}`);

const all = [];
for (let run = 0; run < RUNS; run += 1) {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.sample');
    // The engine's module has come and is compiled.
    await page.waitForTimeout(3000);
    await page.evaluate(() => {
      window.tasks = [];
      new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map((entry) => Math.round(entry.duration)))).observe({ type: 'longtask' });
    });
    await page.click('.sample');
    await page.waitForFunction(() => location.hash === '#results', undefined, { timeout: 120_000 });
    await page.waitForTimeout(4000);
    all.push((await page.evaluate(() => window.tasks)).sort((a, b) => b - a));
  } finally {
    await close();
  }
}
console.log(`the sample opens: longest task ${shown(all.map((tasks) => tasks[0] ?? 0))}, limit ${STALL} ms; all over 50 ms: ${all.map((tasks) => tasks.join(' ')).join('; ')}`);
server.close();
