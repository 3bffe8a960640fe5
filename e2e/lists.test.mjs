// Lists of points of other programs and people: understood, asked where nothing decides, and answered on the step where they are dropped.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open } from './browser.mjs';
import { downloads, drop, go, save, scratch, unzipped } from './desk.mjs';

const longer = { timeout: 300_000 };
const shots = process.env.SIGHTLINE_SHOTS;

const project = {
  format: 'sightline',
  version: 1,
  name: 'Lists',
  unit: 'mm',
  cameras: [{ id: 'k', width: 320, height: 240, model: 'brown', c: 400 }],
  photos: [{ id: '1', camera: 'k', file: 'a.jpg' }],
  points: [{ id: 'P1' }, { id: 'P2' }],
  observations: [{ photo: '1', point: 'P1', u: 40, v: 50, sigma: 0.1 }],
};

async function opened(page) {
  await drop(page, [scratch('lists.json', JSON.stringify(project))]);
  await page.waitForFunction(() => document.querySelector('.project-name')?.value === 'Lists');
}

const hash = (page) => page.evaluate(() => location.hash);
const sheet = (page) => page.waitForSelector('.import-over .import');
const take = (page) => page.locator('.import .button.primary').first();
const understood = (page) => page.textContent('[data-reading]');
const rejected = (page) => page.getAttribute('.rejected-lines', 'data-rejected');
const column = (page, k) => page.locator(`[data-column="${k}"]`);

async function saved(page) {
  const files = await downloads(page, 1, () => save(page, false));
  return JSON.parse(unzipped(Object.values(files)[0])['project.json']);
}

