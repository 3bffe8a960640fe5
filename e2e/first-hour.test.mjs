// The first hour: the start page, projects of their own, ways back, the photo's share of the screen, modes and menus that end.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, clickPhoto, drop, go, idle, named, notice, photos, sample, scratch, waitForList, written } from './desk.mjs';

const longer = { timeout: 600_000 };
const name = (page) => page.inputValue('.project-name');
const hash = (page) => page.evaluate(() => location.hash);

/** Photos drawn in the browser, as files; each has another content. */
async function drawn(page, names) {
  const bytes = await page.evaluate(async (count) => {
    const all = [];
    for (let k = 0; k < count; k++) {
      const canvas = new OffscreenCanvas(600, 400);
      const context = canvas.getContext('2d');
      context.fillStyle = '#fff';
      context.fillRect(0, 0, 600, 400);
      context.fillStyle = '#222';
      for (let x = 0; x < 6; x++) context.fillRect(40 + 90 * x, 40 + 13 * k + 7 * x, 30, 30);
      all.push([...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer())]);
    }
    return all;
  }, names.length);
  return names.map((file, k) => scratch(file, Buffer.from(bytes[k])));
}

/** Opens projects that have nothing but a name. */
async function projects(page, names) {
  for (const one of names) {
    await drop(page, [named(one)]);
    await page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted, one);
    await written(page);
  }
}

