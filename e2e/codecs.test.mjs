// Formats whose decoders are a file of their own: it is fetched when the first such photo comes, and kept.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { dist, open } from './browser.mjs';
import { afresh, detect, drop, idle, photos, sample } from './desk.mjs';

let writtenTo;
/** A folder with photo.heic and photo.dng, written once. */
const written = () => {
  if (!writtenTo) {
    writtenTo = mkdtempSync(join(tmpdir(), 'sightline-written-'));
    execFileSync(join(process.env.SIGHTLINE_EXAMPLES, 'written'), [writtenTo]);
  }
  return writtenTo;
};

const count = (text) => Number(text.replace(/\D/g, ''));

test('HEIC and RAW are opened and measured, and without one no decoder is fetched', { timeout: 180_000 }, async () => {
  const folder = written();
  const { page, context, errors, close } = await open({ width: 1366, height: 768 });
  const asked = [];
  context.on('request', (request) => asked.push(request.url()));
  const decoders = () => asked.filter((url) => url.includes('sightline-codecs'));
  try {
    await sample(page);
    assert.ok(await page.evaluate(async () => Boolean((await navigator.serviceWorker.ready).active)));
    assert.deepEqual(decoders(), [], 'PNG photos need none');
    await page.click('.mark');
    await afresh(page);
    await photos(page, [join(folder, 'photo.heic')]);
    assert.equal(await page.locator('.tile').count(), 1);
    assert.equal(await page.locator('.problems li').count(), 0);
    assert.ok(decoders().some((url) => url.endsWith('_bg.wasm')));
    // A RAW of the same name is the same shot: it is named, not measured as a second one.
    await drop(page, [join(folder, 'photo.dng')]);
    await page.waitForSelector('.problems li');
    assert.match(await page.textContent('.problems li'), /photo\.dng.*same exposure as photo\.heic/);
    assert.equal(await page.locator('.tile').count(), 1);
    // The user chooses: the RAW in its place, back again by undo, and the other one by another click.
    const shown = () => page.$$eval('.tile', (all) => all.map((tile) => tile.textContent).join());
    await page.click('[data-action="swap"]');
    await page.waitForFunction(() => document.querySelector('.tile').textContent.includes('photo.dng'));
    assert.match(await page.textContent('.problems li'), /photo\.heic.*same exposure as photo\.dng/);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => document.querySelector('.tile').textContent.includes('photo.heic'));
    assert.match(await page.textContent('.problems li'), /photo\.dng.*same exposure as photo\.heic/);
    await page.keyboard.press('Control+Shift+Z');
    await page.waitForFunction(() => document.querySelector('.tile').textContent.includes('photo.dng'));
    await page.click('[data-action="swap"]');
    await page.waitForFunction(() => document.querySelector('.tile').textContent.includes('photo.heic'));
    assert.ok(!(await shown()).includes('photo.dng'));
    // The picture of a RAW that has no preview comes from its samples.
    copyFileSync(join(folder, 'photo.dng'), join(folder, 'other.dng'));
    await drop(page, [join(folder, 'other.dng')]);
    await page.waitForFunction(() => document.querySelectorAll('.tile').length === 2);
    await idle(page);
    await detect(page, {});
    const found = count(await page.textContent('[data-step=targets] .figure'));
    assert.ok(found > 80, `${found} targets`);
    await page.locator('.strip [data-photo]').nth(1).click();
    await page.waitForFunction(() => /green pixels \(RGGB\)/.test(document.querySelector('[data-result=picture]')?.textContent ?? ''));
    // What was asked for once is there without a network from then on.
    const kept = () => page.evaluate(async () => {
      const all = await Promise.all((await caches.keys()).map(async (key) => (await (await caches.open(key)).keys()).map(({ url }) => url)));
      return all.flat().some((url) => url.endsWith('sightline-codecs_bg.wasm'));
    });
    await afresh(page);
    await page.waitForSelector('.desk');
    assert.ok(await page.evaluate(() => Boolean(navigator.serviceWorker.controller)), 'the service worker is in charge');
    await page.evaluate(async () => (await fetch(`${sightlineBase}sightline-codecs_bg.wasm`)).arrayBuffer());
    assert.ok(await kept());
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('the single file has the decoders inside', { timeout: 120_000 }, async () => {
  const folder = written();
  const address = pathToFileURL(join(dist, 'sightline.html')).href;
  const { page, errors, close } = await open({ address, width: 1366, height: 768 });
  try {
    await page.waitForSelector('.sample');
    await photos(page, [join(folder, 'photo.heic')]);
    assert.equal(await page.locator('.tile').count(), 1);
    assert.equal(await page.locator('.problems li').count(), 0);
    await detect(page, {});
    const found = count(await page.textContent('[data-step=targets] .figure'));
    assert.ok(found > 40, `${found} targets`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('HEIC photos show the thumbnails that they carry before any of them is decoded', { timeout: 120_000 }, async () => {
  const folder = written();
  const photo = readFileSync(join(folder, 'photo.heic'));
  // as many different photos: a box that says nothing at the end
  const paths = Array.from({ length: 8 }, (_, k) => {
    const path = join(folder, `early${k}.heic`);
    writeFileSync(path, Buffer.concat([photo, Buffer.from([0, 0, 0, 9]), Buffer.from('free'), Buffer.from([k])]));
    return path;
  });
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.desk');
    await page.evaluate(() => {
      window.early = 0;
      const look = () => {
        const taken = document.querySelectorAll('.tile').length;
        if (taken === 0) window.early = Math.max(window.early, document.querySelectorAll('.coming-tile canvas').length);
      };
      new MutationObserver(look).observe(document.body, { subtree: true, childList: true });
    });
    await photos(page, paths);
    assert.equal(await page.locator('.tile').count(), 8);
    assert.equal(await page.evaluate(() => window.early), 8);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
