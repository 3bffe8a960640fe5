// The page in a headless browser: `cargo xtask test page` serves dist/ and names its address and the browser.
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { chromium } from 'playwright-core';

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--enable-unsafe-swiftshader',
];

/**
 * A fresh browser on the page: nothing is left of other tests. What the page logs as an error or throws is in `errors`.
 * `cores` is what the page is told of the processor, which decides how many workers it starts.
 */
export async function open({ width = 1440, height = 900, cores, ...options } = {}) {
  const { SIGHTLINE_URL: url, CHROMIUM: program } = process.env;
  if (!url || !program) throw new Error('run these tests with: cargo xtask test page');
  const executablePath = program.includes('/') ? program : which(program);
  const profile = mkdtempSync(join(tmpdir(), 'sightline-'));
  const context = await chromium.launchPersistentContext(profile, { executablePath, headless: true, args: FLAGS, viewport: { width, height }, acceptDownloads: true, ...options });
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  };
  const errors = [];
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
  return { page, context, errors, url, close };
}

/** Where a program lies on the path. */
function which(name) {
  for (const folder of (process.env.PATH ?? '').split(':')) {
    const file = join(folder, name);
    if (existsSync(file)) return file;
  }
  return name;
}
