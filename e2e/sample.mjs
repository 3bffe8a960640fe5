// The sample project as a file, for the tests that begin with it: node e2e/sample.mjs FILE
import { writeFileSync } from 'node:fs';

import { open } from './browser.mjs';
import { downloads, idle, madeSample } from './desk.mjs';

const { page, errors, close } = await open();
try {
  await madeSample(page);
  await idle(page);
  const saved = await downloads(page, 1, () => page.getByRole('button', { name: 'Save with photos', exact: true }).click());
  writeFileSync(process.argv[2], Object.values(saved)[0]);
  if (errors.length) throw new Error(errors.join('\n'));
} finally {
  await close();
}
