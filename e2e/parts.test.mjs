// The page's module in parts: what comes first is small and stands without the rest, and a part that cannot be loaded is reported.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { brotliCompressSync } from 'node:zlib';

import { open } from './browser.mjs';

test('the page stands before the engine is there, and its first part is small', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open({ serviceWorkers: 'block' });
  try {
    let release;
    const held = new Promise((resolve) => (release = resolve));
    await page.route('**/sightline-worker_bg.wasm', async (route) => {
      await held;
      await route.continue();
    });
    await page.reload();
    // What can be done without the engine: a room beside the path, whose part is not waited for either, until it is asked for.
    await page.click('[data-open=plan]');
    await page.getByRole('heading', { name: 'Start a plan' }).waitFor();
    const came = () => page.evaluate(() => performance.getEntriesByType('resource').filter(({ responseEnd }) => responseEnd > 0).map(({ name }) => name));
    assert.ok(!(await came()).some((name) => name.endsWith('sightline-worker_bg.wasm')));
    release();
    const base = await page.evaluate(() => sightlineBase);
    const first = brotliCompressSync(Buffer.from(await (await fetch(new URL('desk_bg.wasm', base))).arrayBuffer())).length;
    console.log(`first part: ${Math.round(first / 1000)} kB with brotli`);
    assert.ok(first <= 650_000, `${first}`);
    const engine = brotliCompressSync(Buffer.from(await (await fetch(new URL('sightline-worker_bg.wasm', base))).arrayBuffer())).length;
    console.log(`first part of the engine: ${Math.round(engine / 1000)} kB with brotli`);
    assert.ok(engine <= 1_100_000, `${engine}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a part that does not come is told, and is had when it is asked for again', { timeout: 180_000 }, async () => {
  const { page, context, close } = await open({ serviceWorkers: 'block' });
  try {
    await page.route('**/desk_split_beside.wasm', (route) => route.abort());
    await page.reload();
    await page.click('[data-open=print]');
    await page.locator('main.absent[role=alert]').waitFor();
    assert.match(await page.textContent('main.absent'), /could not be loaded/);
    await page.unroute('**/desk_split_beside.wasm');
    await page.getByRole('button', { name: 'Try again' }).click();
    await page.getByRole('heading', { name: 'Targets to print' }).waitFor();

    await page.route('**/desk_split_steps.wasm', (route) => route.abort());
    await page.reload();
    await page.evaluate(() => (location.hash = '#start'));
    await page.click('button.sample');
    await page.locator('.notice.warning').waitFor();
    assert.match(await page.textContent('.notice'), /could not be loaded/);
    await page.unroute('**/desk_split_steps.wasm');

    // what comes of the engine with the first task that is not a photo's
    await context.route('**/worker_split_networks.wasm', (route) => route.abort());
    await page.click('button.sample');
    // the sample's photos are rendered and measured before
    await page.getByText('a part of the engine could not be loaded').waitFor({ timeout: 100_000 });
    await context.unroute('**/worker_split_networks.wasm');
    await page.click('button.sample');
    await page.waitForSelector('[data-result=sigma0]', { timeout: 100_000 });
  } finally {
    await close();
  }
});
