// Without a network: the server stops, the page goes on; a new build comes whole and when it is agreed to; one file does it from a disk.
import assert from 'node:assert/strict';
import { cpSync, existsSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { createHash } from 'node:crypto';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { dist, open } from './browser.mjs';
import { adjust, detect, downloads, drop, go, idle, photos, rows, sample, save, scratch, unzipped } from './desk.mjs';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml', '.png': 'image/png', '.webmanifest': 'application/manifest+json' };

/** A static host without special headers, with the page on a path of its own. */
async function host(folder) {
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://host').pathname).replace(/^\/some\/where\//, '') || 'index.html';
    const file = join(folder, name);
    if (name.startsWith('/') || !existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const stop = () => new Promise((done) => (server.close(done), server.closeAllConnections()));
  return { address: `http://127.0.0.1:${server.address().port}/some/where/`, stop };
}

const ready = (page) => page.evaluate(async () => Boolean((await navigator.serviceWorker.ready).active));

/** From photos dropped to tables handed over, with the photos of the sample; gives the sigma0 it ends with. */
async function fromDropToExport(page) {
  await sample(page);
  const wanted = await page.textContent('[data-result=sigma0]');
  const saved = await downloads(page, 1, () => save(page));
  const files = Object.entries(unzipped(Object.values(saved)[0])).filter(([name]) => name.startsWith('photos/'));
  assert.equal(files.length, 8);
  await page.click('.mark');
  await page.reload();
  await photos(page, files.map(([name, bytes]) => scratch(name.slice(7), bytes)));
  await detect(page, {});
  assert.ok(Number((await page.textContent('[data-step=targets] .figure')).replace(/\D/g, '')) > 300);
  // What control the sample has comes from its own tables.
  await drop(page, [scratch(...Object.entries(saved)[0])]);
  await page.waitForSelector('[data-result=sigma0]', { timeout: 60_000 });
  await idle(page);
  await adjust(page);
  assert.equal(await page.textContent('[data-result=sigma0]'), wanted);
  const tables = await downloads(page, 1, () => page.getByRole('button', { name: /CSV/ }).first().click());
  assert.ok(Object.values(tables).some((content) => rows(content).length > 0));
  // The view in space is a file that is asked for only now.
  await page.click('[data-action=object]');
  await page.waitForFunction(() => document.querySelector('.space-host')?.view?.counts().points > 20, undefined, { timeout: 60_000 });
}

test('with the server stopped the page reloads and works from drop to export', { timeout: 600_000 }, async () => {
  const { address, stop } = await host(dist);
  const { page, errors, close } = await open({ address, width: 1366, height: 768 });
  try {
    assert.ok(await ready(page));
    await stop();
    await page.reload();
    await page.waitForSelector('.sample');
    await fromDropToExport(page);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a new build comes whole, when it is agreed to, or not at all', { timeout: 300_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-build-'));
  cpSync(dist, folder, { recursive: true });
  const { address, stop } = await host(folder);
  const { page, close } = await open({ address });
  const check = () => page.evaluate(async () => (await navigator.serviceWorker.getRegistration()).update().catch(() => {}));
  const digest = (name) => createHash('sha256').update(readFileSync(join(folder, name))).digest('hex');
  try {
    assert.ok(await ready(page));
    await page.reload();
    await page.waitForSelector('.sample');
    const script = readFileSync(join(folder, 'service.js'), 'utf8');
    const [old, changed] = [digest('index.html'), readFileSync(join(folder, 'index.html'), 'utf8').replace('<title>Sightline', '<title>Sightline 2')];
    const next = createHash('sha256').update(changed).digest('hex');
    // The list of the new build is here, its page not yet.
    writeFileSync(join(folder, 'service.js'), script.replace(old, next).replace(/const DIGEST = '../, "const DIGEST = '--"));
    await check();
    await page.waitForTimeout(2000);
    assert.equal(await page.locator('.notice').count(), 0);
    await page.reload();
    await page.waitForSelector('.sample');
    assert.ok(!(await page.content()).includes('<title>Sightline 2'));
    // All of it.
    writeFileSync(join(folder, 'index.html'), changed);
    writeFileSync(join(folder, 'service.js'), script.replace(old, next).replace(/const DIGEST = '../, "const DIGEST = '++"));
    await check();
    await page.waitForSelector('.notice:has-text("new version")', { timeout: 30_000 });
    const answered = await page.evaluate(async () => (await fetch('./index.html')).text());
    assert.ok(!answered.includes('<title>Sightline 2'));
    await Promise.all([page.waitForNavigation(), page.getByRole('button', { name: 'Reload to update' }).click()]);
    await page.waitForSelector('.sample');
    assert.ok((await page.evaluate(async () => (await fetch('./index.html')).text())).includes('<title>Sightline 2'));
  } finally {
    await close();
    await stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

test('one file does the same from a disk', { timeout: 600_000 }, async () => {
  const address = pathToFileURL(join(dist, 'sightline.html')).href;
  const { page, errors, close } = await open({ address, width: 1366, height: 768 });
  try {
    await page.waitForSelector('.sample');
    await page.waitForFunction(() => (document.querySelector('.foot .storage')?.textContent ?? '') !== '');
    await fromDropToExport(page);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** The folder of the build that a page names. */
const buildOf = (folder) => /([0-9a-f]{16})\/desk_bg\.wasm/.exec(readFileSync(join(folder, 'index.html'), 'utf8'))[1];

test('a page whose build is not on the host any more takes no part of another one, and asks to be loaded anew', { timeout: 300_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-skew-'));
  cpSync(dist, folder, { recursive: true });
  const { address, stop } = await host(folder);
  // Nothing is kept: the first visit, a private window, plain HTTP.
  const { page, close } = await open({ address, serviceWorkers: 'block', width: 1366, height: 768 });
  try {
    await page.waitForSelector('.sample');
    await page.evaluate(() => new Promise((done) => setTimeout(done, 2000)));
    // The host gets another build in the middle of the visit.
    const [old, next] = [buildOf(folder), '0123456789abcdef'];
    renameSync(join(folder, old), join(folder, next));
    writeFileSync(join(folder, 'index.html'), readFileSync(join(folder, 'index.html'), 'utf8').replaceAll(old, next));
    const asked = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.click('.sample');
    await page.waitForSelector('.notice:has-text("another version of Sightline")', { timeout: 60_000 });
    assert.ok(asked.every((url) => !url.includes(next)), asked.join());
    await Promise.all([page.waitForEvent('load'), page.getByRole('button', { name: 'Reload', exact: true }).click()]);
    await sample(page);
    assert.equal(await page.locator('.notice:has-text("another version")').count(), 0);
  } finally {
    await close();
    await stop();
    rmSync(folder, { recursive: true, force: true });
  }
});

const LACKS = {
  'no WebAssembly': [{ script: 'delete self.WebAssembly' }, /WebAssembly is missing/],
  'no SIMD': [{ script: 'WebAssembly.validate = () => false' }, /SIMD/],
  'no modules': [{ script: 'delete HTMLScriptElement.prototype.noModule' }, /JavaScript modules/],
  'a module that is not there': [{ route: ['**/desk.js', (route) => route.fulfill({ status: 404, body: 'not here' })] }, /a part of it did not come.*start\.js/],
  'a module of a wrong type': [{ route: ['**/start.js', async (route) => route.fulfill({ response: await route.fetch(), headers: { 'Content-Type': 'text/plain' } })] }, /a part of it did not come.*start\.js/],
  'no module of WebAssembly': [{ route: ['**/desk_bg.wasm', (route) => route.fulfill({ status: 404, body: 'not here' })] }, /cannot start/],
};
for (const language of ['en', 'ko']) {
  test(`a page that cannot start says what is missing and which browsers work (${language})`, { timeout: 300_000 }, async () => {
    for (const [what, [{ script, route }, words]] of Object.entries(LACKS)) {
      const { page, context, close } = await open({ serviceWorkers: 'block', locale: language === 'ko' ? 'ko-KR' : 'en-US' });
      try {
        if (script) await context.addInitScript(script);
        if (route) await context.route(...route);
        await page.reload();
        const trouble = page.locator('#trouble');
        await trouble.waitFor({ state: 'visible', timeout: 20_000 });
        const told = await trouble.textContent();
        if (language === 'en') assert.match(told, words, what);
        else assert.match(told, /페이지를 시작할 수 없습니다/, what);
        assert.match(told, /Chrome.*91.*Firefox.*114.*Safari.*16\.4/, what);
        assert.equal(await page.locator('#static .waiting:visible').count(), 0);
      } finally {
        await close();
      }
    }
  });
}

for (const locale of ['en-US', 'ko-KR']) {
  test(`what the start page begins with stands before the page's module has come (${locale})`, { timeout: 120_000 }, async () => {
    const { page, context, close } = await open({ serviceWorkers: 'block', locale });
    try {
      let release;
      const held = new Promise((done) => (release = done));
      await context.route('**/desk_bg.wasm', async (route) => {
        await held;
        await route.continue();
      });
      await page.reload({ waitUntil: 'commit' });
      // The page is parsed in pieces: its language is chosen when all of it is there.
      await page.waitForFunction((language) => document.querySelector(`#static [lang=${language}] h1`)?.offsetParent, locale.slice(0, 2), { timeout: 10_000 });
      const shown = async (where) => page.$$eval(`${where} .invitation h1, ${where} .invitation p:first-of-type`, (all) => all.filter((one) => one.offsetParent).map((one) => one.textContent.trim()));
      const before = await shown('#static');
      release();
      await page.waitForSelector('.sample');
      assert.equal(await page.locator('#static').count(), 0);
      assert.deepEqual(before, await shown('.desk'));
      assert.equal(before.length, 2);
    } finally {
      await close();
    }
  });
}

test('a page that cannot be kept says that it loads only with the network', { timeout: 120_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-kept-'));
  cpSync(dist, folder, { recursive: true });
  // A file of it does not come, so that no build is whole.
  rmSync(join(folder, 'icon-512.png'));
  const { address, stop } = await host(folder);
  const { page, close } = await open({ address, width: 1366, height: 768 });
  try {
    await page.waitForFunction(() => /needs a network to load/.test(document.querySelector('.foot .storage')?.textContent), undefined, { timeout: 30_000 });
  } finally {
    await close();
    await stop();
    rmSync(folder, { recursive: true, force: true });
  }
});