test('the start page fits with five projects, and leaves no screen empty', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await projects(page, ['One', 'Two', 'Three', 'Four', 'Five']);
    await page.click('.mark');
    await waitForList(page, ['One', 'Two', 'Three', 'Four', 'Five']);
    for (const language of ['en', 'ko']) {
      assert.equal(await page.getAttribute('html', 'lang'), language);
      const hidden = await page.evaluate(() => {
        const main = document.querySelector('main.start');
        const cut = [...document.querySelectorAll('main.start :is(button, h1, p, svg, tr)')].filter((e) => {
          const box = e.getBoundingClientRect();
          return box.height > 0 && (box.bottom > main.getBoundingClientRect().bottom + 1 || box.top < main.getBoundingClientRect().top - 1);
        });
        return [main.scrollHeight - main.clientHeight, ...cut.map((e) => e.textContent.slice(0, 30))];
      });
      assert.deepEqual(hidden, [0], language);
      const rows = await page.$eval('.shelf-rows', (rows) => rows.scrollHeight - rows.clientHeight);
      assert.ok(rows <= 1, `${language}: five projects stand without scrolling, ${rows}`);
      await page.locator('.tools [aria-label*="Language"], .tools [aria-label*="언어"]').click();
    }
    // On a large screen both halves reach down.
    await page.setViewportSize({ width: 1920, height: 1080 });
    const filled = await page.$$eval('.drop-zone, .start-lists', (all) => all.map((e) => e.getBoundingClientRect().height / innerHeight));
    assert.ok(filled.every((share) => share > 0.8), `${filled}`);
    const purpose = await page.locator('svg.purpose').boundingBox();
    assert.ok(purpose.width > 500, `${purpose.width}`);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('photos dropped on the start page begin a project, which has a name, and no other is touched', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await projects(page, ['Other']);
    await page.click('.mark');
    await photos(page, await drawn(page, ['bearing-7_01.png', 'bearing-7_02.png']));
    assert.equal(await name(page), 'bearing-7');
    assert.equal(await page.locator('.tile').count(), 2);
    await written(page);
    // Once more: a name in use gets a number. Within a project photos join it.
    await page.click('.mark');
    await photos(page, await drawn(page, ['bearing-7_01.png', 'bearing-7_02.png']));
    assert.equal(await name(page), 'bearing-7 (2)');
    await written(page);
    const more = await drawn(page, ['a.png', 'b.png', 'bearing-7_03.png']);
    await drop(page, more.slice(2));
    await page.waitForFunction(() => document.querySelectorAll('.tile').length === 3);
    assert.equal(await name(page), 'bearing-7 (2)');
    await written(page);
    // A new project has a name too, and says what to do next.
    await page.click('.mark');
    await page.click('[data-action=new-project]');
    await page.waitForSelector('[data-empty=photos]');
    assert.match(await name(page), /^Project \d{4}-\d\d-\d\d$/);
    await written(page);
    await page.click('.mark');
    await waitForList(page, ['Other', 'bearing-7', 'bearing-7 (2)', await name(page)]);
    const counts = await page.$$eval('[data-project]', (rows) => rows.map((row) => [row.querySelector('.name').textContent, row.cells[2].textContent]));
    assert.deepEqual(Object.fromEntries(counts.filter(([one]) => !/^Project/.test(one))), { Other: '0', 'bearing-7': '2', 'bearing-7 (2)': '3' });
    // Where file names do not name the object, the project is named by the day.
    await photos(page, await drawn(page, ['DSC_0001.png', 'DSC_0002.png']));
    assert.match(await name(page), /^Project \d{4}-\d\d-\d\d \(2\)$/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a page that is loaded again returns to its project and step, and a project opens at the step it was left at', longer, async () => {
  const { page, context, errors, url, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await written(page);
    for (const step of ['identities', 'tables', 'results']) {
      await page.evaluate((step) => (location.hash = step), step);
      await page.waitForFunction((step) => location.hash === `#${step}` && document.querySelector('main:not(.absent)'), step);
      await page.waitForTimeout(300);
      await page.reload();
      await page.waitForFunction(() => document.querySelector('.project-name')?.value);
      await page.waitForSelector('main:not(.absent)');
      assert.equal(await hash(page), `#${step}`);
      assert.equal(await name(page), 'Sample');
    }
    await page.waitForSelector('[data-result=sigma0]');
    // "Open" leads to the step one was at, though nothing was changed there.
    await go(page, 'control');
    await projects(page, ['Other']);
    await go(page, 'adjust');
    await page.click('.mark');
    // The list may be read anew, in another order, between the place of a button and the click on it.
    const openIt = async (one) => {
      const there = () => page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted && location.hash !== '#start', one, { timeout: 10_000 });
      for (let tries = 0; tries < 4; tries++) {
        if ((await hash(page)) !== '#start') await page.click('.mark');
        await page.waitForTimeout(1000);
        await page.locator(`tr[data-project]:has(.name:text-is("${one}")) .do .button`).click();
        if (await there().then(() => true, () => false)) return;
      }
      assert.fail(`${one} does not open`);
    };
    await openIt('Sample');
    assert.equal(await hash(page), '#control');
    await page.click('.mark');
    await openIt('Other');
    assert.equal(await hash(page), '#adjust');
    // A window of its own begins at the start; a project that was deleted meanwhile is not returned to.
    const second = await context.newPage();
    await second.goto(url);
    await second.waitForSelector('[data-project]');
    assert.equal(await hash(second), '#start');
    await second.close();
    await page.click('.mark');
    await waitForList(page, ['Sample', 'Other']);
    await page.evaluate(() => history.replaceState(null, '', '#adjust'));
    await page.evaluate(() => sessionStorage.setItem('sightline.open', 'gone'));
    await page.reload();
    await page.waitForSelector('main.start');
    assert.equal(await page.locator('.notice').count(), 0);
    await afresh(page);
    await page.waitForSelector('[data-project]');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** Height of the photo's place, and where it begins. */
const place = (page) => page.$eval('.stage-body', (e) => {
  const box = e.getBoundingClientRect();
  return { top: box.top, height: Math.min(box.bottom, innerHeight) - box.top };
});

test('the photo has most of the screen, and nothing moves it while one marks', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    for (const language of ['en', 'ko']) {
      for (const step of ['targets', 'identities', 'control']) {
        await go(page, step);
        await page.waitForSelector('canvas.photo');
        assert.equal((await place(page)).height, 560, `${language} ${step}`);
        const cut = await page.$$eval('.steps .label, .steps .figure', (all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent));
        assert.deepEqual(cut, [], `${language} ${step}`);
      }
      await page.locator('.tools [aria-label*="Language"], .tools [aria-label*="언어"]').click();
    }
    await go(page, 'identities');
    await page.waitForSelector('canvas.photo');
    const before = await place(page);
    const still = async (what) => assert.deepEqual(await place(page), before, what);
    // None of these moves the photo: choosing a point, a question, a mode, a notice.
    await page.click('.columns tr[data-key="11"]');
    await page.waitForSelector('.insets li');
    await still('a point is chosen');
    await page.click('[data-action=series]');
    await page.waitForSelector('.question.marking');
    await still('point by point');
    assert.equal(await page.locator('.legend:visible').count(), 0, 'what is asked has the row');
    await page.keyboard.press('Escape');
    await clickPhoto(page, [60, 60], { modifiers: ['Alt'] });
    await page.waitForSelector('.question');
    await still('a place waits for its name');
    await page.keyboard.type('extra');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.notice');
    await still('something is told');
    const [told, head] = await Promise.all([page.locator('.notice').boundingBox(), page.locator('.head').boundingBox()]);
    assert.ok(told.y > head.y + head.height, 'not over the head');
    // The loupe moves away from the chosen point, wherever the point is.
    for (const point of await page.$$eval('.columns tr.data', (all) => all.slice(0, 20).map((row) => row.dataset.key))) {
      await page.click(`.columns tr[data-key="${point}"]`);
      await page.waitForTimeout(60);
      const covered = await page.evaluate(() => {
        const over = document.querySelector('.docked-loupe')?.getBoundingClientRect();
        return over && [over.left, over.top, over.right, over.bottom];
      });
      if (!covered) continue;
      const at = await page.evaluate(() => {
        const [cell] = document.querySelectorAll('.panel.point tr.chosen');
        return cell && [...cell.cells].slice(1, 3).map((c) => Number(c.textContent.replaceAll(/[\u2009\s]/g, '').replace('−', '-')));
      });
      if (!at) continue;
      const box = await page.locator('canvas.photo').boundingBox();
      const scale = Math.min(box.width / 1632, box.height / 1224);
      const [x, y] = [box.x + (box.width - 1632 * scale) / 2 + at[0] * scale, box.y + (box.height - 1224 * scale) / 2 + at[1] * scale];
      assert.ok(x < covered[0] || x > covered[2] || y < covered[1] || y > covered[3], `point ${point} under the loupe`);
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('modes end with Esc, with the step and with the project, and are seen', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'identities');
    const freely = page.getByRole('button', { name: 'Place freely' });
    const series = page.locator('[data-action=series]');
    const on = async () => {
      if ((await freely.getAttribute('aria-pressed')) === 'false') await freely.click();
      assert.match(await page.textContent('.legend .mode'), /Placing freely.*Esc/);
      if ((await series.getAttribute('aria-pressed')) === 'false') await series.click();
    };
    const off = async (what) => {
      for (const button of [freely, series]) assert.equal(await button.getAttribute('aria-pressed'), 'false', what);
    };
    await on();
    await page.keyboard.press('Escape');
    await off('Esc');
    await on();
    await go(page, 'targets');
    await off('the step');
    await go(page, 'identities');
    await on();
    await projects(page, ['Other']);
    await page.evaluate(() => (location.hash = 'identities'));
    await page.waitForSelector('[data-action=series]');
    await off('the project');
    // A menu closes with Esc, with a click outside and with a choice.
    const menu = page.locator('.file-menu.open');
    const button = page.locator('[data-action=file]');
    await button.click();
    assert.equal(await menu.count(), 1);
    await page.keyboard.press('Escape');
    assert.equal(await menu.count(), 0);
    assert.ok(await button.evaluate((e) => e === document.activeElement));
    await button.click();
    await page.mouse.click(500, 600);
    assert.equal(await menu.count(), 0);
    await button.click();
    await page.click('.file-menu .to-equipment');
    assert.equal(await menu.count(), 0);
    assert.equal(await hash(page), '#equipment');
    // What lies beside the path leads back to where one was.
    assert.match(await page.textContent('[data-action=back]'), /Point names/);
    await page.click('[data-action=back]');
    assert.equal(await hash(page), '#identities');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('pages with nothing on them say what to do next, and refused files stand at the top', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await page.waitForSelector('.sample');
    await photos(page, [...(await drawn(page, ['wall-1.png', 'wall-2.png'])), scratch('letter.jpg', 'Dear Sir or Madam')]);
    const [refused, gallery] = await Promise.all([page.locator('.gallery .problems').boundingBox(), page.locator('.gallery .tiles').first().boundingBox()]);
    assert.ok(refused.y < gallery.y, 'what was refused stands above the photos');
    await go(page, 'identities');
    assert.match(await page.textContent('[data-empty=targets]'), /no targets yet/i);
    await go(page, 'adjust');
    assert.match(await page.textContent('[data-empty=observations]'), /Nothing to adjust yet/);
    await page.click('[data-empty=observations] button');
    assert.equal(await hash(page), '#identities');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('"Match" runs with the adjustment until nothing changes, in one press', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await go(page, 'identities');
    const observations = async () => Number((await page.textContent('.bar p')).match(/\d+/)[0]);
    const all = await observations();
    // Two thirds of the points without a code lose their names.
    const uncoded = await page.$$eval('.columns tr.data', (rows) => rows.map((row) => row.dataset.key).filter((key) => /^u/.test(key)));
    for (const point of uncoded.filter((_, k) => k % 3).slice(0, 12)) {
      await page.click(`.columns tr[data-key="${point}"]`);
      await page.getByRole('button', { name: 'Remove the point' }).click();
    }
    assert.ok((await observations()) < all - 50);
    await page.click('[data-action=match]');
    await idle(page);
    assert.match(await notice(page), /matched in \d rounds? and adjusted/);
    assert.equal(await hash(page), '#identities', 'it stays where it was asked');
    assert.ok((await observations()) >= all - 4, `${await observations()} of ${all}`);
    assert.match(await page.textContent('[data-step=results] .figure'), /σ₀/);
    // Once more: nothing changes, and the result stays current.
    await page.click('[data-action=match]');
    await idle(page);
    assert.match(await notice(page), /Nothing to match/);
    assert.match(await page.textContent('[data-step=results] .figure'), /σ₀/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('results begin with a verdict, and a failed test says what is wrong with one action', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    assert.match(await page.textContent('[data-verdict]'), /residuals agree with the standard errors/);
    // Standard errors that are too large.
    await go(page, 'adjust');
    await page.fill('[name=unmodelled]', '0.05');
    await page.press('[name=unmodelled]', 'Tab');
    await page.click('.action .button');
    await idle(page);
    await go(page, 'results');
    assert.match(await page.textContent('[data-verdict]'), /Global test failed.*only 0\.\d+ times/);
    await page.click('[data-action=verdict]');
    assert.equal(await hash(page), '#adjust');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('on a phone the photo begins high, is large, and what is done next lies at the bottom', longer, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844, hasTouch: true, isMobile: true });
  try {
    await sample(page);
    for (const language of ['en', 'ko']) {
      for (const step of ['targets', 'identities']) {
        await go(page, step);
        await page.waitForSelector('canvas.photo');
        await page.waitForTimeout(200);
        const { top, height } = await place(page);
        assert.ok(top <= 180, `${language} ${step}: the photo begins at ${top}`);
        assert.ok(height >= 440, `${language} ${step}: the photo has ${height}`);
        const action = await page.locator('.bar .primary:visible').first().boundingBox();
        assert.ok(action.y > 750 && action.y + action.height <= 844 && action.x + action.width <= 390, `${language} ${step}: ${JSON.stringify(action)}`);
      }
      await page.locator('.tools .menu').tap();
      await page.locator('.tools [aria-label*="Language"], .tools [aria-label*="언어"]').tap();
    }
    // The menu closes by Esc and by a touch elsewhere.
    const menu = page.locator('.more.open');
    await page.locator('.tools .menu').tap();
    assert.equal(await menu.count(), 1);
    await page.keyboard.press('Escape');
    assert.equal(await menu.count(), 0);
    await page.locator('.tools .menu').tap();
    await page.touchscreen.tap(60, 500);
    assert.equal(await menu.count(), 0);
    await go(page, 'results');
    const broken = await page.$$eval('.result-views button', (all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).length);
    assert.equal(broken, 0);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
