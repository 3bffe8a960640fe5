// The page for everybody: what axe-core finds, what a narrow screen leaves in reach, what a finger can hit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, go, sample } from './desk.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const steps = ['photos', 'targets', 'identities', 'control', 'adjust', 'results', 'compared', 'tables', 'report', 'object', 'plan', 'print', 'equipment', 'experiments'];
/** Pages that have an address of their own and need no click on the way. */
const beside = ['report', 'object', 'plan', 'print', 'equipment', 'experiments'];
const longer = { timeout: 900_000 };

/** Violations of WCAG 2.2 AA found by axe-core: rule, target and description. */
async function violations(page) {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const runOnly = { type: 'tag', values: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'] };
    // axe-core counts the rule on accessible names without the visible label as experimental, and those on landmarks and headings as best practice: they are turned on here.
    const more = ['label-content-name-mismatch', 'region', 'empty-table-header', 'landmark-unique'];
    const rules = Object.fromEntries(more.map((rule) => [rule, { enabled: true }]));
    const { violations: found } = await globalThis.axe.run(document, { runOnly, rules });
    return found.flatMap((rule) => rule.nodes.map((node) => `${rule.id}: ${node.target.join(' ')} ${node.failureSummary.split('\n')[1]?.trim()}`));
  });
}

/** Goes to a step of the path, or to the tables beside it, and chooses something where much depends on that. */
async function to(page, step) {
  if (step === 'tables') {
    if (await page.locator('.tools .menu').isVisible()) await page.click('.tools .menu');
    await page.click('.to-tables');
    await page.locator('.sheet tr.data td').first().click();
    await page.click('[data-action=rename]');
    await page.waitForSelector('.sheet-form');
    return;
  }
  if (beside.includes(step)) {
    await page.evaluate((step) => (location.hash = step), step);
    await page.waitForFunction((step) => location.hash.startsWith(`#${step}`) && document.querySelector('main'), step);
    await page.waitForTimeout(500);
    return;
  }
  if (step === 'compared') {
    await go(page, 'results');
    await page.click('[data-shown=compared]');
    await page.waitForSelector('.compared-points tr.data');
    return;
  }
  await go(page, step);
  if (step === 'identities') {
    await page.click('.columns tr.data');
    await page.click('[data-action=series]');
    await page.click('[data-action=layers]');
    await page.waitForSelector('.layers');
    await page.click('[data-action=layers]');
    await page.click('[data-action=series]');
  }
}

/** The sample, adjusted twice, so that there is something to compare; with a scale bar among the equipment. */
async function twoResults(page) {
  await page.click('[data-open=equipment]');
  for (const [field, value] of Object.entries({ name: 'A', from: '11', to: '12', length: '500', sigma: '0.01' })) await page.fill(`[name=bar-${field}]`, value);
  await page.click('.bar-form button');
  await page.waitForSelector('[data-bar]');
  await page.click('.mark');
  await sample(page);
  await go(page, 'adjust');
  await page.fill('[name=unmodelled]', '0.05');
  await page.press('[name=unmodelled]', 'Tab');
  await adjust(page);
  await page.waitForSelector('[data-result=sigma0]');
}

/** Opens what is folded, so that it is examined too. */
const unfold = (page) => page.$$eval('details', (all) => all.forEach((one) => (one.open = true)));

