// `npm test`: sets everything up, then runs every check, all of them even when one fails.
//
//   npm test -- --only rust          the steps whose name starts so; several with commas
//   SKIP_BROWSERS=1 npm test         without the browser tests
//
// The last line on stdout is always `N passed, N failed`, counting steps.
import { existsSync, readdirSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { run as runFiles } from 'node:test';
import { spec } from 'node:test/reporters';
import { parseArgs } from 'node:util';
import { cargoEnv, root } from '../lib/env.mjs';
import { GENERATORS, LATER } from '../lib/generators.mjs';
import { Failure, beginningWith, inLanes, main, messageOf, run, say, seconds } from '../lib/run.mjs';
import { runRustTests, withWasmTests } from './rust-tests.mjs';
import { bindgenTestRunner, setup } from '../setup.mjs';

const WASM = ['--target', 'wasm32-unknown-unknown'];

const cargo = (args, env = {}) => run('cargo', args, { env: { ...cargoEnv, ...env }, cwd: root, stdout: 'inherit' });
const node = (args, env = {}) => run(process.execPath, args, { env, cwd: root, stdout: 'inherit' });
const clippy = (...flags) => cargo(['clippy', '--all-targets', ...flags, '--', '-D', 'warnings']);
const docs = (...flags) => cargo(['doc', '--no-deps', ...flags], { RUSTDOCFLAGS: '-D warnings' });

/** A test file that hangs fails in the end. */
const HANGS_MS = 1_200_000;
/** Browser tests that take long begin first, so that none of them runs on alone when the others have ended. */
const LONG_FILES = [
  'docs',
  'deaths',
  'wood-ear',
  'many',
  'page',
  'devices',
  'deployment',
  'element-life',
  'element-values',
  'controls-opening',
  'wood-ear-natural',
  'natural',
  'page-panel',
  'wood-ear-files',
  'places',
  'still-pictures',
  'refused',
];

/**
 * In order within a lane; `needs` names steps without which one is not worth running. The times are for two cores, from nothing / afterwards.
 *
 * Two lanes run side by side, since most steps wait for a part of their time, or keep one core busy: first those of the crate and of what is built from it,
 * then those of browsers and of everything beside them. `prepare` comes between: what it changes is used by both lanes that follow.
 *
 * @typedef {{ name: string, expected: string, needs?: string[], lane: string, prepare?: () => Promise<unknown>, work: () => Promise<string | void> }} Step
 */
const LANES = [
  ['crate', 'build'],
  ['browsers', 'beside'],
];

/** @type {Step[]} */
const STEPS = [
  { lane: 'crate', name: 'fmt', expected: '1 s', work: () => cargo(['fmt', '--check']) },
  { lane: 'crate', name: 'clippy', expected: '30 s / 5 s', work: () => clippy() },
  ...[...GENERATORS, ...LATER].map(({ wasm }) => ({
    lane: 'crate',
    name: `clippy-${wasm}`,
    expected: '30 s / 5 s',
    work: () => clippy(...WASM, '--no-default-features', '--features', wasm),
  })),
  { lane: 'crate', name: 'clippy-webgpu', expected: '90 s / 5 s', work: () => clippy(...WASM, '--features', 'renderer-webgpu') },
  { lane: 'crate', name: 'clippy-webgl', expected: '90 s / 5 s', work: () => clippy(...WASM, '--features', 'renderer-webgl') },
  { lane: 'crate', name: 'rust', expected: '5 min / 3 min', work: rustTests },
  { lane: 'crate', name: 'rust-wasm', expected: '8 min / 80 s', work: rustInNode },
  { lane: 'crate', name: 'docs', expected: '60 s / 10 s', work: rustDocs },
  {
    lane: 'build',
    name: 'biome',
    expected: '3 s',
    work: () => node([path.join('node_modules', '@biomejs', 'biome', 'bin', 'biome'), 'ci', '--error-on-warnings', '.']),
  },
  { lane: 'build', name: 'lengths', expected: '1 s', work: async () => (await import('../checks/check-lengths.mjs')).check() },
  { lane: 'build', name: 'generators', expected: '1 s', work: async () => (await import('../checks/check-generators.mjs')).check() },
  { lane: 'build', name: 'build', expected: '5 min / 5 s', work: async () => (await import('../build/build.mjs')).build() },
  { lane: 'build', name: 'size', expected: '5 s', needs: ['build'], work: async () => (await import('../build/size.mjs')).check() },
  { lane: 'build', name: 'types', expected: '10 s', needs: ['build'], work: types },
  {
    lane: 'build',
    name: 'dependencies',
    expected: '2 s',
    needs: ['build'],
    work: async () => (await import('../checks/check-deps.mjs')).check(),
  },
  {
    lane: 'build',
    name: 'package',
    expected: '10 s',
    needs: ['build'],
    work: async () => (await import('../package/package.mjs')).examine(await packed()),
  },
  { lane: 'browsers', name: 'browsers', expected: '10 min', needs: ['build'], prepare: chromium, work: () => browserTests(2) },
  { lane: 'beside', name: 'hosts', expected: '3 min / 2 min', needs: ['build'], prepare: packed, work: hosts },
  {
    lane: 'beside',
    name: 'engines',
    expected: '3 min / 2 min',
    needs: ['build'],
    work: async () => (await import('./engines.mjs')).check(),
  },
  {
    lane: 'beside',
    name: 'cluster',
    expected: '70 s / 40 s',
    needs: ['build'],
    work: async () => (await import('./cluster.mjs')).check(),
  },
  { lane: 'beside', name: 'web', expected: '2 min', needs: ['build'], work: webTests },
  { lane: 'beside', name: 'browsers-beside', expected: '5 min', needs: ['build'], work: () => browserTests(1) },
];

/** What `packed` resolves with. */
let inPackage = /** @type {ReturnType<typeof import('../package/package.mjs').pack> | null} */ (null);

/** Files of browser tests that nobody has begun. */
let waiting = /** @type {ArrayIterator<string> | undefined} */ (undefined);

await main(async () => {
  const start = performance.now();
  const steps = chosen();
  const results = [await attempt({ name: 'setup', expected: '2 min / 1 s', work: setUp })];
  const inOrder = async (lane) => {
    for (const step of steps.filter((one) => one.lane === lane)) results.push(await attempt(step, results));
  };
  try {
    for (const lanes of LANES) {
      // What fails here fails again in its step, which says so.
      for (const { prepare } of steps.filter(({ lane }) => lanes.includes(lane))) await prepare?.().catch(() => {});
      await Promise.all(lanes.map(inOrder));
    }
  } finally {
    if (inPackage) rmSync((await inPackage).outside, { recursive: true, force: true });
  }
  summarise(results, performance.now() - start);
});

/**
 * @param {Pick<Step, 'name' | 'expected' | 'needs' | 'work'>} step
 * @param {{ name: string, outcome: string }[]} [before]
 */
async function attempt({ name, expected, needs = [], work }, before = []) {
  say(`\n── ${name} (${expected})`);
  const start = performance.now();
  const broken = before.find((result) => needs.includes(result.name) && result.outcome === 'FAIL');
  let outcome = 'ok';
  let note = '';
  try {
    if (broken) throw new Failure(`not run, since ${broken.name} failed`);
    note = (await work()) ?? '';
    if (note) outcome = 'skipped';
  } catch (error) {
    outcome = 'FAIL';
    note = error instanceof Failure ? error.message : String(error instanceof Error ? error.stack : error);
    say(`✗ ${note}`);
  }
  return { name, outcome, note, ms: performance.now() - start };
}

function summarise(results, total) {
  const lines = results.map(({ name, outcome, ms }) => `${name.padEnd(20)}${seconds(ms).padStart(8)} s   ${outcome}`);
  const notes = results.filter(({ note }) => note).map(({ name, outcome, note }) => `${outcome === 'FAIL' ? '✗' : '!'} ${name}: ${note}`);
  const count = (wanted) => results.filter(({ outcome }) => outcome === wanted).length;
  console.log(['', ...lines, `${'total'.padEnd(20)}${seconds(total).padStart(8)} s`, '', ...notes].join('\n'));
  console.log(`${count('ok')} passed, ${count('FAIL')} failed`);
  if (count('FAIL') > 0) process.exitCode = 1;
}

function chosen() {
  let only;
  try {
    ({ only } = parseArgs({ options: { only: { type: 'string' } } }).values);
  } catch (error) {
    throw new Failure(messageOf(error));
  }
  if (only === undefined) return STEPS;
  const steps = STEPS.filter(({ name }) => only.split(',').some((wanted) => wanted && name.startsWith(wanted)));
  if (steps.length === 0) throw new Failure(`no step is called ${only}; there are: ${STEPS.map(({ name }) => name).join(', ')}`);
  return steps;
}

async function setUp() {
  await setup({ components: ['rustfmt', 'clippy'] });
}

async function rustTests() {
  await runRustTests(['--tests']);
  await cargo(['test', '--doc']);
}

/** The same core tests as `rust`, as wasm in Node. Doc tests run natively alone. */
async function rustInNode() {
  await runRustTests([...withWasmTests(), '--features', 'generator', ...WASM], await bindgenTestRunner());
}

async function rustDocs() {
  await docs();
  for (const feature of [...[...GENERATORS, ...LATER].map(({ wasm }) => wasm), 'renderer-webgpu'])
    await docs(...WASM, '--no-default-features', '--features', feature);
}

async function webTests() {
  const { bundleWebTests } = await import('./web-tests.mjs');
  await node([
    '--enable-source-maps',
    '--test',
    `--test-timeout=${HANGS_MS}`,
    `--test-concurrency=${os.availableParallelism()}`,
    ...(await bundleWebTests()),
  ]);
}

async function types() {
  for (const project of ['.', path.join('www', 'cli'), path.join('tests', 'web'), path.join('tests', 'e2e'), 'scripts'])
    await node([path.join('node_modules', 'typescript', 'bin', 'tsc'), '--noEmit', '-p', project]);
}

/** The path of the browser of the tests, which is installed if there is none; null where they are left out. */
async function chromium() {
  if (process.env.SKIP_BROWSERS) return null;
  return (await import('../lib/browser.mjs')).ensureBrowser();
}

/** The package, packed and unpacked once for all steps: packing builds dist/ again, which nothing may be looking at meanwhile. */
async function packed() {
  inPackage ??= import('../package/package.mjs').then(({ pack }) => pack());
  return inPackage;
}

/**
 * Runs browser tests, so many files at a time, until no file is left: while one waits the others compute. Whoever comes later helps with those that are
 * left.
 *
 * @param {number} lanes
 */
async function browserTests(lanes) {
  const browser = await chromium();
  if (!browser) return 'left out, as SKIP_BROWSERS asks';
  waiting ??= browserFiles().values();
  process.env.CHROME_PATH = browser;
  const failures = [];
  await inLanes(waiting, async (file) => void failures.push(...(await failuresOf(file))), lanes);
  // Once more, where a long log ends.
  if (failures.length > 0) throw new Failure(`tests failed\n${failures.join('\n')}`);
}

function browserFiles() {
  const folder = path.join(root, 'tests', 'e2e');
  const names = existsSync(folder) ? readdirSync(folder).filter((name) => name.endsWith('.test.mjs')) : [];
  if (names.length === 0) throw new Failure('there are no tests in tests/e2e');
  return names.sort(beginningWith(LONG_FILES, (name) => name.replace('.test.mjs', ''))).map((name) => path.join(folder, name));
}

/** Runs a file and says what comes of each test. Resolves with the tests that failed, and why. */
async function failuresOf(file) {
  const running = runFiles({ files: [file], timeout: HANGS_MS });
  const failures = [];
  running.on('test:fail', ({ name, details: { error } }) => {
    const { failureType } = /** @type {Error & { failureType?: string }} */ (error);
    if (failureType !== 'subtestsFailed') failures.push(`${path.basename(file)}: ${name}\n${messageOf(error.cause ?? error)}`);
  });
  // But for the counts.
  for await (const text of running.compose(new spec())) process.stdout.write(String(text).replace(/^ℹ .*\n/gm, ''));
  return failures;
}

/** The package in the pages of others. */
async function hosts() {
  if (!(await chromium())) return 'left out, as SKIP_BROWSERS asks';
  await (await import('../../tests/hosts/run.mjs')).check(await packed());
}
