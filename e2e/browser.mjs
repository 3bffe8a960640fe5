// Opens the page in a headless browser. `cargo xtask test page` builds and serves the page, and sets its folder, its address and the browser.
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { chromium } from 'playwright-core';

/** The folder of the page. */
export const dist = process.env.SIGHTLINE_DIST || fileURLToPath(new URL('../dist', import.meta.url));

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--enable-unsafe-swiftshader',
  // A host name that is not local for the browser, so that plain HTTP is not a secure context, as on a phone in a local network.
  '--host-resolver-rules=MAP insecure.test 127.0.0.1',
];

/** The page's address over plain HTTP, without a secure context: no locks, no private file system, no service worker. */
export const plainHttp = () => process.env.SIGHTLINE_URL.replace(/127\.0\.0\.1|localhost/, 'insecure.test');

/**
 * Opens the page in a new browser profile. Errors that the page logs or throws are in `errors`. `cores` is the number of processors that
 * the page sees, which decides how many workers it starts. Closing fails if the page has requested anything from another host, or has
 * violated its Content-Security-Policy.
 */
export async function open({ width = 1440, height = 900, cores, address, ...options } = {}) {
  const { SIGHTLINE_URL: served, CHROMIUM: program } = process.env;
  const url = address ?? served;
  if (!url || !program) throw new Error('run these tests with: cargo xtask test page');
  const executablePath = program.includes('/') ? program : which(program);
  const profile = mkdtempSync(join(tmpdir(), 'sightline-'));
  const context = await chromium.launchPersistentContext(profile, { executablePath, headless: true, args: FLAGS, viewport: { width, height }, acceptDownloads: true, ...options });
  const trespasses = [];
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
    if (trespasses.length) throw new Error(trespasses.join('\n'));
  };
  const errors = [];
  context.on('request', (request) => {
    const asked = request.url();
    if (!asked.startsWith(new URL('./', url).href) && !/^(blob|data|about):/.test(asked)) trespasses.push(`a request to ${asked}`);
  });
  context.on('console', (message) => /Content.Security.Policy/i.test(message.text()) && trespasses.push(message.text()));
  if (cores) await context.addInitScript((n) => Object.defineProperty(Navigator.prototype, 'hardwareConcurrency', { get: () => n }), cores);
  const page = context.pages()[0] ?? (await context.newPage());
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  try {
    await page.goto(url);
  } catch (error) {
    // A browser left open would keep the whole run from ending.
    await close();
    throw error;
  }
  return { page, context, errors, url, profile, close };
}

/** The page in a private window: all that it keeps is gone when it is closed. */
export async function openPrivately({ width = 1440, height = 900 } = {}) {
  const { SIGHTLINE_URL: url, CHROMIUM: program } = process.env;
  const browser = await chromium.launch({ executablePath: program.includes('/') ? program : which(program), headless: true, args: FLAGS });
  const page = await (await browser.newContext({ viewport: { width, height }, acceptDownloads: true })).newPage();
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  await page.goto(url);
  return { page, errors, close: () => browser.close() };
}

/** The processes of the browser with a profile: their numbers and command lines. */
export function processes(profile) {
  const all = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const parent = Number(/^\d+ \(.*\) \S (\d+)/s.exec(readFileSync(`/proc/${pid}/stat`, 'utf8'))[1]);
      all.set(Number(pid), { parent, command: readFileSync(`/proc/${pid}/cmdline`, 'utf8') });
    } catch {
      // It has ended meanwhile.
    }
  }
  const ours = (pid) => {
    for (let at = all.get(pid); at; at = all.get(at.parent)) if (at.command.includes(profile)) return true;
    return false;
  };
  return [...all].filter(([pid]) => ours(pid)).map(([pid, { command }]) => ({ pid, command }));
}

/** Kills what draws the pages of a browser, as the system does when memory runs out: nothing in the page gets another word. */
export function killRenderers(profile) {
  const renderers = processes(profile).filter(({ command }) => command.includes('--type=renderer'));
  for (const { pid } of renderers) process.kill(pid, 'SIGKILL');
  return renderers.length;
}

/** Where a program lies on the path. */
function which(name) {
  for (const folder of (process.env.PATH ?? '').split(':')) {
    const file = join(folder, name);
    if (existsSync(file)) return file;
  }
  return name;
}
