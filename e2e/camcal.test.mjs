// A camera calibration through the page: photos, targets, marks of an earlier job, control points, adjustment.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { join } from 'node:path';

import { open } from './browser.mjs';
import { adjust, data, detect, downloads, drop, figure, files, go, idle, notice, number, parameter, photos, rows } from './desk.mjs';
import { printed, printedPoints, unreadable } from './printed.mjs';

const folder = data('camcal');

test('21 photos become a calibration', { skip: folder ? false : 'skipped, no data', timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, files(join(folder, 'photos'), '.jpg'));
    assert.equal(await page.locator('.tile').count(), 21);
    // EXIF names the camera and the focal length but not the sensor.
    assert.match(await page.textContent('.side'), /C4040Z/);
    await page.fill('[data-field=pitch]', String((5.43764 / 1704) * 1000));
    await page.press('[data-field=pitch]', 'Tab');
    assert.equal(await page.inputValue('[data-field=c]'), '7.3');

    await detect(page, { polarity: 'dark on bright', channel: 'green', codes: 'none' });
    await go(page, 'identities');
    await drop(page, [join(folder, 'markpts.txt')]);
    await page.waitForSelector('.marks .primary');
    const [good, all] = (await page.textContent('.marks .hint')).replaceAll('\u2009', '').match(/\d+/g).map(Number);
    assert.equal(all, 2074);
    assert.ok(good >= 2050, `${good} of ${all} marks snap`);
    await page.click('.marks .primary');

    await go(page, 'control');
    await drop(page, [join(folder, 'camcal-fixed.txt')]);
    await page.waitForSelector('.preview tr.new');
    assert.equal(await page.locator('.preview tr.new').count(), 4);
    // Nothing in the file says that the sheet is 1 m and not 1 mm wide.
    assert.ok(await page.isDisabled('.columns .primary'));
    await page.selectOption('[name=pasted-unit]', 'm');
    await page.click('.columns .primary');
    assert.equal(await page.inputValue('[name=unit]'), 'm');
    await adjust(page);

    const c = await parameter(page, 'C4040Z', 'c');
    assert.equal(c.unit, 'mm');
    assert.ok(Math.abs(c.value - 7.457) <= 0.006, `c ${c.value}`);
    assert.ok((await figure(page, 'rms-px')) <= 0.25);
    assert.equal(await figure(page, 'redundancy'), 2 * good - 422 + 0);

    const exported = await downloads(page, ['points'], () => page.getByRole('button', { name: 'Export CSV' }).click());
    const points = Object.entries(exported).find(([name]) => name.includes('points'));
    assert.equal(rows(points[1]).length, 100);

    // A changed input shows no number until it is adjusted again; undoing it brings the numbers back.
    await go(page, 'identities');
    await page.click('tr[data-key="5"]');
    await page.click('.panel.point input[type=checkbox]');
    await go(page, 'results');
    assert.equal(await page.locator('[data-result]').count(), 0);
    assert.match(await page.textContent('.out-of-date'), /point 5 in photo/);
    await page.keyboard.press('Control+z');
    assert.ok((await figure(page, 'rms-px')) <= 0.25);

    // The photos are good to a sixth of a pixel, the centres to a few hundredths (what compression leaves in a JPEG is in their
    // standard errors): told so, and weighted so in one click.
    assert.ok((await figure(page, 'sigma0')) > 3);
    await go(page, 'adjust');
    await page.click('.advice li:has-text("too small") .link');
    await idle(page);
    assert.ok(Math.abs(number(await page.inputValue('[name=unmodelled]')) - 0.17) < 0.05);
    // The first value came from the old weights; taken once more, the global test agrees.
    const again = page.locator('.advice li:has-text("needs an update") .link');
    for (let i = 0; i < 3 && (await again.count()) > 0; i++) {
      await again.click();
      await idle(page);
    }
    await go(page, 'results');
    assert.ok(Math.abs((await figure(page, 'sigma0')) - 1) < 0.02);
    const uncorrected = (await parameter(page, 'C4040Z', 'c')).value;
    assert.ok(Math.abs(uncorrected - 7.457) <= 0.006);

    // The dots' diameter frees their images of the eccentricity; what is none is refused.
    await go(page, 'adjust');
    const diameter = async (typed) => {
      await page.fill('[name=target-diameter]', typed);
      await page.press('[name=target-diameter]', 'Tab');
      return page.inputValue('[name=target-diameter]');
    };
    assert.equal(await diameter('-5'), '');
    assert.match(await notice(page), /not a diameter/);
    assert.equal(await diameter('0.02'), '0.02');
    await adjust(page);
    const freed = (await parameter(page, 'C4040Z', 'c')).value;
    assert.ok(freed !== uncorrected && Math.abs(freed - uncorrected) < 0.001, `c ${freed}, ${uncorrected} before`);
    await idle(page);

    if (!unreadable) {
      const shown = await page.$$eval('[data-result]', (all) => all.map((element) => element.textContent));
      const decimals = (await page.textContent('.results .c1 tbody tr.data td:nth-child(3)')).split('.')[1].length;
      const tables = await downloads(page, ['points'], () => page.getByRole('button', { name: 'Export CSV' }).click());
      const table = Object.entries(tables).find(([name]) => name.includes('points'))[1];
      await go(page, 'report');
      await page.waitForSelector('.paper[data-ready=true]', { timeout: 60_000 });
      await printed(page, { figures: shown, points: printedPoints(table, decimals), without: ['Length measurement errors', 'Features'] });
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