/** Pictures in both languages and widths, where they are wanted; the page must not be wider than the window. */
async function pictures(page, name) {
  for (const language of ['en', 'ko']) {
    // Open menus change to the chosen language at once.
    const words = await page.$$eval('[name=list-role] option, [data-column] option', (all) => all.map((option) => option.textContent).join(' '));
    (language === 'ko' ? assert.match : assert.doesNotMatch)(words, /[가-힣]/);
    for (const width of [390, 1366]) {
      await page.setViewportSize({ width, height: width === 390 ? 844 : 768 });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${name} ${language} ${width}: ${wide} px too wide`);
      if (shots) await page.screenshot({ path: `${shots}/${name}-${language}-${width}.png` });
    }
    await page.getByRole('button', { name: /Language|언어/ }).first().click();
  }
}

test('a list is answered on the step where it is dropped: unit, columns, one standard error for all', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page);
    for (const step of ['photos', 'targets', 'identities', 'adjust']) {
      await go(page, step);
      await drop(page, [scratch('hall.txt', 'Hall 4, total station\nPunkt;Y;X;H;Code\nP1;52,84;31,25;4,5;ST\nP2;52,88;32,57;4,51;ZP\nP2;52,88;32,57;4,51;ZP\nP3;;32,1;4,5;ZP\n')]);
      await sheet(page);
      assert.equal(await hash(page), `#${step}`);
      if (step !== 'adjust') await page.getByRole('button', { name: 'Discard' }).click();
    }
    assert.match(await understood(page), /2 points from lines 3 to 4.*semicolons.*Decimal comma.*Columns by the heading.*line 3.*1 line before/);
    assert.equal(await rejected(page), '2');
    assert.match(await page.textContent('.rejected-lines'), /5.*P2.*6.*/s);
    await pictures(page, 'sheet');
    await page.setViewportSize({ width: 1366, height: 768 });
    // Lengths of the project are none yet: the unit is asked, and nothing is taken before.
    assert.equal(await take(page).isDisabled(), true);
    await page.selectOption('[name=pasted-unit]', 'm');
    await page.fill('[name=list-sigma]', '2 mm + 2 ppm');
    await page.press('[name=list-sigma]', 'Enter');
    assert.match(await understood(page), /common standard error applies to 2 points/);
    // Another meaning of a column is taken at once.
    assert.equal(await column(page, 1).inputValue(), 'Y');
    await column(page, 1).selectOption('X');
    await column(page, 2).selectOption('Y');
    await page.focus('[name=list-role]');
    await page.selectOption('[name=list-role]', 'check');
    // The sheet is drawn anew by a choice, and the menu keeps the focus.
    await page.waitForFunction(() => document.activeElement.name === 'list-role' && document.activeElement.value === 'check');
    assert.equal(await take(page).isDisabled(), false);
    await take(page).click();
    await page.waitForFunction(() => location.hash === '#control');
    const { unit, points } = await saved(page);
    const point = points.find(({ id }) => id === 'P1');
    assert.deepEqual([unit, point.role, point.xyz], ['m', 'check', [52.84, 31.25, 4.5]]);
    assert.ok(Math.abs(point.sigma[0] - 0.002) < 1e-5, `${point.sigma}`);
    // The next list with this heading is read the same way, and says so.
    await go(page, 'photos');
    await drop(page, [scratch('hall-5.txt', 'Punkt;Y;X;H;Code\nP7;52,84;31,25;4,5;ST\n')]);
    await page.waitForSelector('[data-remembered]');
    assert.equal(await column(page, 1).inputValue(), 'X');
    await page.getByRole('button', { name: 'Recognise again' }).click();
    await page.waitForFunction(() => !document.querySelector('[data-remembered]'));
    assert.equal(await column(page, 1).inputValue(), 'Y');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('what nothing decides is asked, and lists of instruments are known by what is in them', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page);
    await go(page, 'targets');
    // A whole number behind decimals may be a code: the columns are asked.
    await drop(page, [scratch('codes.csv', '1,5.5,6.5,7.5,3\n2,5.1,6.1,7.1,4\n')]);
    await sheet(page);
    await page.selectOption('[name=pasted-unit]', 'm');
    assert.equal(await take(page).isDisabled(), true);
    await column(page, 4).selectOption('label');
    assert.equal(await page.locator('[data-asked]').count(), 0);
    assert.equal(await take(page).isDisabled(), false);
    await page.getByRole('button', { name: 'Discard' }).click();
    // Two of them: one press agrees.
    await drop(page, [scratch('pix4d.csv', 'g1,1.5,2.5,3.5,0.01,0.02\ng2,4.5,5.5,6.5,0.01,0.02\n')]);
    await page.locator('[data-asked=columns] button').click();
    await page.waitForFunction(() => !document.querySelector('[data-asked]'));
    await page.getByRole('button', { name: 'Discard' }).click();
    // LandXML and JobXML by their content, whatever the names end with; GSI as text.
    const lists = {
      'points.xml': ['<LandXML><Units><Metric linearUnit="meter"/></Units><CgPoints><CgPoint name="가">2 1 3</CgPoint></CgPoints></LandXML>', /LandXML/],
      'job.jxl': ['<JOBFile><Reductions><Point><Name>가</Name><Grid><North>2</North><East>1</East><Elevation>3</Elevation></Grid></Point></Reductions></JOBFile>', /JobXML/],
      'a.gsi': ['110001+0000000A 81..00+00001000 82..00+00002000 83..00+00003000\n', /Leica GSI/],
    };
    for (const [name, [content, format]] of Object.entries(lists)) {
      await drop(page, [scratch(name, content)]);
      await sheet(page);
      assert.match(await understood(page), format);
      assert.equal(await page.inputValue('[name=pasted-unit]'), 'm');
      assert.match((await page.textContent('.preview tr.new')).replaceAll(' ', ''), /1\.00002\.00003\.0000/);
      await page.getByRole('button', { name: 'Discard' }).click();
    }
    // A Western code page, reported as assumed; another one can be chosen.
    await drop(page, [scratch('west.csv', Buffer.from('Punkt;Rechtswert;Hochwert;H\xf6he\nS\xfcd;1,5;2,5;3,5\n', 'latin1'))]);
    await sheet(page);
    assert.match(await understood(page), /Windows-1252 assumed/);
    assert.match(await page.textContent('.preview tr.new'), /Süd/);
    await page.selectOption('[name=list-role]', 'tie');
    await page.selectOption('[name=pasted-unit]', 'm');
    await take(page).click();
    assert.equal((await saved(page)).points.find(({ id }) => id === 'Süd').role, 'tie');
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('latitudes and longitudes become local coordinates, at one origin for all lists of a project', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page);
    await go(page, 'photos');
    const rows = `1,37°30'12.5",127°02'03.4",30.5\n2,37°30'14.25",127°02'01.0",31.25\n3,37°30'11.0",127°02'05.9",32\n4,37.503,127°02'05.9",32\n`;
    await drop(page, [scratch('gnss.csv', `id,latitude,longitude,height\n${rows}`)]);
    await sheet(page);
    // Nothing is silent: ellipsoid, origin, kind of system, heights.
    const said = await understood(page);
    for (const part of [/degrees, minutes and seconds/, /WGS84 \(GRS80\)/, /latitude 37\.5035°, longitude 127\.0343°, height 31 m/, /not a map projection/, /ellipsoidal heights/, /mean of the list/]) assert.match(said, part);
    assert.equal(await page.inputValue('[name=pasted-unit]'), 'm');
    assert.equal(await page.getAttribute('[data-rejected]', 'data-rejected'), '1');
    assert.match(await page.textContent('.rejected-lines'), /another form/);
    await take(page).click();
    await page.waitForFunction(() => location.hash === '#control');
    const first = await saved(page);
    const system = { ellipsoid: 'WGS84', latitude: 37.5035, longitude: 127.0343, height: 31 };
    assert.deepEqual([first.origin.format, first.origin.files, first.origin.local_system], ['control-csv', ['gnss.csv'], system]);
    // PROJ 9.5: cart, topocentric; in the unit of the project.
    const wanted = [-1.96492826, -3.082989623, -0.500001049];
    const scale = { m: 1, mm: 1000 }[first.unit];
    const { xyz } = first.points.find(({ id }) => id === '1');
    assert.ok(xyz.every((value, k) => Math.abs(value / scale - wanted[k]) < 1e-7), `${xyz} ${first.unit}`);
    await go(page, 'photos');
    assert.match(await page.textContent('[data-assumed=LocalSystem]'), /37\.5035°/);
    // The next list has the same origin, though its mean is elsewhere.
    await drop(page, [scratch('more.csv', 'id,lat,lon,h\n9,37.6,127.1,30\n')]);
    await sheet(page);
    assert.match(await understood(page), /decimal degrees.*latitude 37\.5035°.*that of the project/);
    assert.equal(await page.$('[data-system]'), null);
    await take(page).click();
    await page.waitForFunction(() => location.hash === '#control');
    const second = await saved(page);
    assert.deepEqual([second.origin.files, second.origin.local_system], [['gnss.csv', 'more.csv'], system]);
    assert.ok(second.points.find(({ id }) => id === '9').xyz[1] / scale > 10_000);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('files for spreadsheets, CAD and surveyors are offered', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page);
    await page.evaluate(() => (location.hash = '#files'));
    await page.waitForSelector('[data-export=spreadsheet]');
    const given = async (format, names) => downloads(page, names, () => page.click(`[data-export=${format}]`));
    const tables = await given('spreadsheet', ['points']);
    assert.deepEqual([...Object.entries(tables).find(([name]) => name.includes('points'))[1].subarray(0, 3)], [0xef, 0xbb, 0xbf]);
    assert.match(String(Object.values(await given('landxml', 1))[0]), /<LandXML/);
    assert.match(String(Object.values(await given('dxf-2010', 1))[0]), /\$INSUNITS/);
    const record = await given('calibration', ['calibration.json']);
    assert.ok(Object.keys(record).some((name) => name.endsWith('calibration.json')));
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});