test('axe-core finds nothing on any step, in any theme', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768, reducedMotion: 'reduce', colorScheme: 'light' });
  try {
    const found = [];
    for (const line of await violations(page)) found.push(`start ${line}`);
    await twoResults(page);
    for (const theme of ['Light', 'Dark', 'Sun']) {
      assert.equal(await page.getAttribute('html', 'data-theme'), theme.toLowerCase());
      for (const step of steps) {
        await to(page, step);
        await unfold(page);
        for (const line of await violations(page)) found.push(`${theme} ${step} ${line}`);
        // The report is a page of its own, with a heading of its own, in the page.
        assert.equal(await page.evaluate(() => document.querySelectorAll('h1').length), 1, step);
      }
      await page.getByRole('button', { name: 'Theme: switch' }).click();
    }
    assert.deepEqual(found, []);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

/** Names of touch targets smaller than 44 px; a check box counts with its label. */
const small = (page) =>
  page.evaluate(() => {
    const found = [];
    for (const element of document.querySelectorAll('button, input:not([type=file]), select, textarea, summary, a[href]')) {
      const box = (element.matches('[type=checkbox], [type=radio]') ? (element.closest('label') ?? element.closest('td') ?? element) : element).getBoundingClientRect();
      const style = getComputedStyle(element);
      if (box.width < 2 || box.height < 2 || style.visibility === 'hidden' || element.closest('[hidden]')) continue;
      if (box.height < 43.5 || box.width < 43.5) found.push(`${element.tagName} ${element.className} "${(element.textContent || element.getAttribute('aria-label') || element.name || '').trim().slice(0, 20)}" ${Math.round(box.width)} x ${Math.round(box.height)}`);
    }
    return [...new Set(found)];
  });

/** Headings and tabs whose words run over their neighbours or are broken letter by letter: they have less room than their longest word. */
const squeezed = (page) =>
  page.$$eval('.section-head > :first-child, .tabs button, h1, h2, h3', (all) =>
    all.filter((e) => {
      if (e.clientWidth < 2) return false;
      const lines = e.clientHeight / parseFloat(getComputedStyle(e).fontSize);
      return e.scrollWidth > e.clientWidth + 1 || (lines > 6 && e.clientWidth < 60);
    }).map((e) => `squeezed "${e.textContent.trim().slice(0, 30)}"`));

test('on a phone nothing is cut or covered, and everything can be hit with a finger', longer, async () => {
  const { page, errors, close } = await open({ width: 390, height: 844, hasTouch: true, isMobile: true });
  try {
    const found = [];
    for (const line of await small(page)) found.push(`start ${line}`);
    await twoResults(page);
    for (const language of ['en', 'ko']) {
      assert.equal(await page.getAttribute('html', 'lang'), language);
      for (const step of steps) {
        await to(page, step);
        await unfold(page);
        for (const line of [...(await small(page)), ...(await squeezed(page))]) found.push(`${language} ${step} ${line}`);
        // The words of the open step stand whole, and bar, buttons and page keep apart.
        const cut = await page.$$eval('.steps .now .label, .bar h1, .bar .button', (all) => all.filter((e) => e.clientWidth > 1 && e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent));
        assert.deepEqual(cut, [], `${language} ${step}`);
        const boxes = await page.$$eval('.bar > *, .bar .action > *', (all) => all.map((e) => e.getBoundingClientRect().toJSON()).filter((b) => b.width > 1 && b.height > 0));
        const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.equal(over, 0, `${language} ${step}`);
        const [title, sentence, ...rest] = boxes;
        if (sentence) assert.ok(sentence.top >= title.bottom - 1 || sentence.left >= title.right, `${language} ${step}: title and sentence`);
        for (const box of rest) assert.ok(box.right <= 391 && box.left >= 0, `${language} ${step}: a button leaves the page`);
      }
      await page.getByRole('button', { name: language === 'en' ? 'More' : '더 보기' }).click();
      await page.getByRole('button', { name: language === 'en' ? 'Language: switch to Korean' : '언어: 영어로 바꾸기' }).click();
    }
    await page.getByRole('button', { name: 'More' }).click();
    await page.getByRole('button', { name: 'Experiments' }).click();
    await page.waitForSelector('.experiment');
    for (const line of await squeezed(page)) found.push(`experiments ${line}`);
    assert.deepEqual([...new Set(found)], []);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('in a small window the words of the steps stand whole, and every button of a step is in sight', longer, async () => {
  const { page, errors, close } = await open({ width: 1024, height: 700 });
  try {
    await sample(page);
    for (const language of ['en', 'ko']) {
      assert.equal(await page.getAttribute('html', 'lang'), language);
      for (const step of ['photos', 'targets', 'identities', 'control', 'adjust', 'results']) {
        await go(page, step);
        await page.waitForTimeout(300);
        for (const width of [1200, 1024]) {
          await page.setViewportSize({ width, height: 700 });
          await page.waitForTimeout(100);
          const cut = await page.$$eval('.steps .label, .stage-head > b', (all) => all.filter((e) => e.clientWidth > 0 && e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent));
          assert.deepEqual(cut, [], `${language} ${step} ${width}`);
          const out = await page.$$eval('.bar .button, .hero-action .button, .stage-head .stage-button', (all) =>
            all.map((e) => [e.textContent, e.getBoundingClientRect().toJSON()]).filter(([, box]) => box.width > 0 && (box.left < 0 || box.right > innerWidth)).map(([words]) => words));
          assert.deepEqual(out, [], `${language} ${step} ${width}`);
          // Of the stage no button is cut by its column.
          const beyond = await page.$$eval('.stage', (all) => all.flatMap((stage) => [...stage.querySelectorAll('.stage-head .stage-button')].filter((e) => e.getBoundingClientRect().right > stage.getBoundingClientRect().right + 1).map((e) => e.textContent)));
          assert.deepEqual(beyond, [], `${language} ${step} ${width}`);
        }
      }
      await page.getByRole('button', { name: language === 'en' ? 'Language: switch to Korean' : '언어: 영어로 바꾸기' }).click();
    }
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('at 1366 pixels no table of the results is cut, and a sorted column shows its direction', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    await page.waitForSelector('[data-result=sigma0]');
    await page.waitForSelector('.results .c2 tr.data');
    const cut = await page.$$eval('.results .table-frame, .results section', (all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => `${e.className} ${e.scrollWidth} in ${e.clientWidth}`));
    assert.deepEqual(cut, []);
    const points = page.locator('.results .c1');
    assert.equal(await points.locator('th.sorted .direction').textContent(), '▼');
    await points.locator('th.sorted button').click();
    assert.equal(await points.locator('th.sorted .direction').textContent(), '▲');
    assert.equal(await points.locator('th[aria-sort=ascending]').count(), 1);
    // The worst observation opens its photo, at its place.
    const worst = page.locator('.results .c2 tbody tr.data').first();
    const [point, photo] = await worst.locator('td').allTextContents();
    await worst.locator('.open button').click();
    await page.waitForFunction(() => location.hash === '#identities');
    assert.equal(await page.inputValue('[name=point-name]'), point);
    assert.equal(await page.locator(`.strip .chosen [data-photo="${photo}"]`).count(), 1);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
