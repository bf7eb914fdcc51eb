/**
 * Files that appear whole or not at all: written beside under a name of their own, flushed to the disk, then renamed.
 *
 * All calls are synchronous, so that a worker that is terminated ends between two of them, and leaves nothing that is still being written.
 * A process that is killed may leave its temporary file; the next that writes into the folder removes it, once the process is gone.
 */

import { randomInt } from 'node:crypto';
import { closeSync, fsyncSync, mkdirSync, openSync, readdirSync, realpathSync, renameSync, rmSync, writeSync } from 'node:fs';
import { hostname } from 'node:os';
import path from 'node:path';

/** A folder may be one of several machines, and a number of a process means something on its own machine alone. */
const HOST =
  hostname()
    .replaceAll(/[^\w-]/g, '_')
    .slice(0, 64) || 'localhost';
/** A merge on another machine may take a temporary file for one that was left behind: then it is written again. */
const MOST_TRIES = 5;
const TEMPORARY = /^\.rock-field-(?<host>[\w-]+)\.(?<pid>\d+)\.\d+\.\d+\.tmp$/;

/**
 * Of this thread. Its number would not do: a container that is started again has the same host, process and threads as the one that was killed, and
 * would find its names taken.
 */
const OWN = randomInt(2 ** 47);
let count = 0;
/** Folders that this thread has looked into for what others left. */
const cleared = new Set<string>();

/**
 * Writes a file; its folder is made where there is none. Another file of this name stays until the new one is complete.
 *
 * @throws the error of the file system; there is no new file then, and no temporary one.
 */
export function writeWhole(file: string, bytes: Uint8Array): void {
  for (let left = MOST_TRIES - 1; ; left--) {
    try {
      writeOnce(file, bytes);
      return;
    } catch (thrown) {
      if (left === 0 || (thrown as NodeJS.ErrnoException).code !== 'ENOENT') throw thrown;
    }
  }
}

function writeOnce(file: string, bytes: Uint8Array): void {
  const place = placeOf(file);
  const folder = path.dirname(place);
  mkdirSync(folder, { recursive: true });
  if (!cleared.has(folder)) {
    clearLeft(folder);
    cleared.add(folder);
  }
  count += 1;
  const temporary = path.join(folder, `.rock-field-${HOST}.${process.pid}.${OWN}.${count}.tmp`);
  try {
    // `wx`: a name that is there already is nobody's to write to.
    const handle = openSync(temporary, 'wx');
    try {
      for (let at = 0; at < bytes.length; ) at += writeSync(handle, bytes, at);
      fsyncSync(handle);
    } finally {
      closeSync(handle);
    }
    renameSync(temporary, place);
  } catch (thrown) {
    rmSync(temporary, { force: true });
    throw thrown instanceof Error ? Object.assign(thrown, { path: file }) : thrown;
  }
}

/** Where the file itself is: what a link leads to is replaced, not the link. */
export function placeOf(file: string): string {
  try {
    return realpathSync(file);
  } catch {
    return path.resolve(file);
  }
}

/** Removes the temporary files of processes of this machine that are gone. */
export function clearLeft(folder: string): void {
  clear(folder, (host, pid) => host === HOST && !isAlive(pid));
}

/** Whether it is a temporary file that no process of this machine is writing; of those of other machines nothing can be known. */
export function isAbandoned(name: string): boolean {
  const { host = '', pid = '' } = TEMPORARY.exec(name)?.groups ?? {};
  return host !== '' && (host !== HOST || !isAlive(Number(pid)));
}

/** Removes those of this process: for when it is stopped, and its workers have ended. */
export function clearOwn(folders: Iterable<string>): void {
  for (const folder of new Set(folders)) clear(folder, (host, pid) => host === HOST && pid === process.pid);
}

function clear(folder: string, isRemoved: (host: string, pid: number) => boolean): void {
  let names: string[];
  try {
    names = readdirSync(folder);
  } catch {
    // There is none yet, or it may not be read.
    return;
  }
  for (const name of names) {
    const { host = '', pid = '' } = TEMPORARY.exec(name)?.groups ?? {};
    if (host !== '' && isRemoved(host, Number(pid))) rmSync(path.join(folder, name), { force: true });
  }
}

function isAlive(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch (thrown) {
    // EPERM: it is alive, and somebody else's.
    return (thrown as NodeJS.ErrnoException).code !== 'ESRCH';
  }
}
