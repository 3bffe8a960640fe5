// Projects are kept by the browser: reloading, two windows, the list on the start page, deleting and getting back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { afresh, downloads, drop, go, idle, notice, sample, scratch, unzipped } from './desk.mjs';

const written = (page) => page.waitForFunction(() => /^saved \d/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 60_000 });
const figure = (page, step) => page.textContent(`[data-step=${step}] .figure`);
const named = (name) => JSON.stringify({ format: 'sightline', version: 1, name });

/** Opens the first project of the list. */
async function goOn(page, name) {
  await page.click(name ? `tr[data-project]:has-text("${name}") .do .button` : '[data-project] .do .button');
  await page.waitForSelector('.project-name');
}

test('a reloaded page has the project as it was, with its result, its photos and what can be undone', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const sigma0 = await page.textContent('[data-result=sigma0]');
    await go(page, 'control');
    await page.locator('.preview select').first().selectOption('check');
    assert.equal(await figure(page, 'results').then((f) => f.trim()), 'out of date');
    await page.fill('.project-name', 'Panel');
    await page.press('.project-name', 'Enter');
    await written(page);
    await afresh(page);
    await page.waitForSelector('[data-project]');
    const row = await page.textContent('[data-project]');
    assert.match(row, /Panel.*8.*out of date/s);
    assert.equal(await page.locator('[data-project] canvas.thumbnail').count(), 1);
    await goOn(page);
    assert.equal(await page.inputValue('.project-name'), 'Panel');
    assert.equal((await figure(page, 'results')).trim(), 'out of date');
    const undo = page.locator('.tools .icon-button').first();
    await page.waitForFunction(() => document.querySelector('.tools .icon-button')?.disabled === false);
    assert.match(await undo.getAttribute('aria-label'), /role/i);
    await undo.click();
    assert.match(await figure(page, 'results'), /σ₀/);
    await go(page, 'results');
    assert.equal(await page.textContent('[data-result=sigma0]'), sigma0);
    // Without its photos it would not be as it was: they are measured again, and give the same.
    await go(page, 'targets');
    await page.waitForSelector('.strip canvas.thumbnail');
    const targets = await figure(page, 'targets');
    await page.click('[data-action=detect]');
    await idle(page);
    assert.equal(await figure(page, 'targets'), targets);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('projects are listed, renamed, duplicated, downloaded, deleted and got back', { timeout: 600_000 }, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  const names = () => page.$$eval('[data-project] .name', (all) => all.map((one) => one.textContent));
  const waitFor = (wanted) => page.waitForFunction((list) => JSON.stringify([...document.querySelectorAll('[data-project] .name')].map((one) => one.textContent).sort()) === list, JSON.stringify([...wanted].sort()));
  const verb = async (name, label) => {
    const row = page.locator(`tr[data-project]:has(.name:text-is("${name}"))`);
    const button = page.locator(`tr[data-project]:has(.name:text-is("${name}")) + tr.verbs`).getByRole('button', { name: label });
    // The list may be read anew between the two clicks, which closes the row of verbs.
    for (let tries = 0; ; tries++) {
      if ((await row.locator('.icon-button').getAttribute('aria-expanded')) !== 'true') await row.locator('.icon-button').click();
      try {
        return await button.click({ timeout: 3000 });
      } catch (error) {
        if (tries === 5) throw error;
      }
    }
  };
  try {
    await drop(page, [scratch('one.json', named('One'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'One');
    await written(page);
    // Opening another asks nothing: the first is kept, and that is said.
    await drop(page, [scratch('two.json', named('Two'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Two');
    assert.match(await notice(page), /One is stored on this computer/);
    await written(page);
    await page.click('.mark');
    await waitFor(['One', 'Two']);
    assert.equal((await names())[0], 'Two');
    await verb('One', 'Duplicate');
    await waitFor(['One', 'One (copy)', 'Two']);
    await verb('One', 'Rename');
    await page.fill('[data-project] input', 'First');
    await page.press('[data-project] input', 'Enter');
    await waitFor(['First', 'One (copy)', 'Two']);
    const files = await downloads(page, 1, () => verb('First', 'Download with photos'));
    assert.equal(JSON.parse(unzipped(files['First.sightline'])['project.json']).name, 'First');
    await page.click('.mark');
    await waitFor(['First', 'One (copy)', 'Two']);
    await verb('First', 'Delete');
    await waitFor(['One (copy)', 'Two']);
    await page.locator('.notice').getByRole('button', { name: 'Undo' }).click();
    await waitFor(['First', 'One (copy)', 'Two']);
    await verb('Two', 'Delete');
    await waitFor(['First', 'One (copy)']);
    await afresh(page);
    await waitFor(['First', 'One (copy)']);
    await goOn(page, 'One (copy)');
    assert.equal(await page.inputValue('.project-name'), 'One (copy)');
    assert.match(await page.textContent('.foot .storage'), /MB of .* used/);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a second window reads along, and can take over', { timeout: 300_000 }, async () => {
  const { page, context, errors, url, close } = await open({ width: 1366, height: 768 });
  try {
    await drop(page, [scratch('one.json', named('One'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'One');
    await written(page);
    const second = await context.newPage();
    await second.goto(url);
    await goOn(second);
    await second.waitForSelector('.notice:has-text("open in another window")');
    // What the first does is seen in the second, which cannot change anything.
    await page.fill('.project-name', 'Changed');
    await page.press('.project-name', 'Enter');
    await second.waitForFunction(() => document.querySelector('.project-name')?.value === 'Changed');
    await go(second, 'control');
    await second.fill('[name=unit]', 'm');
    await second.press('[name=unit]', 'Enter');
    assert.match(await second.textContent('.notices'), /Read-only/);
    await second.getByRole('button', { name: 'Take over' }).click();
    await page.waitForSelector('.notice:has-text("open in another window")');
    await second.waitForFunction(() => document.querySelector('.notices')?.textContent.includes('open in another window') === false);
    await second.fill('.project-name', 'Taken');
    await second.press('.project-name', 'Enter');
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Taken');
    // A window that is gone holds nothing.
    await second.close();
    await page.getByRole('button', { name: 'Take over' }).click();
    await page.waitForFunction(() => document.querySelector('.notices')?.textContent.includes('open in another window') === false);
    assert.equal(await page.inputValue('.project-name'), 'Taken');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a browser that keeps nothing says so, and asks before anything is lost', { timeout: 600_000 }, async () => {
  const { page, context, close } = await open({ width: 1366, height: 768, serviceWorkers: 'block' });
  try {
    await context.route('**/storage.js', (route) => route.abort());
    await afresh(page);
    await page.waitForFunction(() => /stores nothing here/.test(document.querySelector('.foot .storage')?.textContent));
    // A sample that nobody has worked on is no work.
    await sample(page);
    await drop(page, [scratch('other.json', named('Other'))]);
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Other');
    await go(page, 'control');
    await page.fill('[name=unit]', 'm');
    await page.press('[name=unit]', 'Enter');
    await page.click('.mark');
    await page.click('.sample');
    await page.waitForSelector('.asking');
    assert.match(await page.textContent('.asking'), /Other has changes that are not saved/);
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('.asking').count(), 0);
    await idle(page);
    assert.equal(await page.inputValue('.project-name'), 'Other');
    await drop(page, [scratch('third.json', named('Third'))]);
    await page.locator('.asking').getByRole('button', { name: 'Open without saving' }).click();
    await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Third');
    // What went can be got back.
    await page.keyboard.press('Control+z');
    assert.equal(await page.inputValue('.project-name'), 'Other');
  } finally {
    await close();
  }
});
