// Measuring by hand without codes: point after point through the photos, with what is predicted, by mouse, keys and finger.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { before, test } from 'node:test';

import { open } from './browser.mjs';
import { clickPhoto, downloads, figure, go, idle, photos, places, sample, save, scratch, unzipped } from './desk.mjs';

const longer = { timeout: 900_000 };
let paths, project;

before(async () => {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const saved = await downloads(page, 1, () => save(page));
    await idle(page);
    const entries = unzipped(Object.values(saved)[0]);
    const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
    project = JSON.parse(entries['project.json']);
    paths = names.map((name) => scratch(name.slice(7), entries[name]));
  } finally {
    await close();
  }
});

/** Where photo k (from 1) of the sample shows a point. */
const place = (point, k) => project.observations.find((o) => o.photo === `sample-${k}` && o.point === point);

/** Points that every photo shows, far apart from each other first. */
function everywhere() {
  const all = [...new Set(project.observations.map((o) => o.point))].filter((point) => paths.every((_, k) => place(point, k + 1)));
  const chosen = [all[0]];
  const apart = (a, b) => Math.hypot(place(a, 1).u - place(b, 1).u, place(a, 1).v - place(b, 1).v);
  while (chosen.length < Math.min(all.length, 24)) {
    const left = all.filter((point) => !chosen.includes(point));
    const reach = (point) => Math.min(...chosen.map((other) => apart(point, other)));
    chosen.push(left.reduce((best, point) => (reach(point) > reach(best) ? point : best)));
  }
  return chosen;
}

const shown = (page) => page.getAttribute('.strip .chosen [data-photo]', 'data-photo');
const untilShown = (page, photo) => page.waitForFunction((photo) => document.querySelector('.strip .chosen [data-photo]')?.dataset.photo === photo, String(photo), { timeout: 120_000 });

/** Photos with their targets found, codes unread, at the naming step: what a person has clicked so far. */
async function withoutCodes(page) {
  await photos(page, paths);
  await go(page, 'targets');
  await page.$eval('details.options', (options) => (options.open = true));
  await page.selectOption('select[name=codes]', { label: 'none' });
  await page.click('[data-action=detect]');
  await idle(page);
  await go(page, 'identities');
  return 5;
}

