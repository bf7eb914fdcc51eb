// Programs started for the tests, with what they start themselves: none of them outlives this process.
import { spawn, spawnSync } from 'node:child_process';
import { rmSync } from 'node:fs';
import { createServer } from 'node:net';
import os from 'node:os';

const SAID_MAX = 2000;
const isWindows = process.platform === 'win32';

/** Each with what it leaves behind. */
const running = new Map();
let isGuarded = false;

/**
 * Starts a program in a process group of its own.
 *
 * `said()` is the end of what it wrote, for error messages; `ended` resolves when it is gone; `stop()` ends the whole group. The folder
 * `scratch` goes with it.
 *
 * @param {string} program
 * @param {string[]} args
 * @param {{ env?: NodeJS.ProcessEnv, stdio?: 'pipe'[], scratch?: string }} [options]
 * @returns {{ child: import('node:child_process').ChildProcess, said: () => string, ended: Promise<void>, stop: () => Promise<void> }}
 */
export function start(program, args, { env = {}, stdio = [], scratch } = {}) {
  guard();
  const child = spawn(program, args, {
    env: { ...process.env, ...env },
    stdio: ['ignore', 'pipe', 'pipe', ...stdio],
    detached: !isWindows,
  });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream?.on('data', (text) => (said = (said + text).slice(-SAID_MAX)));
  child.on('error', (error) => (said += `could not be started: ${error.message}`));
  running.set(child, scratch);
  const ended = new Promise((resolve) => {
    for (const event of ['exit', 'error']) child.once(event, resolve);
  });
  const stop = async () => {
    kill(child);
    await ended;
  };
  return { child, said: () => said.trim(), ended, stop };
}

function kill(child) {
  if (!running.has(child)) return;
  const scratch = running.get(child);
  running.delete(child);
  try {
    // The group also when its leader is gone: its children may still be there.
    if (isWindows) spawnSync('taskkill', ['/pid', String(child.pid), '/t', '/f']);
    else if (child.pid) process.kill(-child.pid, 'SIGKILL');
  } catch {
    // Nobody is left.
  }
  // Until the last of them is gone, files may still appear there.
  if (scratch) rmSync(scratch, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
}

/** From here on everything ends with this process, also when it is interrupted: groups of their own do not hear the terminal's Ctrl+C. */
export function guard() {
  if (isGuarded) return;
  isGuarded = true;
  process.on('exit', () => [...running.keys()].forEach(kill));
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.once(signal, () => process.exit(128 + os.constants.signals[signal]));
}

/** A screen that nobody sees; with `env` programs show themselves there. */
export async function startScreen(xvfb) {
  const screen = start(xvfb, ['-displayfd', '3', '-screen', '0', '1280x1024x24', '-nolisten', 'tcp'], { stdio: ['pipe'] });
  const number = await new Promise((resolve, reject) => {
    screen.child.stdio[3]?.once('data', (text) => resolve(String(text).trim()));
    screen.ended.then(() => reject(new Error(`Xvfb ended: ${screen.said()}`)));
  });
  // On a desktop under Wayland browsers would choose that.
  return { env: { DISPLAY: `:${number}`, WAYLAND_DISPLAY: undefined, GDK_BACKEND: 'x11', MOZ_ENABLE_WAYLAND: '0' }, stop: screen.stop };
}

/** A port nobody listens on, for programs that cannot choose one themselves. */
export async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await new Promise((resolve) => server.once('listening', resolve));
  const { port } = /** @type {import('node:net').AddressInfo} */ (server.address());
  await new Promise((resolve) => server.close(resolve));
  return port;
}

/** Asks until there is an answer other than `undefined`; `what` is for the message when time is up. */
export async function until(ask, what, timeoutMs) {
  for (const deadline = Date.now() + timeoutMs; ; ) {
    const answer = await ask();
    if (answer !== undefined) return answer;
    if (Date.now() > deadline) throw new Error(`${what} took more than ${timeoutMs / 1000} s`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
