// Lateral colour of a RAW: shift of red and blue over the radius, and what to do about it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { detect, number, photos } from './desk.mjs';

test('the shift of red and blue is shown over the radius with its standard errors', { timeout: 180_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-written-'));
  execFileSync(join(process.env.SIGHTLINE_EXAMPLES, 'written'), [folder]);
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await photos(page, [join(folder, 'photo.dng')]);
    await detect(page, {});
    await page.locator('.strip [data-photo]').first().click();
    await page.click('[data-action=measure-colours]');
    await page.waitForSelector('.lateral-colour-shifts tbody tr');
    // All three colours of this photo are of one picture: every shift is within its noise, and nothing needs to be done.
    const rows = page.locator('.lateral-colour-shifts tbody tr');
    assert.equal(await rows.count(), 2, 'red and blue');
    for (const words of await rows.locator('td').filter({ hasText: '±' }).allTextContents()) {
      const [shift, sigma] = words.split('±').map(number);
      assert.ok(Math.abs(shift) < 4 * sigma + 0.0015, words);
    }
    assert.match(await page.textContent('.lateral-colour-advice'), /negligible|measured in green/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
