// Coded targets through the page: no coordinate is typed, the scale comes from one distance.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, data, detect, downloads, files, go, idle, photos, predicted, rows, similarityRms } from './desk.mjs';
import { printed, printedPoints, unreadable } from './printed.mjs';

const folder = data('panel');

test('8 photos become coordinates', { skip: folder ? false : 'skipped, no data', timeout: 600_000 }, async () => {
  const text = readFileSync(join(folder, 'Positions-3D-14bit_lookup.txt'), 'utf8');
  const aicon = new Map(text.split('\n').filter(Boolean).map((line) => line.trim().split(/\s+/)).map(([id, ...xyz]) => [id, xyz.slice(0, 3).map(Number)]));
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, files(folder, '.tif'));
    // Two cameras, distinguished by their file names.
    assert.equal(await page.locator('.side [data-field=c]').count(), 2);
    await detect(page, { polarity: 'bright on dark', codes: 'Schneider / AICON 14 bit' });

    await go(page, 'control');
    const [from, to] = ['2', '71'];
    const length = Math.hypot(...aicon.get(from).map((v, k) => v - aicon.get(to)[k]));
    for (const [name, value] of Object.entries({ from, to, length, sigma: 0.01 })) await page.fill(`[name=${name}]`, String(value));
    await page.click('.distance-form button');
    await adjust(page);
    await go(page, 'identities');
    await page.click('[data-action=match]');
    await idle(page);
    await adjust(page);

    const exported = await downloads(page, ['points', 'photos', 'cameras', 'observations'], () => page.getByRole('button', { name: 'Export CSV' }).click());
    const points = rows(Object.entries(exported).find(([name]) => name.includes('points'))[1]);
    const coded = points.filter((p) => aicon.has(p.id) && Number(p.id) < 100);
    assert.ok(coded.length >= 70, `${coded.length} coded points`);
    const { scale, rms } = similarityRms(coded.map((p) => ['X [mm]', 'Y [mm]', 'Z [mm]'].map((name) => Number(p[name]))), coded.map((p) => aicon.get(p.id)));
    assert.ok(Math.abs(scale - 1) < 1e-4, `scale ${scale}`);
    rms.forEach((value) => assert.ok(value <= 0.03, `rms ${rms} mm`));
    assert.ok(points.length >= 200, `${points.length} points with the uncoded ones`);

    // In each photo: how many of the coded targets that lie in the frame are named, and how far the names are from their places.
    const table = (part) => rows(Object.entries(exported).find(([name]) => name.includes(part))[1]);
    const observations = table('observations').filter((o) => o.enabled === 'yes' && aicon.has(o.point) && Number(o.point) < 100);
    for (const photo of table('photos')) {
      const place = predicted(photo, table('cameras'), { width: 2000, height: 1333 });
      const named = new Map(observations.filter((o) => o.photo === photo.id).map((o) => [o.point, o]));
      const inFrame = coded.filter((p) => {
        const at = place(p);
        return at.every(Number.isFinite) && Math.min(at[0], 2000 - at[0], at[1], 1333 - at[1]) > 40;
      });
      const share = inFrame.filter((p) => named.has(p.id)).length / inFrame.length;
      console.log(`photo ${photo.id}: ${named.size} coded targets named, ${(100 * share).toFixed(1)} % of ${inFrame.length} in the frame`);
      assert.ok(share >= 0.9, `photo ${photo.id}: ${share} of the coded targets in the frame are named`);
      for (const p of coded.filter(({ id }) => named.has(id))) {
        const [u, v] = place(p);
        const far = Math.hypot(Number(named.get(p.id)['u [px]']) - u, Number(named.get(p.id)['v [px]']) - v);
        assert.ok(far < 1, `photo ${photo.id}: the target named ${p.id} is ${far} px from its place`);
      }
    }

    // Lengths of the other program's points, far apart, that are not used: errors within what eight photos promise, and told with the limit.
    await go(page, 'control');
    const pairs = [['1', '70'], ['10', '61'], ['5', '66'], ['2', '69'], ['9', '62']].filter((pair) => pair.every((id) => coded.some((p) => p.id === id)));
    assert.ok(pairs.length >= 3, JSON.stringify(pairs));
    for (const [from, to] of pairs) {
      const known = Math.hypot(...aicon.get(from).map((v, k) => v - aicon.get(to)[k]));
      for (const [name, value] of Object.entries({ from, to, length: known, sigma: 0.01 })) await page.fill(`[name=${name}]`, String(value));
      await page.click('.distance-form button');
      await page.locator('[name=distance-check]').last().check();
    }
    await adjust(page);
    const shown = await page.$$eval('[data-result]', (all) => all.map((element) => element.textContent));
    const decimals = (await page.textContent('.results .c1 tbody tr.data td:nth-child(3)')).split('.')[1].length;
    const tables = await downloads(page, ['points'], () => page.getByRole('button', { name: 'Export CSV' }).click());
    const printable = Object.entries(tables).find(([name]) => name.includes('points'))[1];
    await go(page, 'report');
    await page.waitForSelector('.paper[data-ready=true]', { timeout: 60_000 });
    await page.fill('[name=limit-constant]', '0.1');
    await page.press('[name=limit-constant]', 'Tab');
    await page.waitForFunction(() => document.querySelector('.paper').shadowRoot.querySelector('[data-section=lengths]')?.textContent.includes('All of them are within the limit'));
    if (!unreadable) await printed(page, { figures: [...shown, '0.1 mm'], points: printedPoints(printable, decimals), without: ['Features'] });
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
