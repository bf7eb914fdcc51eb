// Sets up what building needs: the wasm target and the npm packages; `npm run setup` compiles wasm-bindgen too. Node built-ins only.
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { cache, cargoEnv, lockedVersion, root } from './lib/env.mjs';
import { Failure, capture, isMain, isProgram, main, needed, npm, run, say, step, which } from './lib/run.mjs';

const WASM = 'wasm32-unknown-unknown';
const exe = process.platform === 'win32' ? '.exe' : '';

/** Sets everything up; quick when it is there already. `components` are rustup components the tests need. */
export async function setup({ components = /** @type {string[]} */ ([]) } = {}) {
  const start = performance.now();
  say('• Checking the toolchain');
  checkNode();
  checkRust();
  checkLinker();
  await wasmTarget();
  for (const component of components) await rustComponent(component);
  await packages();
  say(`  ready in ${((performance.now() - start) / 1000).toFixed(1)} s`);
}

/**
 * The command for this platform, for the text of a Failure.
 *
 * @param {{ darwin?: string, win32?: string, linux: string }} commands
 */
function install({ darwin, win32, linux }) {
  return { darwin, win32 }[process.platform] ?? linux;
}

function checkNode() {
  const major = Number(process.versions.node.split('.')[0]);
  if (major >= 20) return;
  throw new Failure(
    `Node 20 or newer is needed, this is ${process.version}. Install it with: ${install({
      darwin: 'brew install node',
      win32: 'winget install OpenJS.NodeJS.LTS',
      linux: 'https://nodejs.org/en/download (Debian 12: its nodejs is too old; use NodeSource or nvm: nvm install 22)',
    })}`,
  );
}

function checkRust() {
  const command = install({
    darwin: "curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh",
    win32: 'winget install Rustlang.Rustup (then open a new terminal)',
    linux: "curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh",
  });
  // rustup puts its programs here, and only a new terminal has them on PATH.
  const home = path.join(process.env.CARGO_HOME ?? path.join(process.env.HOME ?? process.env.USERPROFILE ?? '', '.cargo'), 'bin');
  if (!which('cargo') && isProgram(path.join(home, `cargo${exe}`))) process.env.PATH = `${home}${path.delimiter}${process.env.PATH}`;
  if (!which('cargo')) throw new Failure(`Rust (cargo) is missing. Install it with: ${command}`);
  const have = capture('rustc', ['--version'], { cwd: root })?.split(' ')[1];
  if (!have) throw new Failure(`rustc does not run. Set a toolchain up with: rustup default stable`);
  const need = /^rust-version = "([^"]+)"/m.exec(readFileSync(path.join(root, 'Cargo.toml'), 'utf8'))?.[1] ?? '0';
  if (older(have, need)) throw new Failure(`Rust ${need} or newer is needed, this is ${have}. Update it with: rustup update stable`);
}

function older(a, b) {
  const [x, y] = [a, b].map((version) => version.split(/[.-]/).map(Number));
  return x[0] !== y[0] ? x[0] < y[0] : x[1] < y[1];
}

/** Build scripts and procedural macros run on this machine, so cargo needs its C linker even for wasm. */
function checkLinker() {
  if (process.platform === 'win32') return; // rustup's own installer asks for the Visual Studio build tools
  if (which('cc')) return;
  throw new Failure(
    `A C compiler (cc) is missing. Install it with: ${install({
      darwin: 'xcode-select --install',
      linux: 'sudo apt-get install build-essential (Fedora: sudo dnf install gcc; Arch: sudo pacman -S base-devel)',
    })}`,
  );
}

async function wasmTarget() {
  const sysroot = needed(capture('rustc', ['--print', 'sysroot'], { cwd: root }), 'answer from rustc about its folder');
  if (existsSync(path.join(sysroot, 'lib', 'rustlib', WASM, 'lib'))) return;
  if (!which('rustup'))
    throw new Failure(`This Rust has no ${WASM} target and there is no rustup to add it. Install rustup: https://rustup.rs`);
  await step(`Adding the Rust target ${WASM}`, 'a few seconds', () => run('rustup', ['target', 'add', WASM], { cwd: root }));
}

