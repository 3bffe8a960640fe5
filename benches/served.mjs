// A build of the page on loopback, for benches that drive it in a browser.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { gzipSync } from 'node:zlib';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml', '.webmanifest': 'application/manifest+json' };

/** Serves the folder of a build, compressed as static hosts do if asked, and has e2e/browser.mjs open it; the server, to be closed. */
export async function served(dist, { compressed = false } = {}) {
  const kept = new Map();
  const packed = (path) => kept.get(path) ?? kept.set(path, gzipSync(readFileSync(path))).get(path);
  const server = createServer((request, answer) => {
    const path = new URL(request.url, 'http://x').pathname;
    try {
      const file = join(dist, path === '/' ? 'index.html' : path);
      const body = compressed ? packed(file) : readFileSync(file);
      const encoding = compressed ? { 'content-encoding': 'gzip' } : {};
      answer.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'text/html', ...encoding }).end(body);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  process.env.SIGHTLINE_URL = `http://127.0.0.1:${server.address().port}/`;
  return server;
}
