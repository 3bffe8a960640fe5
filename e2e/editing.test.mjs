// Editing: every typed value can be changed later, a refused value is removed from its field, and a message disappears with its cause.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, downloads, go, notice, sample, save, unzipped } from './desk.mjs';

const longer = { timeout: 600_000 };

/** Types into a field and leaves it. */
async function type(page, selector, value) {
  await page.locator(selector).first().fill(value);
  await page.locator(selector).first().press('Tab');
}

/** The project as a saved file has it. */
async function project(page) {
  const saved = await downloads(page, 1, () => save(page, false));
  return JSON.parse(unzipped(Object.values(saved)[0])['project.json']);
}

test('control, distances, projection centres and observed parameters are edited in place', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'control');
    const before = await project(page);
    const first = before.points.find((p) => p.role === 'control') ?? before.points.find((p) => p.role === 'check');
    await type(page, `[aria-label="${first.id} σ X"]`, '0,25');
    await type(page, `[aria-label="${first.id} Y"]`, '17.5');
    await type(page, '[name=distance-length]', '1234.5');
    await type(page, '[name=distance-sigma]', '0.02');
    // A centre that is observed needs a sigma somewhere.
    for (const [k, value] of ['10', '20', '30'].entries()) await page.fill(`[name=centre-${k}]`, value);
    await page.getByRole('button', { name: 'Observe', exact: true }).click();
    assert.match(await notice(page), /needs a standard error/);
    await page.fill('[name=centre-3]', '0.5');
    await page.getByRole('button', { name: 'Observe', exact: true }).click();
    assert.equal(await page.locator('.notice').count(), 0);
    const centred = (await page.textContent('.centres tbody .id')).trim();
    await type(page, `[aria-label="${centred} σ Z"]`, '0.75');
    let now = await project(page);
    const point = now.points.find((p) => p.id === first.id);
    assert.equal(point.sigma[0], 0.25);
    assert.equal(point.xyz[1], 17.5);
    assert.equal(now.distances[0].length, 1234.5);
    assert.equal(now.distances[0].sigma, 0.02);
    const photo = now.photos.find((p) => p.id === centred);
    assert.deepEqual([photo.position, photo.sigma_position], [[10, 20, 30], [0.5, null, 0.75]]);
    await page.getByRole('button', { name: 'Stop observing this projection centre' }).click();
    await type(page, `[aria-label="${first.id} σ X"]`, '');
    now = await project(page);
    assert.equal(now.photos.find((p) => p.id === centred).sigma_position ?? null, null);
    assert.equal(now.points.find((p) => p.id === first.id).sigma?.[0] ?? null, null);

    // A parameter's sigma: typing one observes it, and holding it meanwhile does not lose it.
    await go(page, 'adjust');
    await page.locator('.words summary').first().click();
    await type(page, '[data-sigma=k1]', '0.0001');
    const tick = page.locator('[data-parameter=k1]').first();
    await tick.uncheck();
    assert.equal(await page.locator('[data-sigma=k1]').first().inputValue(), '');
    await tick.check();
    assert.equal(await page.locator('[data-sigma=k1]').first().inputValue(), '0.0001');
    assert.equal((await project(page)).cameras[0].sigma.k1, 0.0001);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a refused value leaves its field, and its notice goes with its cause', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'photos');
    for (const [field, typed, why] of [['pitch', 'wide', /wide/], ['c', '-3', /-3/], ['name', '', /empty or in use/]]) {
      const input = page.locator(`[data-field=${field}]`).first();
      const before = await input.inputValue();
      await input.fill(typed);
      await input.press('Tab');
      assert.match(await notice(page), why);
      assert.equal(await input.inputValue(), before);
      await go(page, 'control');
      assert.equal(await page.locator('.notice').count(), 0, 'the notice goes with the step');
      await go(page, 'photos');
    }
    await go(page, 'adjust');
    await page.locator('.words summary').first().click();
    for (const field of ['[data-sigma=k1]', '[name=unmodelled]', '[name=target-diameter]']) {
      const input = page.locator(field).first();
      const before = await input.inputValue();
      await input.fill('x1');
      await input.press('Tab');
      assert.match(await notice(page), /x1/);
      assert.equal(await input.inputValue(), before, field);
    }
    // Escape takes back what is being typed.
    await page.locator('[name=unmodelled]').fill('7');
    await page.locator('[name=unmodelled]').press('Escape');
    assert.equal(await page.locator('[name=unmodelled]').inputValue(), '0');
    // A change of the document ends a notice about it.
    await type(page, '[name=unmodelled]', '0.1');
    assert.equal(await page.locator('.notice').count(), 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('the next step is the primary action, one at a time', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    for (const [step, next] of [['photos', 'targets'], ['targets', 'identities'], ['identities', 'control'], ['control', 'adjust'], ['adjust', 'results']]) {
      await go(page, step);
      assert.equal(await page.locator('.bar .primary:visible').count(), 1, step);
      await page.click('.bar .primary');
      assert.equal(await page.evaluate(() => location.hash), `#${next}`);
    }
    // Whatever the network lacks has a button that goes where it can be mended.
    await go(page, 'adjust');
    const advice = await page.$$eval('.advice li.warning', (all) => all.map((item) => [item.querySelector('b').textContent, item.querySelectorAll('button').length]));
    assert.ok(advice.length > 0);
    for (const [title, buttons] of advice) assert.equal(buttons, 1, title);
    // Out of date: the next thing is to adjust again.
    await go(page, 'adjust');
    await page.fill('[name=unmodelled]', '0.05');
    await page.press('[name=unmodelled]', 'Tab');
    await adjust(page);
    await page.waitForSelector('[data-result=sigma0]');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