test('eight photos without codes are named by hand and adjusted in at most 60 clicks', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    let clicks = await withoutCodes(page);
    await page.click('[data-action=series]');
    clicks += 1;
    const points = everywhere().slice(0, 6);
    for (const point of points) {
      const from = clicks;
      for (let k = 1; k <= paths.length; k++) {
        await untilShown(page, k);
        // Where the page knows the place, its question is answered.
        const { u, v } = place(point, k);
        await clickPhoto(page, [u, v]);
        clicks += 1;
      }
      assert.ok(clicks - from <= 10, 'a point in eight photos');
    }
    await untilShown(page, 1);
    assert.equal(await page.locator('.columns tr.data').count(), points.length);
    await page.click('[data-action=match]');
    await idle(page);
    await go(page, 'adjust');
    await page.click('.action .button');
    await idle(page);
    clicks += 3;
    await go(page, 'results');
    assert.ok(clicks <= 60, `${clicks} clicks`);
    assert.ok((await figure(page, 'sigma0')) < 3);
    await page.waitForSelector('.results .c1 tr.data');
    const rays = await page.$$eval('.results .c1 tbody tr.data td:nth-child(2)', (all) => all.map((cell) => Number(cell.textContent)));
    assert.ok(rays.filter((n) => n >= 6).length >= 20, `${rays}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** A photo's place on the screen, as it lies there when it is fitted. */
async function onScreen(page, [u, v], { width = 1632, height = 1224 } = {}) {
  const box = await page.locator('canvas.photo').boundingBox();
  const scale = Math.min(box.width / width, box.height / height);
  return [(box.width - width * scale) / 2 + u * scale, (box.height - height * scale) / 2 + v * scale, box];
}

test('a point is measured by keys alone, and by a finger alone', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768, hasTouch: true });
  try {
    await photos(page, paths.slice(0, 3));
    await go(page, 'identities');
    const [byKeys, byFinger] = everywhere();
    // Keys: M begins, arrows take the cross to the place, Enter measures; what was measured goes on to the next photo.
    await page.locator('canvas.photo').focus();
    await page.keyboard.press('m');
    for (let k = 1; k <= 3; k++) {
      await untilShown(page, k);
      await page.keyboard.press('0');
      const { u, v } = place(byKeys, k);
      const [x, y, box] = await onScreen(page, [u, v]);
      // Each photo begins where the cross was left.
      const at = k === 1 ? [box.width / 2, box.height / 2] : page.cross;
      const steps = [x - at[0], y - at[1]];
      for (const [axis, keys] of [['ArrowRight', 'ArrowLeft'], ['ArrowDown', 'ArrowUp']].entries()) {
        const key = steps[axis] > 0 ? keys[0] : keys[1];
        const [coarse, fine] = [Math.floor(Math.abs(steps[axis]) / 12), Math.round(Math.abs(steps[axis]) % 12)];
        for (let i = 0; i < coarse; i++) await page.keyboard.press(key);
        for (let i = 0; i < fine; i++) await page.keyboard.press(`Alt+${key}`);
        at[axis] += Math.sign(steps[axis]) * (coarse * 12 + fine);
      }
      page.cross = at;
      await page.keyboard.press('Enter');
      if (k < 3) await untilShown(page, k + 1);
    }
    await page.waitForFunction(() => document.querySelectorAll('.columns tr.data').length === 1);
    await untilShown(page, 1);
    // A finger: the same, and the next point begins where the last one did.
    for (let k = 1; k <= 3; k++) {
      await untilShown(page, k);
      const { u, v } = place(byFinger, k);
      await clickPhoto(page, [u, v], { touch: true });
      if (k < 3) await untilShown(page, k + 1);
    }
    await page.waitForFunction(() => document.querySelectorAll('.columns tr.data').length === 2);
    for (const [row, point] of [[0, byKeys], [1, byFinger]]) {
      await page.locator('.columns tr.data').nth(row).click();
      await page.waitForFunction((row) => document.querySelectorAll('.columns tr.data')[row].classList.contains('chosen'), row);
      const measured = await places(page);
      for (let k = 1; k <= 3; k++) {
        const { u, v } = place(point, k);
        assert.ok(Math.hypot(measured[k].u - u, measured[k].v - v) < 0.05, `${point} in photo ${k}`);
        assert.ok(measured[k].sigma < 0.1);
      }
    }
    assert.equal(await page.locator('.insets li button').count(), 3);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** A photo in which the surroundings of a place are seen once more, at the top left. */
const twice = (page, path, { u, v }) =>
  page.evaluate(
    async ([data, u, v]) => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))]));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext('2d');
      context.drawImage(bitmap, 0, 0);
      context.drawImage(bitmap, u - 60, v - 60, 120, 120, 10, 10, 120, 120);
      const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
      let text = '';
      for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
      return btoa(text);
    },
    [readFileSync(path).toString('base64'), u, v],
  );

test('a code that is seen twice is a question, answered with one key', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    const coded = project.observations.find((o) => o.photo === 'sample-1' && o.point === '11');
    const path = scratch('sample-1.png', Buffer.from(await twice(page, paths[0], coded), 'base64'));
    await photos(page, [path]);
    await go(page, 'targets');
    await page.click('[data-action=detect]');
    await idle(page);
    await go(page, 'identities');
    assert.match(await page.textContent('.questions h2'), /Questions 2/);
    assert.equal(await page.locator('.columns tr[data-key="11"]').count(), 0);
    await page.keyboard.press('d');
    await page.waitForSelector('form.question');
    assert.match(await page.textContent('form.question p'), /Is this point 11\? code read twice in photo 1\. Question 1 of 2/);
    // No, and the other one is asked; yes, and nothing is left to ask.
    await page.keyboard.press('n');
    await page.waitForFunction(() => /Question 1 of 1/.test(document.querySelector('form.question p')?.textContent ?? ''));
    await page.keyboard.press('y');
    await page.waitForSelector('.questions', { state: 'detached' });
    assert.equal(await page.locator('.columns tr[data-key="11"]').count(), 1);
    // Each answer is a step of its own.
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    assert.match(await page.textContent('.questions h2'), /Questions 2/);
    // Keys rest while something is typed, and are listed under "?".
    await page.fill('.project-name', 'd?');
    assert.equal(await page.locator('dialog[open]').count(), 0);
    await page.locator('canvas.photo').focus();
    await page.keyboard.press('?');
    await page.waitForSelector('dialog[open]');
    assert.ok((await page.locator('dialog[open] dt').count()) >= 30);
    await page.keyboard.press('Escape');
    await page.waitForSelector('dialog[open]', { state: 'detached' });
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
