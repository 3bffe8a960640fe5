// The same photo gives the same targets on the page and in Node, bit for bit, whatever the number of workers.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { compare } from '../tests/face/compare.mjs';
import { sightline } from '../tests/face/engine.mjs';
import { tiff } from '../tests/face/tiff.mjs';
import { open } from './browser.mjs';
import { data, detect, downloads, files, go, idle, photos, sample, save, scratch, unzipped } from './desk.mjs';

/** Opens the page with so many cores, lets `work` fill it, and hands back the project file that it saves, as entries. */
async function saved(cores, photos, work) {
  const { page, errors, close } = await open({ cores });
  let workers = 0;
  const engines = () => page.workers().filter((worker) => worker.url().endsWith('/worker.js')).length;
  page.on('worker', () => (workers = Math.max(workers, engines())));
  try {
    await work(page);
    const given = await downloads(page, 1, () => save(page, photos));
    await idle(page);
    assert.deepEqual(errors, []);
    assert.equal(workers, cores, 'workers at the same time');
    return unzipped(Object.values(given)[0]);
  } finally {
    await close();
  }
}

/** The targets in a project file, with all digits. */
const targets = (entries) => JSON.parse(entries['targets.json']);

/** Compares what the page found in photos, by the names that it gave them, with what Node finds in the same bytes; how many targets. */
function sameInNode(found, bytes, options) {
  const names = Object.keys(found).sort();
  assert.equal(names.length, bytes.length);
  names.forEach((name, i) => compare(found[name], sightline.detect(bytes[i], options), 0, name));
  return names.reduce((sum, name) => sum + found[name].targets.length, 0);
}

test('the photos of the sample, which the page renders itself', { timeout: 600_000 }, async () => {
  let first;
  for (const cores of [1, 4]) {
    const entries = await saved(cores, true, sample);
    const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
    assert.equal(names.length, 8);
    const pictures = names.map((name) => entries[name]);
    assert.ok(sameInNode(targets(entries), pictures, { codes: 'auto' }) > 400);
    first ??= pictures;
    assert.ok(pictures.every((picture, i) => picture.equals(first[i])), 'rendered alike');
  }
});

for (const { name, ending, folder, choices, options, least } of [
  { name: 'photographs in colour, dark targets', ending: '.jpg', folder: 'camcal/photos', choices: { polarity: 'dark on bright', channel: 'green', codes: 'none' }, options: { polarity: 'dark', channel: 'green', codes: 'none' }, least: 360 },
  { name: 'photographs of coded targets', ending: '.tif', folder: 'panel', choices: { polarity: 'bright on dark', codes: 'Schneider / AICON 14 bit' }, options: { polarity: 'bright', codes: 'ring-14' }, least: 160 },
]) {
  const place = data(folder);
  test(name, { skip: place ? false : 'skipped, no data', timeout: 600_000 }, async () => {
    const paths = files(place, ending).slice(0, 4);
    const bytes = paths.map((path) => readFileSync(path));
    for (const cores of [1, 4]) {
      const entries = await saved(cores, false, async (page) => {
        await photos(page, paths);
        await detect(page, choices);
      });
      const count = sameInNode(targets(entries), bytes, options);
      assert.ok(count >= least, `${count} targets`);
    }
  });
}

/** A bright disc of 120 px with a soft edge. */
function disc(u, v) {
  const samples = new Uint8Array(400 * 300);
  const level = (x, y) => 40 + 160 / (1 + Math.exp(2 * (Math.hypot(x + 0.5 - u, y + 0.5 - v) - 60)));
  return samples.map((_, i) => Math.round(level(i % 400, Math.floor(i / 400))));
}

test('a click measures one target, before any detection, in one photo after the other', async () => {
  const places = [[205.3, 148.6], [190.8, 155.2]];
  const entries = await saved(1, false, async (page) => {
    await photos(page, places.map(([u, v], i) => scratch(`disc${i}.tif`, tiff(400, 300, disc(u, v)))));
    await go(page, 'identities');
    // A second click on a target finds it in the list.
    for (const photo of [0, 0, 1, 0]) {
      await page.locator('.strip [data-photo]').nth(photo).click();
      // Escape leaves no target chosen; the measured one is chosen when it is there.
      await page.keyboard.press('Escape');
      await page.waitForSelector('#target-name', { state: 'detached' });
      await page.click('canvas.photo');
      await page.waitForSelector('#target-name');
    }
  });
  const found = Object.entries(targets(entries)).sort(([a], [b]) => (a < b ? -1 : 1));
  assert.equal(found.length, 2);
  found.forEach(([, { targets }], i) => {
    assert.equal(targets.length, 1);
    const expected = sightline.measureAtGray(400, 300, disc(...places[i]), ...places[i]);
    const [{ u, v, sigma_u: sigma }] = targets;
    assert.ok(Math.hypot(u - expected.u, v - expected.v) < 0.05 * sigma, `photo ${i + 1}: ${u}, ${v}`);
    assert.ok(Math.hypot(u - places[i][0], v - places[i][1]) < 0.05);
  });
});
