// The page in other browsers than Chromium, as far as the journey of the sample needs it: opened, asked what it shows, told what to do.
// Firefox by its own Marionette, WebKit by its driver; nothing from npm. `firefox()` and `webkit()` give nothing where they are missing.
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const which = (name) => (process.env.PATH ?? '').split(':').map((folder) => join(folder, name)).find(existsSync);
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

/** A port that nobody has. */
const freePort = () =>
  new Promise((done) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });

/** Tries again until it works: a program that was started just now is not there yet. */
async function patiently(work) {
  for (let attempt = 0; ; attempt++) {
    try {
      return await work();
    } catch (error) {
      if (attempt === 150) throw error;
      await pause(200);
    }
  }
}

/** A program with a folder of its own; both go with `end`. */
function started(program, options, environment = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'sightline-browser-'));
  const process_ = spawn(program, options(folder), { stdio: 'ignore', env: { ...process.env, ...environment, HOME: folder, XDG_RUNTIME_DIR: folder }, detached: true });
  const end = async () => {
    // With what it has started itself.
    for (const signal of ['SIGTERM', 'SIGKILL']) {
      try {
        process.kill(-process_.pid, signal);
      } catch {
        // It has ended.
      }
      await pause(500);
    }
    rmSync(folder, { recursive: true, force: true, maxRetries: 10, retryDelay: 200 });
  };
  return { folder, end };
}

/** Interface of a page for its driver: `run` calls a function there with JSON arguments and waits for its promise. */
function page(command, end) {
  const run = async (work, ...given) => {
    const script = `const [given, done] = arguments; Promise.resolve((${work})(...given)).then((value) => done({ value }), (error) => done({ error: String(error) }));`;
    const { value, error } = await command('executeAsync', { script, args: [given] });
    if (error) throw new Error(error);
    return value;
  };
  /** Waits until a function gives something. */
  const until = async (work, seconds, ...given) => {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end; await pause(200)) {
      const value = await run(work, ...given);
      if (value) return value;
    }
    throw new Error(`not within ${seconds} s: ${work}\n${await run(() => document.body?.innerText)}`);
  };
  return { goto: (url) => command('navigate', { url }), run, until, close: end };
}

/** Marionette: each message with its length before it; an answer carries the number of its question. */
async function marionette(port) {
  const socket = await new Promise((done, failed) => {
    const socket = connect(port, '127.0.0.1', () => done(socket));
    socket.once('error', failed);
  });
  let buffer = Buffer.alloc(0);
  const waiting = new Map();
  socket.on('data', (data) => {
    buffer = Buffer.concat([buffer, data]);
    for (;;) {
      const colon = buffer.indexOf(':');
      const length = Number(buffer.subarray(0, colon));
      if (colon < 0 || buffer.length < colon + 1 + length) return;
      const message = JSON.parse(buffer.subarray(colon + 1, colon + 1 + length));
      buffer = buffer.subarray(colon + 1 + length);
      // The first one is a greeting.
      if (Array.isArray(message)) waiting.get(message[1])?.(message);
    }
  });
  let number = 0;
  return {
    end: () => socket.destroy(),
    command: (name, parameters) =>
      new Promise((done, failed) => {
        const text = JSON.stringify([0, ++number, `WebDriver:${name}`, parameters]);
        waiting.set(number, ([, , error, result]) => (error ? failed(new Error(`${name}: ${error.message}`)) : done(result)));
        socket.write(`${Buffer.byteLength(text)}:${text}`);
      }),
  };
}

/** Firefox without a window. */
export async function firefox() {
  const program = which('firefox-esr') ?? which('firefox');
  if (!program) return null;
  const port = await freePort();
  const options = (profile) => {
    writeFileSync(join(profile, 'user.js'), `user_pref("marionette.port", ${port});\nuser_pref("app.update.enabled", false);\nuser_pref("datareporting.policy.dataSubmissionEnabled", false);\n`);
    return ['--headless', '--no-remote', '--marionette', '--profile', profile];
  };
  const { end } = started(program, options);
  try {
    const driver = await patiently(() => marionette(port));
    const close = async () => {
      driver.end();
      await end();
    };
    await driver.command('NewSession', { capabilities: {} });
    await driver.command('SetTimeouts', { script: 60_000, pageLoad: 120_000 });
    const commands = {
      navigate: (parameters) => driver.command('Navigate', parameters),
      executeAsync: async (parameters) => (await driver.command('ExecuteAsyncScript', parameters)).value,
    };
    return page((name, parameters) => commands[name](parameters), close);
  } catch (error) {
    await end();
    throw error;
  }
}

/** WebKit's own small browser, on a screen that nobody sees. */
export async function webkit() {
  const driver = which('WebKitWebDriver');
  const screen = which('Xvfb');
  const binary = miniBrowser();
  if (!driver || !screen || !binary) return null;
  const display = `:${90 + (process.pid % 900)}`;
  const shown = started(screen, () => [display, '-screen', '0', '1366x900x24', '-nolisten', 'tcp']);
  const port = await freePort();
  const driving = started(driver, () => [`--port=${port}`], { DISPLAY: display, WEBKIT_DISABLE_COMPOSITING_MODE: '1', LIBGL_ALWAYS_SOFTWARE: '1' });
  const end = async () => {
    await driving.end();
    await shown.end();
  };
  const ask = async (path, body) => {
    const answer = await fetch(`http://127.0.0.1:${port}${path}`, { method: 'POST', body: JSON.stringify(body), headers: { 'content-type': 'application/json' } });
    const { value } = await answer.json();
    if (!answer.ok) throw new Error(`${path}: ${value?.message ?? value?.error}`);
    return value;
  };
  try {
    const capabilities = { alwaysMatch: { browserName: 'MiniBrowser', 'webkitgtk:browserOptions': { binary, args: ['--automation'] } } };
    const { sessionId } = await patiently(() => ask('/session', { capabilities }));
    await ask(`/session/${sessionId}/timeouts`, { script: 60_000, pageLoad: 120_000 });
    const paths = { navigate: 'url', executeAsync: 'execute/async' };
    return page((name, parameters) => ask(`/session/${sessionId}/${paths[name]}`, parameters), end);
  } catch (error) {
    await end();
    throw error;
  }
}

/** Where Debian and others have it. */
function miniBrowser() {
  const folders = ['/usr/lib', '/usr/libexec'].filter(existsSync).flatMap((root) => [root, ...readdirSync(root).map((name) => join(root, name))]);
  const names = ['webkit2gtk-4.1', 'webkit2gtk-4.0', 'webkitgtk-6.0'];
  return which('MiniBrowser') ?? folders.flatMap((folder) => names.map((name) => join(folder, name, 'MiniBrowser'))).find(existsSync);
}
