// The wasm artefacts: cargo → wasm-bindgen → wasm-opt → short names of imports, into pkg/. An artefact whose sources have not changed is kept.
import { existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { cargoEnv, hashOf, lockedVersion, pkg, root, target } from '../lib/env.mjs';
import { GENERATORS, LATER } from '../lib/generators.mjs';
import { Failure, capture, inLanes, needed, run, say, step } from '../lib/run.mjs';
import { bindgen, bindgenProgram } from '../setup.mjs';
import { shortenImports } from './short-imports.mjs';
import { silencePanics } from './silent-panics.mjs';

const WASM = 'wasm32-unknown-unknown';

/** An instance can be replaced after a trap: a renderer's, and a generator's in Node and for `rock-field/core`, where there is no worker to be ended. */
const RESET = ['--experimental-reset-state-function'];

/**
 * How the renderers are made: what they draw takes the GPU's time, and what panics say nobody reads. Nothing is ever stored below address 1024, where the
 * stack ends, which lets the optimiser join more addresses.
 */
const SMALL = { silent: true, optimise: ['-Oz', '--low-memory-unused', '--strip-target-features', '--strip-producers'], bindgen: RESET };
/**
 * A seventh of the other's size, and every embed fetches it: less is compiled into its callers, its expressions are taken apart before they are put
 * together anew, and it is optimised until nothing more comes of it.
 */
const SMALLEST = {
  ...SMALL,
  rustc: ['-C', 'llvm-args=-inline-threshold=5'],
  optimise: ['--flatten', '--rereloop', '-Oz', '--converge', ...SMALL.optimise],
};

/**
 * `feature` is the cargo feature and the name of the files in pkg/; the generators, and what comes later, say themselves how they are made, the renderers are made for size.
 * Those that take longest come first. Each has a profile of its own, since cargo builds one thing at a time in the folder of a profile.
 */
export const artefacts = [
  { feature: 'renderer-webgl', profile: 'renderer-webgl', ...SMALL, expected: '2–6 min the first time' },
  { feature: 'renderer-webgpu', profile: 'renderer-webgpu', ...SMALLEST, expected: '1–4 min the first time' },
  ...[...GENERATORS, ...LATER].map(({ wasm, compile }) => ({ feature: wasm, expected: '10–60 s', bindgen: RESET, ...compile })),
];

// What rustc's default wasm target uses, and SIMD (.cargo/config.toml): what every browser of the last years has.
const WASM_FEATURES = [
  'bulk-memory',
  'bulk-memory-opt',
  'multivalue',
  'mutable-globals',
  'nontrapping-float-to-int',
  'reference-types',
  'sign-ext',
  'simd',
];

export async function buildWasm() {
  mkdirSync(pkg, { recursive: true });
  const tools = toolVersions();
  const wanted = artefacts.filter((artefact) => {
    if (!isCurrent(artefact, tools)) return true;
    say(`• ${artefact.feature}.wasm is up to date`);
    return false;
  });
  if (wanted.length === 0) return;
  // wasm-bindgen is compiled beside the first artefacts, which need it when they are compiled themselves. The optimisers keep one core busy, so
  // that artefacts are built side by side.
  const isReady = bindgen();
  await Promise.all([
    isReady,
    inLanes(wanted, (artefact) => step(`Building ${artefact.feature}.wasm`, artefact.expected, () => build(artefact, tools, isReady))),
  ]);
}

async function build(artefact, tools, bindgenIsReady) {
  const { feature, profile, rustc = [], silent = false, optimise, bindgen = [] } = artefact;
  const stamp = stampFile(feature);
  rmSync(stamp, { force: true });
  // For wasm alone: compiled together with the library that Rust programs link, the renderers are 7 and 14 % larger.
  const flags = ['--lib', '--crate-type', 'cdylib', '--no-default-features', '--features', feature, '--target', WASM, '--profile', profile];
  // What follows the dashes is for this crate alone, which is where all others are compiled into (LTO).
  await run('cargo', ['rustc', ...flags, '--', ...rustc], { env: cargoEnv, cwd: root });
  const folder = path.join(target, WASM, profile);

  // wasm-bindgen writes into a folder of its own first: pkg/ never holds half an artefact.
  await bindgenIsReady;
  const staging = path.join(pkg, `.${feature}`);
  rmSync(staging, { recursive: true, force: true });
  const options = ['--target', 'web', '--out-dir', staging, '--out-name', feature, ...bindgen];
  await run(needed(bindgenProgram('wasm-bindgen'), 'wasm-bindgen of the version in Cargo.lock'), [
    path.join(folder, 'rock_field.wasm'),
    ...options,
  ]);
  const wasm = path.join(staging, `${feature}_bg.wasm`);
  if (silent) await silencePanics(wasm);
  const enable = WASM_FEATURES.map((name) => `--enable-${name}`);
  await run(process.execPath, [wasmOpt(), wasm, '-o', wasm, ...optimise, ...enable]);
  shortenImports(wasm, path.join(staging, `${feature}.js`));
  for (const name of readdirSync(staging)) {
    rmSync(path.join(pkg, name), { recursive: true, force: true });
    renameSync(path.join(staging, name), path.join(pkg, name));
  }
  rmSync(staging, { recursive: true });

  const inputs = sourcesOf(path.join(folder, 'rock_field.d'));
  writeFileSync(stamp, JSON.stringify({ tools: toolsOf(artefact, tools), inputs, hash: hashFiles(inputs) }, null, 1));
}

function isCurrent(artefact, tools) {
  const { feature } = artefact;
  if (!existsSync(path.join(pkg, `${feature}_bg.wasm`)) || !existsSync(path.join(pkg, `${feature}.js`))) return false;
  try {
    const stamp = JSON.parse(readFileSync(stampFile(feature), 'utf8'));
    return stamp.tools === toolsOf(artefact, tools) && stamp.hash === hashFiles(stamp.inputs);
  } catch {
    return false;
  }
}

function stampFile(feature) {
  return path.join(pkg, `${feature}.stamp.json`);
}

/** All but the sources that decides the bytes of an artefact. */
function toolsOf(artefact, tools) {
  return hashOf(tools, JSON.stringify(artefact));
}

/** What decides the bytes of every artefact, beside its sources and its own settings. */
function toolVersions() {
  const files = [
    'Cargo.toml',
    'Cargo.lock',
    'scripts/build/wasm.mjs',
    'scripts/build/silent-panics.mjs',
    'scripts/build/short-imports.mjs',
    'scripts/build/wasm-reader.mjs',
    'rust-toolchain.toml',
    '.cargo/config.toml',
  ];
  const texts = files.map((file) => path.join(root, file)).map((file) => (existsSync(file) ? readFileSync(file) : ''));
  const binaryen = readFileSync(path.join(root, 'node_modules', 'binaryen', 'package.json'));
  return hashOf(
    capture('rustc', ['-vV'], { cwd: root }) ?? '',
    lockedVersion('wasm-bindgen'),
    binaryen,
    process.env.RUSTFLAGS ?? '',
    ...texts,
  );
}

/** The source files cargo says the artefact was made from, relative to the root: an edit of a generator leaves the renderers alone. */
function sourcesOf(depFile) {
  const [line] = readFileSync(depFile, 'utf8').split(/\r?\n/);
  const names = line
    .slice(line.indexOf(': ') + 2)
    .split(/(?<!\\) /)
    .filter(Boolean);
  const files = names.map((file) => path.relative(root, path.resolve(root, file.replaceAll('\\ ', ' '))));
  if (files.length === 0) throw new Failure(`${depFile} names no source file`);
  return files.sort();
}

function hashFiles(files) {
  return hashOf(...files.flatMap((file) => [file, readFileSync(path.join(root, file))]));
}

function wasmOpt() {
  return path.join(root, 'node_modules', 'binaryen', 'bin', 'wasm-opt');
}
