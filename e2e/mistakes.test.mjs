// The mistakes of a crew, each made on the sample: named in step 5, beside sigma0 and in the summary of the report.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';

import { open } from './browser.mjs';
import { adjust, downloads, drop, go, idle, sample, save, scratch, unzipped } from './desk.mjs';

const longer = { timeout: 600_000 };
const shots = process.env.SIGHTLINE_SHOTS;
let project;

before(async () => {
  const { page, close } = await open({ width: 1366, height: 768 });
  try {
    await sample(page);
    const files = await downloads(page, 1, () => save(page, false));
    project = JSON.parse(unzipped(Object.values(files)[0])['project.json']);
  } finally {
    await close();
  }
}, longer);

const control = (p, id) => p.points.find((point) => point.id === id);

/** Name, what is done to the project, and what the page must say. */
const mistakes = [
  ['a typing error of 1 mm in control', (p) => (control(p, '9').xyz[0] += 1), /Control point 9 is/],
  ['a typing error of 30 mm in control', (p) => (control(p, '9').xyz[0] += 30), /Control points 9 do not fit/],
  [
    'two control points exchanged',
    (p) => ([control(p, '3').xyz, control(p, '7').xyz] = [control(p, '7').xyz, control(p, '3').xyz]),
    // On four corners of a rectangle the exchange of 1 and 9 explains the same: no adjustment, and an error that names them all.
    /Control points 1, 3, 7, 9 do not fit.*exchanged/,
  ],
  ['X with the other sign', (p) => p.points.forEach((point) => point.xyz && (point.xyz[0] *= -1)), /axes|mirrored/],
  ['X and Y exchanged', (p) => p.points.forEach((point) => point.xyz && point.xyz.splice(0, 2, point.xyz[1], point.xyz[0])), /axes|mirrored/],
  ['control in another unit', (p) => p.points.forEach((point) => point.xyz && (point.xyz = point.xyz.map((x) => x / 1000))), /a wrong unit\?/],
  ['a distance in another unit', (p) => (p.distances[0].length /= 25.4), /a wrong unit\?/],
  [
    'a wrong name',
    (p) => {
      const one = p.observations.find((o) => o.photo === 'sample-3' && o.point === '5');
      const other = p.observations.find((o) => o.photo === 'sample-3' && o.point === '11');
      [one.u, one.v] = [other.u, other.v];
      p.observations.splice(p.observations.indexOf(other), 1);
    },
    /\b5\s+(–\s+)?sample-3/,
  ],
  [
    'a photo of another camera',
    (p) => {
      for (const o of p.observations.filter((o) => o.photo === 'sample-4')) {
        o.u = 816 + 1.35 * (o.u - 816);
        o.v = 612 + 1.35 * (o.v - 612);
      }
      p.observations = p.observations.filter((o) => o.photo !== 'sample-4' || (o.u > 0 && o.u < 1632 && o.v > 0 && o.v < 1224));
    },
    /[Pp]hoto sample-4\b|photos \(sample-4\)/,
  ],
];

/** The sample as it was measured and before it is oriented, with its control points as the datum. */
function made(mistake) {
  const p = structuredClone(project);
  for (const photo of p.photos) [photo.position, photo.rotation] = [null, null];
  p.points = p.points.map((point) => (point.role === 'control' ? point : { ...point, xyz: null }));
  p.datum = { kind: 'control' };
  mistake(p);
  return p;
}

const shown = (page, selector) => page.$$eval(selector, (all) => all.map((one) => one.innerText).join('\n'));

for (const [name, mistake, said] of mistakes) {
  test(`${name} is named in step 5, beside sigma0 and in the report`, longer, async () => {
    const { page, errors, close } = await open({ width: 1366, height: 768 });
    try {
      const document = made(mistake);
      document.name = 'Mistake';
      await drop(page, [scratch('mistake.json', JSON.stringify(document))]);
      await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Mistake');
      await go(page, 'adjust');
      await page.click('.action .button');
      await idle(page);
      await go(page, 'adjust');
      assert.match(await shown(page, '.advice li, .not-used-list tbody tr, .notice'), said, 'step 5');
      if (shots) await page.screenshot({ path: `${shots}/${name.replaceAll(' ', '-')}-5.png` });
      await go(page, 'results');
      if (!(await page.locator('[data-result=sigma0]').count())) {
        // No result at all: then the error says it.
        assert.match(await shown(page, '.notice'), said, 'the error');
        return;
      }
      if (/^(?!a wrong name|a photo)/.test(name)) assert.doesNotMatch(await shown(page, '[data-verdict]'), /residuals agree with|standard errors were estimated/i);
      assert.match(await shown(page, '.contradictions li, [data-result=not-used]'), said, 'beside sigma0');
      if (shots) await page.screenshot({ path: `${shots}/${name.replaceAll(' ', '-')}-results.png` });
      await go(page, 'report');
      await page.waitForSelector('.paper[data-ready=true]', { timeout: 60_000 });
      const summary = await page.evaluate(() => document.querySelector('.paper').shadowRoot.querySelector('[data-section=summary]').innerText);
      assert.match(summary, said, 'the summary');
      assert.deepEqual(errors, []);
    } finally {
      await close();
    }
  });
}
