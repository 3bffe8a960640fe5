// pkg/ as a package of npm: what it exports is there, and Node imports it by its name without a further step.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { pkg } from './engine.mjs';

const about = JSON.parse(readFileSync(join(pkg, 'package.json'), 'utf8'));

test('every file that package.json names is there, with the licences of others', () => {
  const named = (value) => (typeof value === 'string' ? [value] : Object.values(value).flatMap(named));
  const files = [...named(about.exports).filter((file) => !file.includes('*')), ...about.files.filter((file) => file !== 'snippets'), about.main, about.types];
  for (const file of files) assert.ok(existsSync(join(pkg, file)), file);
  const notices = readFileSync(join(pkg, 'THIRD-PARTY.txt'), 'utf8');
  for (const name of ['nalgebra ', 'wasm-bindgen ', 'Rust standard library']) assert.ok(notices.includes(`\n${name}`), name);
});

test('Node imports it by its name, ready to work', () => {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-package-'));
  try {
    mkdirSync(join(folder, 'node_modules'));
    symlinkSync(pkg, join(folder, 'node_modules/sightline'), 'junction');
    const script = "import { photoInfo, spreadCodes } from 'sightline'; console.log(typeof photoInfo, JSON.stringify(spreadCodes('ring-12')).length);";
    const told = execFileSync(process.execPath, ['--input-type=module', '-e', script], { cwd: folder, encoding: 'utf8' });
    assert.match(told, /^function [1-9]\d*\n$/);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
