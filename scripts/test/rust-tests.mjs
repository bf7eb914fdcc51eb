// The tests of the crate, whose programs run side by side: most of them keep one core busy, and headless Node never more.
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { cargoEnv, root } from '../lib/env.mjs';
import { Failure, beginningWith, inLanes, seconds } from '../lib/run.mjs';

/** These take longest, so they begin first. */
const LONG = ['properties', 'wood_ear', 'wood_ear_logs', 'wood_ear_properties'];

/** What marks a test for wasm: by itself, or by the macro of tests/common that makes one for each target. */
const FOR_WASM = /\b(wasm_bindgen_test|field_test)\b/;

/** The arguments of `cargo test` that choose the programs with tests for wasm: the others would be compiled for nothing. */
export function withWasmTests() {
  const folder = path.join(root, 'tests');
  const names = readdirSync(folder).filter((name) => name.endsWith('.rs') && FOR_WASM.test(readFileSync(path.join(folder, name), 'utf8')));
  return names.flatMap((name) => ['--test', path.basename(name, '.rs')]);
}

/** Compiles the test programs that these arguments of `cargo test` choose, and runs them; `runner` is the program that can run them, if they need one. */
export async function runRustTests(args, runner) {
  const failed = [];
  await inLanes(programs(args).sort(beginningWith(LONG, ({ name }) => name)), async (program) => {
    if (!(await isPassed(program, runner))) failed.push(program.name);
  });
  if (failed.length > 0) throw new Failure(`tests failed in ${failed.join(', ')}`);
}

function programs(args) {
  const { status, stdout } = spawnSync('cargo', ['test', '--no-run', '--message-format=json-render-diagnostics', ...args], {
    cwd: root,
    env: { ...process.env, ...cargoEnv },
    stdio: ['ignore', 'pipe', 2],
    encoding: 'utf8',
    maxBuffer: 1 << 28,
  });
  if (status !== 0) throw new Failure('the tests of the crate could not be compiled');
  const told = stdout
    .split('\n')
    .filter(Boolean)
    .map((line) => JSON.parse(line));
  return told
    .filter(({ profile, executable }) => profile?.test && executable)
    .map(({ target, executable }) => ({ name: target.name, executable }));
}

/** Runs one program and shows what it said, in one piece. */
function isPassed({ name, executable }, runner) {
  return new Promise((resolve) => {
    const start = performance.now();
    const [program, ...args] = runner ? [runner, executable] : [executable];
    const child = spawn(program, args, { cwd: root, env: { ...process.env, CARGO_MANIFEST_DIR: root }, stdio: ['ignore', 'pipe', 'pipe'] });
    let said = '';
    for (const stream of [child.stdout, child.stderr]) stream.setEncoding('utf8').on('data', (text) => (said += text));
    child.on('error', (error) => (said += error.message));
    child.on('close', (code) => {
      console.log(`\n${name} (${seconds(performance.now() - start)} s)\n${said.trim()}`);
      resolve(code === 0);
    });
  });
}
