// Measuring and naming by hand: what a click, a name and a key do, and that nothing else moves.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, choosePoint, clickPhoto, downloads, drop, figure, go, idle, notice, photos, places, sample, save, scratch, showPhoto, unzipped } from './desk.mjs';

const longer = { timeout: 600_000 };

/** Whether the result still belongs to the project: nothing of it has changed. */
const unchanged = async (page) => (await page.locator('[data-step=results] .stale').count()) === 0;

test('a target that has a name shows it at every step, and renaming says what it does', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'identities');
    const before = await choosePoint(page, '11');
    const photos = Object.keys(before).length;
    await go(page, 'targets');
    await showPhoto(page, 'sample-1');
    await clickPhoto(page, [before['sample-1'].u, before['sample-1'].v]);
    assert.equal(await page.textContent('[data-result=point]'), '11');
    await go(page, 'identities');
    assert.equal(await page.locator('.question').count(), 0);
    assert.equal(await page.inputValue('[name=point-name]'), '11');
    assert.match(await page.textContent('.panel.point .hint'), new RegExp(`all its ${photos} photos`));
    assert.ok(await unchanged(page));

    await page.selectOption('[name=rename-where]', 'here');
    assert.match(await page.textContent('.panel.point .hint'), /Renames only the observation in photo sample-1/);
    await page.fill('[name=point-name]', '9500');
    await page.press('[name=point-name]', 'Enter');
    assert.match(await notice(page), /in photo sample-1 was point 11 and is now 9500/);
    assert.deepEqual(Object.keys(await places(page)), ['sample-1']);
    await page.locator('canvas.photo').focus();
    await page.keyboard.press('Control+z');
    assert.equal(await page.locator('.notice').count(), 0);
    assert.ok(await unchanged(page));
    assert.deepEqual(await choosePoint(page, '11'), before);

    await page.fill('[name=point-name]', '9500');
    await page.press('[name=point-name]', 'Enter');
    assert.match(await notice(page), new RegExp(`Point 11 renamed to 9500 in ${photos} photos`));
    assert.equal(Object.keys(await places(page)).length, photos);
    // A name that cannot be taken says why and leaves the field.
    await page.fill('[name=point-name]', '12');
    await page.press('[name=point-name]', 'Enter');
    assert.match(await notice(page), /shows both 9500 and 12/);
    assert.equal(await page.inputValue('[name=point-name]'), '9500');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('keys act where the focus is', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'identities');
    const before = await choosePoint(page, '11');
    // In the table arrows choose rows, and nothing that was measured moves or goes.
    await page.keyboard.press('ArrowDown');
    const next = await page.inputValue('[name=point-name]');
    assert.notEqual(next, '11');
    for (const key of ['ArrowLeft', 'ArrowRight', 'Backspace', 'Delete', 'ArrowUp']) await page.keyboard.press(key);
    assert.equal(await page.inputValue('[name=point-name]'), '11');
    assert.deepEqual(await places(page), before);
    assert.ok(await unchanged(page));
    // On a button neither, nor is what was measured left out.
    await page.locator('.section-head .link').first().focus();
    for (const key of ['ArrowRight', 'Backspace', 'x']) await page.keyboard.press(key);
    const taken = () => page.isChecked('.panel.point tr.chosen input[type=checkbox]');
    assert.ok((await unchanged(page)) && (await taken()));
    await page.locator('.columns table[role=grid]').focus();
    await page.keyboard.press('x');
    assert.ok(!(await unchanged(page)) && !(await taken()));
    await page.keyboard.press('Control+z');
    assert.ok((await unchanged(page)) && (await taken()));
    // In the photo they move what is chosen there, and take it away.
    await showPhoto(page, 'sample-1');
    await clickPhoto(page, [before['sample-1'].u, before['sample-1'].v]);
    await page.keyboard.press('x');
    assert.ok(!(await taken()));
    await page.keyboard.press('x');
    assert.ok(await taken());
    await page.keyboard.press('ArrowRight');
    const moved = (await places(page))['sample-1'];
    assert.ok(Math.abs(moved.u - before['sample-1'].u - 1) < 1e-3 && moved.v === before['sample-1'].v);
    assert.equal(moved.sigma, 0.5);
    await page.keyboard.press('Backspace');
    assert.ok(!('sample-1' in (await places(page))));
    for (let edit = 0; edit < 4; edit++) await page.keyboard.press('Control+z');
    assert.ok(await unchanged(page));
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** The photos of the sample, as files on the disk. */
async function samplePhotos(page) {
  await sample(page);
  const saved = await downloads(page, 1, () => save(page));
  await idle(page);
  const entries = unzipped(Object.values(saved)[0]);
  const names = Object.keys(entries).filter((name) => name.startsWith('photos/')).sort();
  return { project: JSON.parse(entries['project.json']), paths: names.map((name) => scratch(name.slice(7), entries[name])) };
}

