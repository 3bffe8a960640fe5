// Large RAW and HEIC photos from bytes to targets, as wasm in Node on one thread: time, and the memory of both modules.
//   cargo run --release --package sightline-codecs --example large -- FOLDER; cargo xtask build; node benches/codecs.mjs FOLDER [rounds]
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [folder, rounds = '5', one] = process.argv.slice(2);

if (one) {
  // A process of its own, as a worker would meet the photo first.
  const memories = [];
  const { Instance } = WebAssembly;
  WebAssembly.Instance = function (module, imports) {
    const instance = new Instance(module, imports);
    if (instance.exports.memory) memories.push(instance.exports.memory);
    return instance;
  };
  const sightline = await import('../pkg/sightline.js');
  sightline.initSync({ module: readFileSync(new URL('../pkg/sightline_bg.wasm', import.meta.url)) });
  sightline.initCodecsSync(readFileSync(new URL('../pkg/codecs_bg.wasm', import.meta.url)));
  const bytes = readFileSync(join(folder, one));
  const times = [];
  let targets = 0;
  for (let k = 0; k < 2; k++) {
    const began = performance.now();
    targets = sightline.detect(bytes).targets.length;
    times.push(performance.now() - began);
  }
  const began = performance.now();
  sightline.photoInfo(bytes);
  const info = performance.now() - began;
  const memory = memories.reduce((sum, { buffer }) => sum + buffer.byteLength, 0);
  console.log(JSON.stringify({ first: times[0], second: times[1], info, targets, memory }));
  process.exit();
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
for (const name of ['large.dng', 'large.heic']) {
  const runs = Array.from({ length: Number(rounds) }, () => {
    const { stdout, stderr } = spawnSync(process.execPath, [fileURLToPath(import.meta.url), folder, '1', name], { encoding: 'utf8' });
    if (!stdout) throw new Error(stderr);
    return JSON.parse(stdout);
  });
  const of = (key) => median(runs.map((run) => run[key]));
  const best = Math.min(...runs.map((run) => run.second));
  console.log(`${name}: ${of('targets')} targets; first call ${of('first').toFixed(0)} ms, second ${of('second').toFixed(0)} ms (best ${best.toFixed(0)}), header ${of('info').toFixed(1)} ms, memory ${(of('memory') / 1e6).toFixed(0)} MB`);
}