async function rustComponent(name) {
  const program = { clippy: 'cargo-clippy', rustfmt: 'cargo-fmt' }[name];
  if (capture(program, ['--version'], { cwd: root }) !== null) return;
  if (!which('rustup'))
    throw new Failure(`${name} is missing. Install it with your Rust's package manager, or use rustup: https://rustup.rs`);
  await step(`Adding the Rust component ${name}`, 'a few seconds', () => run('rustup', ['component', 'add', name], { cwd: root }));
}

/**
 * A wasm-bindgen program (`wasm-bindgen` or `wasm-bindgen-test-runner`) of exactly the crate's version, from PATH or from our cache; `null` if there is none.
 */
export function bindgenProgram(name) {
  const version = lockedVersion('wasm-bindgen');
  const candidates = [which(name), path.join(bindgenRoot(), 'bin', name + exe)];
  return candidates.find((file) => file && capture(file, ['--version'])?.endsWith(` ${version}`)) ?? null;
}

function bindgenRoot() {
  return path.join(cache, 'tools', `wasm-bindgen-${lockedVersion('wasm-bindgen')}`);
}

/** What the build needs of wasm-bindgen is compiled by itself (scripts/build/bindgen): 43 packages, where the official command with its test runner has 254. */
export async function bindgen() {
  const version = lockedVersion('wasm-bindgen');
  if (!version) throw new Failure('Cargo.lock has no wasm-bindgen; restore it with: git checkout Cargo.lock');
  if (bindgenProgram('wasm-bindgen')) return;
  const folder = path.join(root, 'scripts', 'build', 'bindgen');
  for (const crate of ['rock-field-bindgen', 'wasm-bindgen-cli-support']) {
    const own = lockedVersion(crate, folder);
    if (own !== version)
      throw new Failure(`${crate} in scripts/build/bindgen/Cargo.toml must be ${version}, as wasm-bindgen in Cargo.lock; it is ${own}`);
  }
  await step(`Compiling wasm-bindgen ${version}`, 'once, 30–60 s', () => cargoInstall(['--path', folder]));
}

/** Its 254 packages are compiled without optimising, but for those that read and write wasm: it works for a second on each test program. */
const QUICKLY = ['opt-level=0', ...['walrus', 'wasmparser', 'wasm-encoder'].map((name) => `package.${name}.opt-level=2`)].flatMap(
  (setting) => ['--config', `profile.release.${setting}`],
);

/** The program that runs the crate's tests as wasm in Node, compiled if there is none; only these tests need it. */
export async function bindgenTestRunner() {
  const name = 'wasm-bindgen-test-runner';
  const version = lockedVersion('wasm-bindgen');
  if (!bindgenProgram(name)) {
    await step(`Compiling ${name} ${version}`, 'once, 1–3 min', () =>
      cargoInstall(['wasm-bindgen-cli', '--version', version, '--bin', name, ...QUICKLY]),
    );
  }
  const program = bindgenProgram(name);
  if (!program) throw new Failure(`there is no ${name} ${version} after it was compiled`);
  return program;
}

/** `cargo install` into our cache. */
async function cargoInstall(what) {
  const args = ['install', ...what, '--root', bindgenRoot(), '--force'];
  mkdirSync(bindgenRoot(), { recursive: true });
  try {
    await run('cargo', [...args, '--locked'], { env: cargoEnv });
  } catch {
    say('  Its locked dependencies could not be had; trying with the newest ones.');
    await run('cargo', args, { env: cargoEnv });
  }
}

/** Installs the npm packages when what is installed is not what package-lock.json says. */
async function packages() {
  if (packagesMatch()) return;
  await step('Installing the npm packages', '5–60 s', async () => {
    // None of the packages needs its install script; without them a package cannot run anything here.
    await npm(['ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: root });
  });
}

function packagesMatch() {
  const wanted = readJson(path.join(root, 'package-lock.json'));
  const installed = readJson(path.join(root, 'node_modules', '.package-lock.json'));
  if (!wanted) throw new Failure('package-lock.json is missing; restore it with: git checkout package-lock.json');
  if (!installed) return false;
  return Object.entries(wanted.packages).every(
    ([name, entry]) => name === '' || entry.optional || installed.packages[name]?.version === entry.version,
  );
}

function readJson(file) {
  try {
    return JSON.parse(readFileSync(file, 'utf8'));
  } catch {
    return null;
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    const isAll = process.argv.includes('--all');
    await setup({ components: isAll ? ['rustfmt', 'clippy'] : [] });
    await bindgen();
    if (isAll) await bindgenTestRunner();
  });
}
