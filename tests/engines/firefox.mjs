// Firefox, by Marionette: WebDriver's commands as JSON over a socket, which is how geckodriver drives it too. No driver is needed.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import path from 'node:path';
import { root } from '../../scripts/lib/env.mjs';
import { start, until } from './processes.mjs';

const START_MS = 60_000;

const PREFERENCES = {
  'marionette.port': 0, // any that is free; it is told in a file
  'dom.webgpu.enabled': true,
  'gfx.webgpu.ignore-blocklist': true, // Mesa's software device is on it
  'layout.css.devPixelsPerPx': '1.0',
  'layout.css.prefers-color-scheme.content-override': 1, // light
};

/** See `engines.mjs` for what an engine offers. */
export async function openFirefox(program, { env, timeoutMs }) {
  // Not in the system's folder for such things, which a Firefox from a snap does not see.
  const cache = path.join(root, '.cache');
  mkdirSync(cache, { recursive: true });
  const profile = mkdtempSync(path.join(cache, 'firefox-'));
  const lines = Object.entries(PREFERENCES).map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`);
  writeFileSync(path.join(profile, 'user.js'), lines.join(''));
  // WebGL2 is not to be had in its headless mode.
  const browser = start(program, ['--marionette', '--no-remote', '--profile', profile], { env, scratch: profile });
  let socket;
  const close = async () => {
    socket?.destroy();
    await browser.stop();
  };
  try {
    let hasEnded = false;
    void browser.ended.then(() => (hasEnded = true));
    const port = await until(
      () => {
        if (hasEnded) throw new Error(`Firefox ended: ${browser.said()}`);
        return activePort(profile);
      },
      'Starting Firefox',
      START_MS,
    );
    socket = connect(port, '127.0.0.1');
    const send = marionette(socket);
    const { capabilities } = await send('WebDriver:NewSession', { timeouts: { script: timeoutMs, pageLoad: timeoutMs } });
    return {
      version: capabilities.browserVersion,
      go: (url) => send('WebDriver:Navigate', { url }),
      evaluate: async (expression) => {
        // Without a sandbox: the page's own globals are asked for.
        const { value } = await send('WebDriver:ExecuteScript', { script: `return ${expression}`, args: [], sandbox: null });
        return value;
      },
      screenshot: async () => Buffer.from((await send('WebDriver:TakeScreenshot', { full: false })).value, 'base64'),
      complaints: () => [],
      close,
    };
  } catch (error) {
    await close();
    throw error;
  }
}

function activePort(profile) {
  const file = path.join(profile, 'MarionetteActivePort');
  return (existsSync(file) && Number(readFileSync(file, 'utf8'))) || undefined;
}

/**
 * Commands over a socket: `send(name, parameters)` resolves with the result.
 *
 * A message is its length in bytes, a colon and JSON: `[0, id, name, parameters]` there, `[1, id, error, result]` back. The first
 * one is a greeting.
 */
export function marionette(socket) {
  const waiting = new Map();
  let last = 0;
  let received = Buffer.alloc(0);
  socket.on('data', (data) => {
    received = Buffer.concat([received, data]);
    for (;;) {
      const colon = received.indexOf(':');
      const end = colon + 1 + Number(received.toString('latin1', 0, colon));
      if (colon < 0 || received.length < end) return;
      const message = JSON.parse(received.toString('utf8', colon + 1, end));
      received = received.subarray(end);
      if (Array.isArray(message)) settle(...message.slice(1));
    }
  });
  const settle = (id, error, result) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error) reject(new Error(`${error.error}: ${error.message}`));
    else resolve(result);
  };
  const fail = (error) =>
    waiting.forEach(({ reject }) => reject(new Error(`Firefox is gone${error?.message ? `: ${error.message}` : ''}`)));
  socket.on('error', fail);
  socket.on('close', fail);
  return (name, parameters) =>
    new Promise((resolve, reject) => {
      waiting.set(++last, { resolve, reject });
      const message = JSON.stringify([0, last, name, parameters]);
      socket.write(`${Buffer.byteLength(message)}:${message}`);
    });
}