test('a project that names the north first shows, takes and writes N, E, H', longer, async () => {
  const { page, errors, close } = await open({ width: 1366, height: 768 });
  try {
    await opened(page);
    await go(page, 'photos');
    await drop(page, [scratch('north.csv', '점명,X(N) [m],Y(E) [m],Z(H) [m]\nP1,5000.25,3000.5,31.125\nP2,5001.25,3002.5,31.5\n')]);
    await sheet(page);
    // The list says its axes, and the sheet how the project will be shown.
    assert.equal(await page.inputValue('[name=list-shown-axes]'), 'neh');
    assert.deepEqual(await page.$$eval('.import .preview th', (all) => all.map((th) => th.textContent.trim()).slice(2, 5)), ['N m', 'E m', 'H m']);
    await take(page).click();
    await page.waitForFunction(() => location.hash === '#control');
    assert.equal(await page.inputValue('[name=axes]'), 'neh');
    assert.equal(await page.getAttribute('#paste', 'placeholder'), 'Paste rows here: id, N, E, H, sN, sE, sH');
    // The first field of a row is the northing: typed, it is the second coordinate inside.
    await page.fill('[aria-label="P1 N"]', '5000.75');
    await page.press('[aria-label="P1 N"]', 'Enter');
    await page.fill('[aria-label="P1 σ N"]', '0.002');
    await page.press('[aria-label="P1 σ N"]', 'Enter');
    const first = await saved(page);
    const point = first.points.find(({ id }) => id === 'P1');
    assert.deepEqual([first.axes, point.xyz, point.sigma], ['neh', [3000.5, 5000.75, 31.125], [null, 0.002, null]]);
    // A list of distances, dropped: one end is not there.
    await drop(page, [scratch('bars.csv', 'from,to,length [mm],sigma [mm]\nP1,P2,2272,0.5\nP1,Q,100,0.5\n')]);
    const bars = '.import[data-distances]';
    await page.waitForSelector(bars);
    assert.deepEqual(await page.$$eval(`${bars} .preview tbody tr`, (all) => all.map((row) => row.lastElementChild.textContent.trim())), ['new', 'not imported: the project has no point Q']);
    await page.click(`${bars} .button.primary`);
    await page.waitForFunction(() => /1 distance imported.*Distances to Q were not imported/.test(document.body.textContent));
    const { distances } = await saved(page);
    assert.ok(Math.abs(distances[0].length - 2.272) < 1e-12 && distances.length === 1);
    // Without a heading, with thousands or thousandths and no standard errors: each is asked, and nothing is lost meanwhile.
    await go(page, 'photos');
    await drop(page, [scratch('tape.txt', 'P1;P2;2,273\n')]);
    await page.waitForSelector(`.import-over ${bars}`);
    assert.match(await page.textContent(bars), /from, to, length, standard error/);
    assert.ok(await page.isDisabled(`${bars} .button.primary`));
    await page.click(`${bars} [data-asked=decimal] button >> nth=0`);
    assert.match(await page.textContent(`${bars} [data-asked=sigma]`), /1 length has no standard error/);
    assert.match(await page.textContent(`${bars} [data-assumed=unit]`), /m, the unit of the project, is assumed/);
    await page.fill('[name=distances-sigma]', '1 mm + 100 ppm');
    await page.press('[name=distances-sigma]', 'Enter');
    await page.waitForFunction((bars) => /replaces 2\.272/.test(document.querySelector(bars).textContent), bars);
    assert.equal(await page.inputValue('[name=distances-unit]'), 'm');
    await page.click(`${bars} .button.primary`);
    await page.waitForFunction(() => location.hash === '#control' && /1 earlier distance replaced/.test(document.body.textContent));
    const again = (await saved(page)).distances;
    assert.equal(again.length, 1);
    assert.ok(Math.abs(again[0].length - 2.273) < 1e-12 && Math.abs(again[0].sigma - 0.0012273) < 1e-12);
    // Two lists of one drop are shown one after the other; the first is discarded.
    const one = (length) => `from,to,length [mm],sigma [mm]\nP1,P2,${length},0.5\n`;
    await drop(page, [scratch('first.csv', one(2280)), scratch('second.csv', one(2290))]);
    await page.waitForFunction((bars) => /first\.csv/.test(document.querySelector(bars)?.textContent), bars);
    await page.waitForFunction(() => /Shown when this list is imported or discarded: second\.csv/.test(document.body.textContent));
    await page.click(`${bars} button.link`);
    await page.waitForFunction((bars) => /second\.csv/.test(document.querySelector(bars)?.textContent), bars);
    await page.click(`${bars} .button.primary`);
    await page.waitForFunction(() => /second\.csv: 1 distance imported/.test(document.body.textContent));
    assert.ok(Math.abs((await saved(page)).distances[0].length - 2.29) < 1e-12);
    assert.deepEqual(errors, []);
  } finally {
    await close();
  }
});
