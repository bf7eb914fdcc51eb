// Running other programs, and saying what is being done. Node built-ins only: this runs before `npm ci`.
//
// Everything said here goes to stderr, so that a command that answers on stdout (`npm run bench -- --json`) stays clean.
import { spawn, spawnSync } from 'node:child_process';
import { accessSync, constants, realpathSync, statSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

/** An error whose message is for the person at the terminal: printed without a stack trace. */
export class Failure extends Error {}

/**
 * The value, which has to be there; otherwise a Failure says that there is no `what`.
 *
 * @template T
 * @param {T} value
 * @param {string} what
 * @returns {NonNullable<T>}
 */
export function needed(value, what) {
  if (value === null || value === undefined) throw new Failure(`there is no ${what}`);
  return value;
}

/** The message of whatever was thrown. */
export const messageOf = (thrown) => (thrown instanceof Error ? thrown.message : String(thrown));

export function say(text) {
  process.stderr.write(`${text}\n`);
}

/** Runs `work` as a named step: says what starts and how long it may take, then how long it took. */
export async function step(what, expected, work) {
  say(`• ${what}${expected ? ` (${expected})` : ''}`);
  const start = performance.now();
  const result = await work();
  say(`  ${what}: ${seconds(performance.now() - start)} s`);
  return result;
}

/** Works on the items in order, on as many at a time as there are cores; fails with the first failure once all are done. */
export async function inLanes(items, work, lanes = os.availableParallelism()) {
  const waiting = items[Symbol.iterator]();
  const failures = [];
  const lane = async () => {
    for (const item of waiting) await work(item).catch((error) => failures.push(error));
  };
  await Promise.all(Array.from({ length: lanes }, lane));
  if (failures.length > 0) throw failures[0];
}

export function seconds(ms) {
  return (ms / 1000).toFixed(1);
}

/**
 * Runs a program to its end with its output shown; throws a Failure when it fails. `stdout: 'inherit'` sends its output to ours.
 *
 * @param {string} program
 * @param {string[]} args
 * @param {{ env?: NodeJS.ProcessEnv, cwd?: string, stdout?: 'inherit' | number }} [options]
 * @returns {Promise<void>}
 */
export function run(program, args, { env = {}, cwd, stdout = 2 } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', stdout, 2] });
    child.on('error', (error) => reject(new Failure(`could not start ${program}: ${error.message}`)));
    child.on('close', (code, signal) => {
      if (code === 0) resolve();
      else reject(new Failure(`${path.basename(program)} ${args.slice(0, 6).join(' ')} … failed (${signal ?? `exit status ${code}`})`));
    });
  });
}

/** The standard output of a program, trimmed; `null` when it is missing or fails. */
export function capture(program, args, options = {}) {
  const result = spawnSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 26, ...options });
  return result.status === 0 ? result.stdout.trim() : null;
}

/** The full path of a program on PATH; `null` when there is none. */
export function which(name) {
  const endings = process.platform === 'win32' ? ['.exe', '.cmd', '.bat'] : [''];
  for (const folder of (process.env.PATH ?? '').split(path.delimiter)) {
    for (const ending of endings) {
      const candidate = path.join(folder, name + ending);
      if (isProgram(candidate)) return candidate;
    }
  }
  return null;
}

export function isProgram(file) {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

/** npm itself, through the Node that runs us: `npm.cmd` cannot be started without a shell on Windows. */
export async function npm(args, options) {
  if (process.env.npm_execpath?.endsWith('.js')) return run(process.execPath, [process.env.npm_execpath, ...args], options);
  const beside = path.join(path.dirname(process.execPath), 'node_modules', 'npm', 'bin', 'npm-cli.js');
  if (process.platform === 'win32') return run(process.execPath, [beside, ...args], options);
  return run('npm', args, options);
}

/** For `sort`: those with these names first, in this order; the others stay as they are. */
export function beginningWith(names, nameOf) {
  const rank = (item) => (names.includes(nameOf(item)) ? names.indexOf(nameOf(item)) : names.length);
  return (a, b) => rank(a) - rank(b);
}

/** Whether a module is the program that was started, not imported. */
export function isMain(meta) {
  return Boolean(process.argv[1]) && realpathSync(process.argv[1]) === realpathSync(fileURLToPath(meta.url));
}

/** Runs a command's main function; a Failure ends it with its message alone. */
export async function main(work) {
  try {
    await work();
  } catch (error) {
    say(`\n${error instanceof Failure ? `✗ ${error.message}` : error instanceof Error ? error.stack : error}`);
    process.exitCode = 1;
  }
}
