// Where things are. Node built-ins only: this runs before `npm ci`.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..', '..');
export const pkg = path.join(root, 'pkg');
export const dist = path.join(root, 'dist');

/**
 * The tools and what cargo compiles live in the user's cache folder, outside the clone: wgpu is then compiled once for all clones
 * and for the build, the tests and clippy alike. `ROCK_FIELD_CACHE` moves it.
 */
export const cache = process.env.ROCK_FIELD_CACHE ? path.resolve(root, process.env.ROCK_FIELD_CACHE) : path.join(userCache(), 'rock-field');
export const target = process.env.CARGO_TARGET_DIR ? path.resolve(root, process.env.CARGO_TARGET_DIR) : path.join(cache, 'target');

/** The environment of every cargo command. */
export const cargoEnv = {
  CARGO_TARGET_DIR: target,
  // Cargo names a cdylib without a hash, so clones (and feature sets) sharing a target folder would overwrite each other's
  // `rock_field.wasm` and link it unnoticed. This variable, which rustc's own build uses, gives such files their hash.
  __CARGO_DEFAULT_LIB_METADATA: 'rock-field',
};

function userCache() {
  if (process.platform === 'win32') return process.env.LOCALAPPDATA ?? path.join(os.homedir(), 'AppData', 'Local');
  if (process.platform === 'darwin') return path.join(os.homedir(), 'Library', 'Caches');
  return process.env.XDG_CACHE_HOME || path.join(os.homedir(), '.cache');
}

/** The version of a crate in a Cargo.lock, by default that of the repository. */
export function lockedVersion(crate, folder = root) {
  const lock = readFileSync(path.join(folder, 'Cargo.lock'), 'utf8');
  return new RegExp(`name = "${crate}"\\r?\\nversion = "([^"]+)"`).exec(lock)?.[1];
}

export function hashOf(...parts) {
  const hash = createHash('sha256');
  for (const part of parts) hash.update(part).update('\0');
  return hash.digest('hex');
}