test('a click before detection measures, typing names, Alt-click and the button place freely', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768, hasTouch: true });
  try {
    const { project, paths } = await samplePhotos(page);
    const place = (point) => project.observations.find((o) => o.photo === 'sample-1' && o.point === point);
    await afresh(page);
    await photos(page, paths.slice(0, 2));
    await go(page, 'targets');
    await page.$eval('details.options', (options) => (options.open = true));
    await page.selectOption('select[name=codes]', { label: 'Schneider / AICON 14 bit' });
    await showPhoto(page, '1');
    assert.match(await page.textContent('.legend'), /Click measures, Alt-click places freely/);
    const coded = place('11');
    await clickPhoto(page, [coded.u, coded.v]);
    await page.waitForFunction(() => document.querySelector('[data-result=point]')?.textContent === '11');
    assert.match(await page.textContent('.inspector'), /±/);

    // What has no code is asked for its name, and what is typed goes there.
    await go(page, 'identities');
    const plain = project.observations.find((o) => o.photo === 'sample-1' && !/^\d+$/.test(o.point));
    await clickPhoto(page, [plain.u, plain.v]);
    await page.waitForSelector('#target-name');
    await page.keyboard.type('top left');
    assert.equal(await page.inputValue('#target-name'), 'top left');
    await page.keyboard.press('Enter');
    const named = await places(page);
    assert.ok(Math.abs(named['1'].u - plain.u) < 0.01 && named['1'].sigma < 0.1);
    assert.equal(await page.inputValue('[name=point-name]'), 'top left');

    // Where there is nothing to measure the page says how to place a point.
    await clickPhoto(page, [20, 20]);
    await page.waitForSelector('.notice');
    assert.match(await notice(page), /no target to measure here.*Place freely/);
    assert.equal(await page.locator('.question').count(), 0);
    await clickPhoto(page, [20, 20], { modifiers: ['Alt'] });
    await page.waitForSelector('#target-name');
    await page.keyboard.type('corner');
    await page.keyboard.press('Enter');
    assert.match(await notice(page), /Placed by hand/);
    assert.equal((await places(page))['1'].sigma, 0.5);
    // With a finger: the button does what Alt does.
    await page.getByRole('button', { name: 'Place freely' }).tap();
    await clickPhoto(page, [60, 30], { touch: true });
    await page.waitForSelector('#target-name');
    await page.keyboard.type('edge');
    await page.keyboard.press('Enter');
    assert.equal(await page.inputValue('[name=point-name]'), 'edge');
    // Its last observation taken away, a point is gone.
    await page.getByRole('button', { name: 'Remove the observation' }).click();
    assert.equal(await page.locator('.columns tr[data-key="edge"]').count(), 0);
    assert.doesNotMatch(await page.textContent('.foot'), /in 0 photos/);
    assert.match(await notice(page), /edge had no other observation/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('residuals are drawn over the photo, as many times their length as asked', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  // Pixels of the drawing, however pale: more where vectors are longer.
  const drawn = () =>
    page.evaluate(() => {
      const canvas = document.querySelector('canvas.photo');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let k = 3; k < data.length; k += 4) count += data[k] > 0 ? 1 : 0;
      return count;
    });
  try {
    await sample(page);
    await go(page, 'targets');
    await showPhoto(page, 'sample-1');
    await page.click('[data-action=layers]');
    const without = await drawn();
    await page.check('[name=layer-residuals]');
    await page.press('[name=residual-factor]', 'Home');
    const short = await drawn();
    await page.press('[name=residual-factor]', 'End');
    assert.match(await page.textContent('.layers'), /1.?000 times/);
    const long = await drawn();
    assert.ok(short > without && long > 1.5 * (short - without) + without, `${without} ${short} ${long}`);
    await page.uncheck('[name=layer-residuals]');
    assert.equal(await drawn(), without);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a magnified photo shows its pixels and their values, and turning that off leaves the photo alone', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  const drawn = () =>
    page.evaluate(() => {
      const canvas = document.querySelector('canvas.photo');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let k = 3; k < data.length; k += 4) count += data[k] > 0 ? 1 : 0;
      return count;
    });
  try {
    await sample(page);
    await go(page, 'targets');
    await showPhoto(page, 'sample-1');
    await page.click('[data-action=layers]');
    const percent = async () => Number(/\d+/.exec((await page.textContent('.zoom')).replaceAll('\u2009', ''))[0]);
    const until = async (least) => {
      await page.locator('canvas.photo').focus();
      while ((await percent()) < least) await page.keyboard.press('+');
      await page.waitForTimeout(500);
    };
    // Whole there is no grid; from twelve screen pixels on there is, from forty on there are values.
    const whole = await drawn();
    await page.uncheck('[name=layer-pixels]');
    assert.equal(await drawn(), whole);
    await until(1500);
    const plain = await drawn();
    await page.check('[name=layer-pixels]');
    const grid = await drawn();
    assert.ok(grid > plain + 20_000, `${plain} ${grid}`);
    await until(4500);
    await page.uncheck('[name=layer-pixels]');
    const without = await drawn();
    await page.check('[name=layer-pixels]');
    await page.waitForTimeout(1500);
    const values = await drawn();
    // A third of the pixels' lines are left at three times the zoom; what is more is digits.
    assert.ok(values > without + 40_000, `${without} ${values}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
