/** The command line, stopped in the middle: files are whole or not there, nothing else is left, and the next run makes what is missing. */

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { once } from 'node:events';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import { clearLeft, writeWhole } from '../../www/cli/whole-file.ts';

const CLI = fileURLToPath(new URL('../../dist/cli.js', import.meta.url));
const folder = mkdtempSync(path.join(os.tmpdir(), 'rock-field-stopped-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** Enough files for a signal to come between them, and so large that it also comes while one is written. */
const SEEDS = 16;
const LINE = [
  'export',
  '--preset',
  'riverbed',
  '--seeds',
  `1..${SEEDS}`,
  '--image-width',
  '96',
  '--image-height',
  '64',
  '--jobs',
  '2',
  '--out',
  '{seed}.glb',
];

interface Ended {
  pid: number;
  code: number | null;
  signal: NodeJS.Signals | null;
  err: string;
}

/** Runs the line in a folder; `during` is given the process. */
function running(cwd: string, more: string[], during: (child: ReturnType<typeof spawn>) => void = () => undefined): Promise<Ended> {
  const child = spawn(process.execPath, [CLI, ...LINE, ...more], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
  let err = '';
  child.stderr?.on('data', (text) => {
    err += text;
  });
  child.stdout?.on('data', () => undefined);
  during(child);
  return new Promise((resolve) => child.on('close', (code, signal) => resolve({ pid: child.pid ?? 0, code, signal, err })));
}

const sha256 = (file: string): string => createHash('sha256').update(readFileSync(file)).digest('hex');

/** Everything in a folder by its name; temporary files are told apart by theirs. */
function filesIn(where: string): { whole: Record<string, string>; temporary: string[] } {
  const names = readdirSync(where);
  const whole = Object.fromEntries(names.filter((name) => name.endsWith('.glb')).map((name) => [name, sha256(path.join(where, name))]));
  return { whole, temporary: names.filter((name) => !name.endsWith('.glb')) };
}

let expected: Record<string, string> | undefined;

/** What a run that nobody stops makes. */
async function wanted(): Promise<Record<string, string>> {
  if (!expected) {
    const cwd = path.join(folder, 'undisturbed');
    mkdirSync(cwd);
    const { code, err } = await running(cwd, []);
    assert.deepEqual([code, err], [0, '']);
    expected = filesIn(cwd).whole;
    assert.equal(Object.keys(expected).length, SEEDS);
  }
  return expected;
}

/** Every file that is there is one of those that should be, to the last byte. */
async function checkWhole(where: string): Promise<string[]> {
  const all = await wanted();
  const { whole, temporary } = filesIn(where);
  for (const [name, hash] of Object.entries(whole)) assert.equal(hash, all[name], name);
  return temporary;
}

/** In how many moments; `MOMENTS=50` before `npm test -- --only web` tries more. */
const MOMENTS = Number(process.env.MOMENTS ?? 15);

test('stopped at random moments, by Ctrl-C, SIGTERM and SIGKILL, no file is half, and the next run goes on', async () => {
  await wanted();
  const signals = ['SIGINT', 'SIGTERM', 'SIGKILL'] as const;
  const codes = { SIGINT: 130, SIGTERM: 143, SIGKILL: null };
  let stopped = 0;
  let complete = 0;
  for (let k = 0; stopped < MOMENTS; k++) {
    const cwd = path.join(folder, `stopped-${complete}`);
    mkdirSync(cwd, { recursive: true });
    const signal = signals[stopped % signals.length];
    // Beginning, middle and end: how long a run takes depends on the machine, so a moment is counted from a file that appears.
    const from = Math.floor(Math.random() * 4);
    let wait: NodeJS.Timeout | undefined;
    const {
      pid,
      code,
      signal: by,
      err,
    } = await running(cwd, ['--skip-existing'], (child) => {
      let files = 0;
      const soon = (): void => {
        wait ??= setTimeout(() => child.kill(signal), 40 * Math.random());
      };
      if (from === 0) setTimeout(soon, 150 * Math.random());
      else
        child.stdout?.on('data', () => {
          files += 1;
          if (files >= from) soon();
        });
    });
    clearTimeout(wait);
    const temporary = await checkWhole(cwd);
    if (code === 0) {
      complete += 1;
      assert.deepEqual(filesIn(cwd).whole, await wanted());
      assert.deepEqual(temporary, []);
      continue;
    }
    stopped += 1;
    // Before the program has begun, a signal ends it as any other.
    if (by === null) assert.equal(code, codes[signal], err);
    else assert.equal(by, signal);
    // Those of a run before, which was killed, may still be there where this one was stopped before it wrote anything.
    const own = temporary.filter((name) => name.includes(`.${pid}.`));
    if (signal !== 'SIGKILL') assert.deepEqual(own, [], signal);
    if (code === 130)
      assert.match(
        err,
        /stopped(: (\d+) of (\2 files are there, each of them whole\n|\d+ files are there, each of them whole; the same command with --skip-existing)|; nothing was written)/,
      );
    assert.ok(k < 500, 'most runs end before they are stopped');
  }
  const cwd = path.join(folder, `stopped-${complete}`);
  mkdirSync(cwd, { recursive: true });
  assert.equal((await running(cwd, ['--skip-existing'])).code, 0);
  assert.deepEqual([filesIn(cwd).whole, filesIn(cwd).temporary], [await wanted(), []]);
});

test('on a disk that gets full no file is half, and with more room the next run ends with the same files', async (t) => {
  const disk = path.join(folder, 'disk');
  mkdirSync(disk);
  if (spawnSync('mount', ['-t', 'tmpfs', '-o', 'size=900k', 'tmpfs', disk]).status !== 0)
    return t.skip('no file system can be mounted here');
  try {
    await wanted();
    const { code, err } = await running(disk, []);
    assert.equal(code, 3, err);
    assert.match(err, /\.glb: there is no space left on the device/);
    assert.match(err, /files cannot be written: \d+ of 16 files are there, each of them whole; the same command with --skip-existing/);
    assert.deepEqual(await checkWhole(disk), []);
    assert.ok(Object.keys(filesIn(disk).whole).length > 0);
    assert.equal(spawnSync('mount', ['-o', 'remount,size=64m', disk]).status, 0);
    assert.equal((await running(disk, ['--skip-existing'])).code, 0);
    assert.deepEqual([filesIn(disk).whole, filesIn(disk).temporary], [await wanted(), []]);
  } finally {
    spawnSync('umount', [disk]);
  }
});

test('when whatever reads the output has gone, the run ends, and leaves whole files alone', async () => {
  const cwd = path.join(folder, 'pipe');
  mkdirSync(cwd);
  const { code, err } = await running(cwd, [], (child) => child.stdout?.once('data', () => child.stdout?.destroy()));
  assert.equal(code, 141, err);
  assert.match(err, /whatever read the output has gone/);
  assert.deepEqual(await checkWhole(cwd), []);
});

test('a file whose temporary file was removed while it was written is written again, and whole', async () => {
  const cwd = path.join(folder, 'removed');
  mkdirSync(cwd);
  // Removes the first that it sees, as a merge on another machine may.
  const remover = new Worker(
    `const { readdirSync, rmSync } = require('node:fs');
    require('node:worker_threads').parentPort.postMessage('ready');
    for (let name; !name; ) {
      name = readdirSync(${JSON.stringify(cwd)}).find((name) => name.endsWith('.tmp'));
      if (name) rmSync(${JSON.stringify(`${cwd}/`)} + name);
    }`,
    { eval: true },
  );
  await once(remover, 'message');
  const gone = once(remover, 'exit');
  const bytes = new Uint8Array(2 ** 26).fill(7);
  writeWhole(path.join(cwd, 'a.glb'), bytes);
  await gone;
  assert.deepEqual(readdirSync(cwd), ['a.glb']);
  assert.ok(readFileSync(path.join(cwd, 'a.glb')).equals(bytes));
});

test('temporary files of a process that has gone are removed by the next that writes there, those of living ones are not', () => {
  const cwd = path.join(folder, 'left');
  mkdirSync(cwd);
  const gone = spawnSync(process.execPath, ['--eval', '0']).pid;
  writeWhole(path.join(cwd, 'a.glb'), new Uint8Array(3));
  const host = os
    .hostname()
    .replaceAll(/[^\w-]/g, '_')
    .slice(0, 64);
  const name = (pid: number, machine = host): string => `.rock-field-${machine}.${pid}.0.1.tmp`;
  const kept = [name(process.pid), name(gone, 'another-machine'), '.rock-field-notes.tmp', 'a.glb'];
  for (const file of [name(gone), ...kept]) writeFileSync(path.join(cwd, file), 'x');
  clearLeft(cwd);
  assert.deepEqual(readdirSync(cwd).sort(), kept.sort());
});
