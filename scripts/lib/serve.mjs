// A static file server for dist/, for `npm start` and the browser tests. Node built-ins only.
import { once } from 'node:events';
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import path from 'node:path';

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.mjs': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.json': 'application/json',
  '.map': 'application/json',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.webmanifest': 'application/manifest+json',
};

/**
 * Serves a folder; resolves to `{ url, port, close }` once it listens.
 *
 * `port` 0 takes any free one; another that is taken moves on to the next. `intercept(request, response)` may answer a request
 * itself and return true: tests break files with it. `host` is this machine alone unless told otherwise.
 *
 * @typedef {import('node:http').IncomingMessage & { url: string }} Request with an address, as every server hears it
 * @typedef {(request: Request, response: import('node:http').ServerResponse) => unknown} Intercept
 * @param {string} folder
 * @param {{ port?: number, host?: string, intercept?: Intercept }} [options]
 */
export async function serve(folder, { port = 0, host = '127.0.0.1', intercept } = {}) {
  const server = createServer(async (request, response) => {
    try {
      if (await intercept?.(/** @type {Request} */ (request), response)) return;
      await answer(path.resolve(folder), request, response);
    } catch (error) {
      response.writeHead(500).end(String(error));
    }
  });
  const taken = await listen(server, port, host);
  return {
    port: taken,
    url: `http://${host === '127.0.0.1' || host === '0.0.0.0' ? 'localhost' : host}:${taken}/`,
    close: () =>
      new Promise((resolve) => {
        server.close(resolve);
        server.closeAllConnections();
      }),
  };
}

/** Answers with the file of `folder` that a request is for. */
export async function answer(folder, request, response) {
  if (request.method !== 'GET' && request.method !== 'HEAD') return void response.writeHead(405, { allow: 'GET, HEAD' }).end();
  let name;
  try {
    name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  } catch {
    return void response.writeHead(400).end();
  }
  const file = path.join(folder, name.endsWith('/') ? `${name}index.html` : name);
  if (!file.startsWith(folder + path.sep) || name.includes('\0')) return void response.writeHead(403).end();
  let body;
  try {
    body = await readFile(file);
  } catch {
    return void response.writeHead(404, { 'content-type': 'text/plain', 'cache-control': 'no-cache' }).end(`not found: ${name}\n`);
  }
  response.writeHead(200, {
    'content-type': TYPES[path.extname(file)] ?? 'application/octet-stream',
    'content-length': body.length,
    // A rebuild must be seen at the next reload.
    'cache-control': 'no-cache',
  });
  response.end(request.method === 'HEAD' ? undefined : body);
}

/**
 * @param {import('node:http').Server} server
 * @returns {Promise<number>} the port
 */
async function listen(server, port, host) {
  for (let candidate = port; ; candidate++) {
    try {
      server.listen(candidate, host);
      // An error instead rejects.
      await once(server, 'listening');
      return /** @type {import('node:net').AddressInfo} */ (server.address()).port;
    } catch (error) {
      if (/** @type {NodeJS.ErrnoException} */ (error).code !== 'EADDRINUSE' || candidate === 0 || candidate >= port + 100) throw error;
    }
  }
}
