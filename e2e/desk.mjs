// What the tests of the desk share: real data in place, dropping files on the page, the steps of the path.
import { existsSync, mkdtempSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { inflateRawSync } from 'node:zlib';

const root = process.env.SIGHTLINE_DATA ?? fileURLToPath(new URL('../../shared/data', import.meta.url));

/** A folder of the real data, or nothing where the data is absent. */
export function data(name) {
  const folder = join(root, name);
  return existsSync(folder) ? folder : undefined;
}

/** The files of a folder with one ending, in the order of their names. */
export function files(folder, ending) {
  const names = readdirSync(folder).filter((name) => name.toLowerCase().endsWith(ending));
  return names.sort().map((name) => join(folder, name));
}

/** A file with this content, under its own name. */
export function scratch(name, content) {
  const file = join(mkdtempSync(join(tmpdir(), 'sightline-file-')), name);
  writeFileSync(file, content);
  return file;
}

/** Drops files on the page, as a person does. */
export async function drop(page, paths) {
  await page.waitForSelector('.desk');
  await page.evaluate(() => {
    const input = Object.assign(document.createElement('input'), { type: 'file', multiple: true, id: 'dropped', hidden: true });
    document.body.append(input);
  });
  await page.setInputFiles('#dropped', paths);
  await page.evaluate(() => {
    const input = document.getElementById('dropped');
    const dataTransfer = new DataTransfer();
    for (const file of input.files) dataTransfer.items.add(file);
    input.remove();
    document.querySelector('.desk').dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  });
}

/** Loads the page anew at its start: from any other place it would return to the project that is open. */
export async function afresh(page) {
  await page.evaluate(() => history.replaceState(null, '', '#start'));
  return page.reload();
}

/** Downloads the project file by the menu of files, with the photos in it or without. */
export async function save(page, photos = true) {
  await page.click('[data-action=file]');
  await page.click(`[data-file=${photos ? 'save-all' : 'save'}]`);
}

/** Waits until everything is in the browser's storage. */
export const written = (page) => page.waitForFunction(() => /^saved \d/.test(document.querySelector('.project span')?.textContent), undefined, { timeout: 60_000 });

/** A project file with nothing but a name. */
export const named = (name) => scratch(`${name}.json`, JSON.stringify({ format: 'sightline', version: 1, name }));

/** Names of the projects in the list of the start page. */
export const listed = (page) => page.$$eval('[data-project] .name', (all) => all.map((one) => one.textContent));

/** Waits until the list has exactly these. */
export const waitForList = (page, wanted) =>
  page.waitForFunction((list) => JSON.stringify([...document.querySelectorAll('[data-project] .name')].map((one) => one.textContent).sort()) === list, JSON.stringify([...wanted].sort()), { timeout: 30_000 });

/** Presses one of the further buttons of a project in the list. */
export async function verb(page, name, label) {
  const row = page.locator(`tr[data-project]:has(.name:text-is("${name}"))`);
  const button = page.locator(`tr[data-project]:has(.name:text-is("${name}")) + tr.verbs`).getByRole('button', { name: label, exact: true });
  // The list may be read anew between the two clicks, which closes the row of verbs.
  for (let tries = 0; ; tries++) {
    try {
      if ((await row.locator('.icon-button').getAttribute('aria-expanded', { timeout: 3000 })) !== 'true') await row.locator('.icon-button').click({ timeout: 3000 });
      return await button.click({ timeout: 3000 });
    } catch (error) {
      if (tries === 5) throw error;
    }
  }
}

/** Waits until a window has its project for itself. */
export const owns = (page, timeout = 30_000) => page.waitForFunction(() => !/read-only/.test(document.querySelector('.project span')?.textContent), undefined, { timeout });

/** Opens a project of the list. */
export async function goOn(page, name) {
  await page.locator(`tr[data-project]:has(.name:text-is("${name}")) .do .button`).first().click();
  await page.waitForFunction((wanted) => document.querySelector('.project-name')?.value === wanted, name, { timeout: 30_000 });
}

/** Gives the open project another name: a change that is written at once. */
export async function rename(page, name) {
  await page.fill('.project-name', name);
  await page.press('.project-name', 'Enter');
}

/** Goes to a step of the path. */
export const go = (page, step) => page.click(`[data-step=${step}]`);

/** Drops photos and waits until they are taken. */
export async function photos(page, paths) {
  await drop(page, paths);
  await page.waitForFunction(() => location.hash === '#photos', undefined, { timeout: 120_000 });
  await idle(page);
}

/** The sample project, opened and adjusted. */
export async function sample(page) {
  await page.click('.sample');
  await page.waitForFunction(() => location.hash === '#results', undefined, { timeout: 300_000 });
  // Its parts are drawn one after the other.
  await page.waitForSelector('.results[data-whole]');
}

/** Waits until no long work is under way. */
export async function idle(page, timeout = 300_000) {
  await page.waitForTimeout(100);
  await page.waitForSelector('.progress', { state: 'detached', timeout });
}

/** Detects targets with the options given by the values of their choices. */
export async function detect(page, options) {
  await go(page, 'targets');
  await page.$eval('details.options', (options) => (options.open = true));
  for (const [name, label] of Object.entries(options)) await page.selectOption(`select[name=${name}]`, { label });
  await page.click('[data-action=detect]');
  await idle(page);
}

/** Adjusts and shows the results. */
export async function adjust(page) {
  await go(page, 'adjust');
  await page.click('.action .button');
  await idle(page);
  await go(page, 'results');
}

/** A number as the page shows it. */
export const number = (text) => Number(text.replaceAll(/[\u2009\s]/g, '').replaceAll('−', '-'));

/** A figure of the result: sigma0, redundancy, rms-px. */
export const figure = async (page, name) => number(await page.textContent(`[data-result=${name}]`));

/** An estimated camera parameter: value and standard error in the unit's own power of ten. */
export async function parameter(page, camera, name) {
  const cells = await page.$$eval(`tr[data-camera="${camera}"][data-parameter=${name}] td`, (all) => all.map((cell) => cell.textContent));
  return { value: number(cells[1]), sigma: number(cells[2]), unit: cells[3] };
}

/** Text of the notice row. */
export const notice = (page) => page.textContent('.notice p');

/** Files that a click hands over, by name: so many, or until the name of one has each of these words. */
export async function downloads(page, wanted, click) {
  const seen = [];
  const listen = (download) => seen.push(download);
  const there = () => (Array.isArray(wanted) ? wanted.every((word) => seen.some((one) => one.suggestedFilename().includes(word))) : seen.length >= wanted);
  page.on('download', listen);
  await click();
  for (let i = 0; i < 1200 && !there(); i++) await page.waitForTimeout(50);
  page.off('download', listen);
  const all = {};
  for (const download of seen) all[download.suggestedFilename()] = readFileSync(await download.path());
  return all;
}

/** The files of an archive, by its directory. */
export function unzipped(zip) {
  const files = {};
  const end = zip.lastIndexOf(Buffer.from([0x50, 0x4b, 5, 6]));
  let at = zip.readUInt32LE(end + 16);
  for (let i = 0; i < zip.readUInt16LE(end + 10); i++) {
    const [method, size, name, extra, comment] = [zip.readUInt16LE(at + 10), zip.readUInt32LE(at + 20), ...[28, 30, 32].map((k) => zip.readUInt16LE(at + k))];
    const local = zip.readUInt32LE(at + 42);
    const start = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
    const content = zip.subarray(start, start + size);
    files[zip.toString('utf8', at + 46, at + 46 + name)] = method === 0 ? content : inflateRawSync(content);
    at += 46 + name + extra + comment;
  }
  return files;
}

/** Rows of a CSV file with a heading; none of our fields holds a comma. */
export function rows(text) {
  const [heading, ...lines] = String(text).trim().split(/\r?\n/).map((line) => line.split(','));
  return lines.map((line) => Object.fromEntries(heading.map((name, i) => [name, line[i]])));
}

/** Where points fall in a photo, from the exported tables alone: a plain second projection, to check names against. */
export function predicted(photo, cameras, { width, height }) {
  const value = (name) => Number(cameras.find((row) => row.camera === photo.camera && row.parameter === name).value);
  const [c, x0, y0, k1, k2, k3, p1, p2, b1, b2] = ['c', 'x0', 'y0', 'k1', 'k2', 'k3', 'p1', 'p2', 'b1', 'b2'].map(value);
  const [o, p, k] = ['omega [deg]', 'phi [deg]', 'kappa [deg]'].map((name) => (Number(photo[name]) * Math.PI) / 180);
  const [so, co, sp, cp, sk, ck] = [Math.sin(o), Math.cos(o), Math.sin(p), Math.cos(p), Math.sin(k), Math.cos(k)];
  const m = [
    [cp * ck, so * sp * ck + co * sk, -co * sp * ck + so * sk],
    [-cp * sk, -so * sp * sk + co * ck, co * sp * sk + so * ck],
    [sp, -so * cp, co * cp],
  ];
  const axes = Object.keys(photo).filter((name) => /^[XYZ] \[/.test(name));
  return (point) => {
    const d = axes.map((name) => Number(point[name]) - Number(photo[name]));
    const [x, y, z] = m.map((row) => row[0] * d[0] + row[1] * d[1] + row[2] * d[2]);
    if (z >= 0) return [NaN, NaN];
    const ideal = [(-c * x) / z, (-c * y) / z];
    let [a, b] = ideal;
    for (let i = 0; i < 50; i++) {
      const r2 = a * a + b * b;
      const radial = r2 * (k1 + r2 * (k2 + r2 * k3));
      [a, b] = [
        ideal[0] - (a * radial + p1 * (r2 + 2 * a * a) + 2 * p2 * a * b + b1 * a + b2 * b),
        ideal[1] - (b * radial + p2 * (r2 + 2 * b * b) + 2 * p1 * a * b),
      ];
    }
    return [width / 2 + x0 + a, height / 2 - (y0 + b)];
  };
}

/** Rms per axis that is left after the best similarity transform of points onto others. */
export function similarityRms(from, to) {
  const mean = (points) => [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const [a, b] = [mean(from), mean(to)];
  const x = from.map((p) => p.map((v, k) => v - a[k]));
  const y = to.map((p) => p.map((v, k) => v - b[k]));
  const cross = [0, 1, 2].map((i) => [0, 1, 2].map((j) => x.reduce((sum, p, n) => sum + y[n][i] * p[j], 0)));
  const rotation = nearestRotation(cross);
  const turned = x.map((p) => rotation.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2]));
  const dot = (p, q) => p.reduce((sum, row, n) => sum + row[0] * q[n][0] + row[1] * q[n][1] + row[2] * q[n][2], 0);
  const scale = dot(turned, y) / dot(turned, turned);
  const squares = [0, 1, 2].map((k) => turned.reduce((sum, p, n) => sum + (scale * p[k] - y[n][k]) ** 2, 0));
  return { scale, rms: squares.map((sum) => Math.sqrt(sum / from.length)) };
}

/** The rotation that turns most along a correlation matrix, by Horn's quaternion and power iteration. */
function nearestRotation(m) {
  const n = [
    [m[0][0] + m[1][1] + m[2][2], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]],
    [0, m[0][0] - m[1][1] - m[2][2], m[1][0] + m[0][1], m[2][0] + m[0][2]],
    [0, 0, m[1][1] - m[0][0] - m[2][2], m[2][1] + m[1][2]],
    [0, 0, 0, m[2][2] - m[0][0] - m[1][1]],
  ];
  for (let i = 0; i < 4; i++) for (let j = 0; j < i; j++) n[i][j] = n[j][i];
  const shift = Math.max(...n.map((row) => row.reduce((sum, v) => sum + Math.abs(v), 0)));
  let q = [1, 0.1, 0.2, 0.3];
  for (let i = 0; i < 20_000; i++) {
    const next = n.map((row, k) => row.reduce((sum, v, j) => sum + v * q[j], 0) + shift * q[k]);
    const length = Math.hypot(...next);
    q = next.map((v) => v / length);
  }
  const [w, x, y, z] = q;
  return [
    [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
  ];
}

/** Shows the photo whole and clicks a place of it, in its pixels. */
export async function clickPhoto(page, [u, v], { width = 1632, height = 1224, modifiers, touch } = {}) {
  await page.click('.stage-button:not(.words)');
  const box = await page.locator('canvas.photo').boundingBox();
  const scale = Math.min(box.width / width, box.height / height);
  const x = box.x + (box.width - width * scale) / 2 + u * scale;
  const y = box.y + (box.height - height * scale) / 2 + v * scale;
  for (const key of modifiers ?? []) await page.keyboard.down(key);
  if (touch) await page.touchscreen.tap(x, y);
  else await page.mouse.click(x, y);
  for (const key of modifiers ?? []) await page.keyboard.up(key);
}

/** Chooses a point in the table of identities and gives where each photo has it: u, v and sigma by photo. */
export async function choosePoint(page, point) {
  await page.click(`.columns tr[data-key="${point}"]`);
  await page.waitForFunction((name) => document.querySelector('[name=point-name]')?.value === name, point);
  return places(page);
}

/** Where each photo has the chosen point. */
export async function places(page) {
  const rows = await page.$$eval('.panel.point tbody tr', (all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  return Object.fromEntries(rows.map(([photo, u, v, sigma]) => [photo, { u: number(u), v: number(v), sigma: number(sigma) }]));
}

/** Shows a photo and waits until it is drawn whole. */
export async function showPhoto(page, photo) {
  await page.click(`[data-photo="${photo}"]`);
  await page.click('.stage-button[aria-label="Fit"]');
  await page.waitForTimeout(300);
}
