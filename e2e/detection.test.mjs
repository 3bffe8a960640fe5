// The same photo gives the same targets on the page and in Node, bit for bit, whatever the number of workers.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { test } from 'node:test';

import * as sightline from '../pkg/sightline.js';
import { compare } from '../tests/face/compare.mjs';
import { open } from './browser.mjs';
import { data, detect, downloads, files, idle, photos, sample, unzipped } from './desk.mjs';

sightline.initSync({ module: readFileSync(fileURLToPath(new URL('../pkg/sightline_bg.wasm', import.meta.url))) });

/** Opens the page with so many cores, lets `work` fill it, and hands back the project file that it saves, as entries. */
async function saved(cores, button, work) {
  const { page, errors, close } = await open({ cores });
  let workers = 0;
  page.on('worker', () => (workers = Math.max(workers, page.workers().length)));
  try {
    await work(page);
    const given = await downloads(page, 1, () => page.getByRole('button', { name: button, exact: true }).click());
    await idle(page);
    assert.deepEqual(errors, []);
    assert.equal(workers, cores, 'workers at the same time');
    return unzipped(Object.values(given)[0]);
  } finally {
    await close();
  }
}

/** What a project file holds of the targets: every number as the page has it. */
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
    const entries = await saved(cores, 'Save with photos', sample);
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
  { name: 'photographs of coded targets', ending: '.tif', folder: 'panel', choices: { polarity: 'bright on dark', codes: '14 bit' }, options: { polarity: 'bright', codes: 'ring-14' }, least: 160 },
]) {
  const place = data(folder);
  test(name, { skip: place ? false : 'skipped, no data', timeout: 600_000 }, async () => {
    const paths = files(place, ending).slice(0, 4);
    const bytes = paths.map((path) => readFileSync(path));
    for (const cores of [1, 4]) {
      const entries = await saved(cores, 'Save', async (page) => {
        await photos(page, paths);
        await detect(page, choices);
      });
      const count = sameInNode(targets(entries), bytes, options);
      assert.ok(count >= least, `${count} targets`);
    }
  });
}
