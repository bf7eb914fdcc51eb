// `npm run test:arm`: the golden hashes of all generators on 64-bit ARM, emulated by qemu unless this machine is one.
//
// No part of `npm test`. On Debian, as root, what is missing is installed; elsewhere it is said what to install.
import { existsSync } from 'node:fs';
import path from 'node:path';
import { cargoEnv, root } from '../lib/env.mjs';
import { GENERATORS } from '../lib/generators.mjs';
import { Failure, capture, isMain, main, needed, run, say, step, which } from '../lib/run.mjs';
import { setup } from '../setup.mjs';

const TARGET = 'aarch64-unknown-linux-gnu';
const COMPILER = 'aarch64-linux-gnu-gcc';
/** Where Debian keeps the libraries that the emulated program is linked with. */
const LIBRARIES = '/usr/aarch64-linux-gnu';
const EMULATORS = ['qemu-aarch64', 'qemu-aarch64-static'];
const PACKAGES = ['qemu-user', 'gcc-aarch64-linux-gnu', 'libc6-dev-arm64-cross'];

const isDebian = process.platform === 'linux' && existsSync('/etc/debian_version');

/** The files with golden hashes, and the name of the test in each. */
const TESTS = [...GENERATORS.flatMap(({ goldens }) => ['--test', goldens]), 'every_preset_has_its_golden_hash'];

export async function check() {
  await setup();
  const isArm = process.platform === 'linux' && process.arch === 'arm64';
  await step('Golden hashes on ARM', isArm ? '2 min / 10 s' : '5 min / 1 min', async () => {
    if (isArm) await test([], {});
    else await test(['--target', TARGET], await emulation());
  });
}

function test(flags, env) {
  return run('cargo', ['test', ...flags, ...TESTS], { env: { ...cargoEnv, ...env }, cwd: root, stdout: 'inherit' });
}

/** Installs what compiling for ARM and running it takes; the environment that makes cargo use it. */
async function emulation() {
  if (process.platform !== 'linux')
    throw new Failure('ARM programs for Linux are emulated on Linux alone; run this there, or in a container');
  if (!emulator() || !which(COMPILER)) await install();
  await target();
  return {
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER: COMPILER,
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER: `${emulator()} -L ${LIBRARIES}`,
  };
}

function emulator() {
  return EMULATORS.find(which);
}

async function install() {
  const names = PACKAGES.join(' ');
  if (!isDebian || process.getuid?.() !== 0) {
    const command = isDebian
      ? `sudo apt-get install ${names}`
      : 'sudo dnf install qemu-user gcc-aarch64-linux-gnu (Arch: sudo pacman -S qemu-user aarch64-linux-gnu-gcc)';
    throw new Failure(`${EMULATORS[0]} or ${COMPILER} is missing. Install them with: ${command}`);
  }
  await step(`apt-get install ${names}`, '1 min', async () => {
    await run('apt-get', ['update']);
    await run('apt-get', ['install', '-y', '--no-install-recommends', ...PACKAGES], { env: { DEBIAN_FRONTEND: 'noninteractive' } });
  });
}

async function target() {
  const sysroot = needed(capture('rustc', ['--print', 'sysroot'], { cwd: root }), 'answer from rustc about its folder');
  if (existsSync(path.join(sysroot, 'lib', 'rustlib', TARGET, 'lib'))) return;
  if (!which('rustup'))
    throw new Failure(`This Rust has no ${TARGET} target and there is no rustup to add it. Install rustup: https://rustup.rs`);
  await step(`Adding the Rust target ${TARGET}`, 'a few seconds', () => run('rustup', ['target', 'add', TARGET], { cwd: root }));
}

if (isMain(import.meta)) {
  await main(async () => {
    await check();
    say('✓ rocks and wood ears are the same on ARM, byte for byte');
  });
}
