// What goes wrong is said, with what and where, and nothing is lost. The sample gives the photos.
import assert from 'node:assert/strict';
import { deflateSync } from 'node:zlib';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, afresh, downloads, drop, go, idle, notice, photos, sample, save, scratch } from './desk.mjs';

/** A grey PNG of one value: a photo without a target. */
function plainPng(width, height) {
  const table = Array.from({ length: 256 }, (_, n) => {
    for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
    return n >>> 0;
  });
  const crc = (bytes) => ~bytes.reduce((c, b) => table[(c ^ b) & 255] ^ (c >>> 8), ~0) >>> 0;
  const chunk = (name, content) => {
    const body = Buffer.concat([Buffer.from(name), content]);
    const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(content.length);
    sum.writeUInt32BE(crc(body));
    return Buffer.concat([length, body, sum]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 0, 0, 0, 0], 8);
  const pixels = Buffer.alloc((width + 1) * height, 90);
  for (let y = 0; y < height; y++) pixels[y * (width + 1)] = 0;
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head), chunk('IDAT', deflateSync(pixels)), chunk('IEND', Buffer.alloc(0))]);
}

test('broken, foreign and duplicate files are named and the rest goes on', { timeout: 300_000 }, async () => {
  const { page, close } = await open();
  try {
    const png = plainPng(640, 480);
    const avif = Buffer.concat([Buffer.from([0, 0, 0, 24]), Buffer.from('ftypavif'), Buffer.alloc(64)]);
    await photos(page, [
      scratch('good.png', png),
      scratch('again.png', png),
      scratch('cut.png', png.subarray(0, 60)),
      scratch('phone.avif', avif),
      scratch('letter.jpg', 'Dear Sir or Madam'),
    ]);
    assert.equal(await page.locator('.tile').count(), 1);
    const problems = await page.$$eval('.problems li', (all) => all.map((item) => item.textContent));
    assert.equal(problems.length, 4);
    assert.ok(problems.some((p) => p.startsWith('phone.avif') && /AVIF/.test(p) && /convert/i.test(p)));
    assert.ok(problems.some((p) => p.startsWith('cut.png') && /decoded/.test(p)));
    assert.ok(problems.some((p) => p.startsWith('good.png') && /again\.png/.test(p)));
    assert.ok(problems.some((p) => p.startsWith('letter.jpg') && /JPEG, HEIC, camera RAW, PNG, TIFF or BMP/.test(p)));
  } finally {
    await close();
  }
});

test('a photo without targets and a point seen once take no part and are named', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open();
  try {
    await sample(page);
    await drop(page, [scratch('empty-wall.png', plainPng(1632, 1224))]);
    await page.waitForFunction(() => document.querySelector('[data-step=photos] .figure')?.textContent.trim() === '9');
    await idle(page);
    // A point that only one photo has: a free click, measured or placed, gets a name of its own.
    await go(page, 'identities');
    await page.click('[data-photo="sample-1"]');
    await page.waitForTimeout(1500);
    const canvas = await page.locator('canvas.photo').boundingBox();
    await page.mouse.move(canvas.x + canvas.width / 2 + 7, canvas.y + canvas.height / 2 + 41);
    await page.keyboard.down('Alt');
    await page.mouse.down();
    await page.mouse.up();
    await page.keyboard.up('Alt');
    await page.waitForFunction(() => document.querySelector('.notice, .question'));
    if (await page.locator('.question').count()) await page.click('.question button');
    await adjust(page);
    await page.waitForSelector('[data-result=sigma0]');
    await go(page, 'adjust');
    const advice = await page.textContent('.advice');
    assert.match(advice, /No point is measured in photo 1(?!\d)/);
    assert.match(advice, /9001 is measured in photo sample-1 only/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('without control and without scale the network says so', { timeout: 600_000 }, async () => {
  const { page, close } = await open();
  try {
    await sample(page);
    await go(page, 'control');
    while (await page.locator('.preview select').count()) await page.locator('.preview select').first().selectOption('tie');
    await page.getByRole('button', { name: 'Remove the distance' }).click();
    await page.getByRole('radio', { name: /Control points/ }).check();
    await go(page, 'adjust');
    await page.click('.action .button');
    await idle(page);
    assert.match(await notice(page), /datum|control/i);
    assert.match(await page.textContent('.advice'), /at least three control points/);
    await page.getByRole('radio', { name: /Free network/ }).check();
    await adjust(page);
    await page.waitForSelector('[data-result=sigma0]');
    await go(page, 'adjust');
    assert.match(await page.textContent('.advice'), /Give a distance/);
  } finally {
    await close();
  }
});

test('an empty project says what it lacks', { timeout: 120_000 }, async () => {
  const { page, errors, close } = await open();
  try {
    const empty = scratch('empty.json', JSON.stringify({ format: 'sightline', version: 1 }));
    await drop(page, [empty]);
    // A text is read without a bar of progress: the steps tell when the project is open.
    await page.waitForFunction(() => [...document.querySelectorAll('.steps button')].every((step) => !step.disabled));
    await go(page, 'adjust');
    await page.click('.action .button');
    await idle(page);
    assert.match(await notice(page), /no photos/i);
    await drop(page, [scratch('wrong.json', '{"format":"other"}')]);
    await idle(page);
    assert.match(await notice(page), /wrong\.json/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('the language switches without losing anything and a saved project opens as it was', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const sigma0 = await page.textContent('[data-result=sigma0]');
    assert.equal(await page.getAttribute('html', 'lang'), 'en');
    await page.getByRole('button', { name: 'Language: switch to Korean' }).click();
    assert.equal(await page.getAttribute('html', 'lang'), 'ko');
    assert.match(await page.textContent('.hero'), /잉여도/);
    assert.equal(await page.textContent('[data-result=sigma0]'), sigma0);
    // Nothing of English is left but names and symbols.
    const left = (await page.textContent('body')).match(/\b(photos|points|adjust\w*|results?|targets?)\b/gi);
    assert.equal(left, null);
    await page.getByRole('button', { name: '언어: 영어로 바꾸기' }).click();

    const saved = await downloads(page, 1, () => save(page));
    const [[name, bytes]] = Object.entries(saved);
    assert.equal(name, 'Sample.sightline');
    await afresh(page);
    await drop(page, [scratch(name, bytes)]);
    await page.waitForSelector('[data-result=sigma0]', { timeout: 60_000 });
    assert.equal(await page.textContent('[data-result=sigma0]'), sigma0);
    await idle(page);
    await go(page, 'targets');
    await page.waitForSelector('.strip canvas.thumbnail');
    assert.equal(await page.locator('.strip canvas.thumbnail').count(), 8);
    // No page scroll, at any step.
    for (const step of ['photos', 'targets', 'identities', 'control', 'adjust', 'results']) {
      await go(page, step);
      const over = await page.evaluate(() => document.documentElement.scrollHeight - innerHeight + document.documentElement.scrollWidth - innerWidth);
      assert.equal(over, 0, step);
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('on a phone every step is in reach and nothing lies over it', { timeout: 300_000 }, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844 });
  try {
    await sample(page);
    for (const step of ['photos', 'targets', 'identities', 'control', 'adjust', 'results']) {
      await go(page, step);
      const bar = await page.locator('.head').boundingBox();
      const main = await page.locator('.desk > main').boundingBox();
      const steps = await page.locator('.steps').boundingBox();
      assert.ok(steps.y + steps.height <= bar.y + bar.height + 1 && main.y >= bar.y + bar.height - 1, step);
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

// It ends where it would have answered, as a worker does that the system takes the memory from; or it sends an invalid answer.
for (const [instead, told] of [['self.close()', /ended without a word/], ['post({})', /said what is no answer/]]) {
  test(`a worker's end without an answer is noticed, its task tried once more, then told: ${instead}`, { timeout: 300_000 }, async () => {
    const { page, context, close } = await open({ cores: 1, serviceWorkers: 'block' });
    const engine = () => page.workers().find((worker) => worker.url().endsWith('/worker.js'));
    const dying = `const post = self.postMessage.bind(self);
      self.postMessage = (message, ...rest) => (message.body === undefined ? post(message, ...rest) : ${instead});`;
    try {
      await photos(page, [scratch('good.png', plainPng(640, 480))]);
      await engine().evaluate(dying);
      await go(page, 'targets');
      await page.click('[data-action=detect]');
      await idle(page, 30_000);
      assert.equal(await page.locator('.notice').count(), 0);
      // Every worker that comes does so now: that is reported, and the page goes on.
      await context.route('**/worker.js', async (route) => {
        const response = await route.fetch();
        await route.fulfill({ response, body: `${dying}\n${await response.text()}` });
      });
      await engine().evaluate(dying);
      await page.click('[data-action=detect]');
      await page.waitForSelector('.notice', { timeout: 30_000 });
      assert.match(await notice(page), told);
    } finally {
      await close();
    }
  });
}
