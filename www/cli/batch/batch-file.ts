/**
 * What the folder of a batch is for: `batch.json`, which is the first file in it. Only the same list with the same options and the same version of
 * rock-field may write into the folder; into how many shards it is split does not matter.
 */

import { randomBytes } from 'node:crypto';
import { existsSync, linkSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import path from 'node:path';
import { VERSION } from '../../data/version.ts';
import { misuse } from '../failures.ts';
import { writeWhole } from '../whole-file.ts';
import { BATCH, MOST_ITEMS, RECORDS, SCENES } from './folder.ts';
import { sha256Of } from './record.ts';

export interface Batch {
  /** Of rock-field. */
  version: string;
  items: number;
  /** SHA-256 of the scenes of the list. */
  list: string;
  /** The options of every item that has none of its own, with their keys in order. */
  options: Readonly<Record<string, unknown>>;
}

/** What `rockField` in the file says; it grows when older versions could not read the folder. */
const FORMAT = 1;

function textOf({ version, items, list, options }: Batch): string {
  return `${JSON.stringify({ rockField: FORMAT, version, items, list, options }, null, 2)}\n`;
}

/** Of everything that the folder is for: records say which batch they belong to. */
export function idOf(batch: Batch): string {
  return sha256Of(textOf(batch));
}

/**
 * Whether the folder is the batch's already; if not, it can be.
 *
 * @throws {Ending} where it is another one's.
 */
export function claimable(folder: string, batch: Batch): boolean {
  const there = readBatch(folder);
  if (there) checkSame(folder, there, batch);
  else if ([SCENES, RECORDS].some((name) => existsSync(path.join(folder, name))))
    throw misuse(`${folder} has files in it, but no ${BATCH}: choose an empty folder, or one that a batch was written to`);
  return there !== null;
}

/**
 * Makes the folder that of the batch, or finds that it is so already.
 *
 * @throws {Ending} where it is another one's, before anything is written.
 */
export function claim(folder: string, batch: Batch): void {
  if (!claimable(folder, batch)) putFirst(folder, batch);
}

/**
 * Several shards may begin at once, of two lists by mistake: the first puts its file there, and the others read what it wrote.
 *
 * @throws {Ending} where the first was another batch.
 */
export function putFirst(folder: string, batch: Batch): void {
  mkdirSync(folder, { recursive: true });
  const target = path.join(folder, BATCH);
  const own = path.join(folder, `.${BATCH}-${randomBytes(6).toString('hex')}.tmp`);
  writeWhole(own, Buffer.from(textOf(batch)));
  try {
    linkSync(own, target);
  } catch (thrown) {
    // Where the file system has no links, the last one wins.
    if ((thrown as NodeJS.ErrnoException).code !== 'EEXIST') writeWhole(target, Buffer.from(textOf(batch)));
  } finally {
    rmSync(own, { force: true });
  }
  const winner = readBatch(folder);
  if (winner) checkSame(folder, winner, batch);
}

/**
 * What the folder is for; null where nothing says so.
 *
 * @throws {Ending} where it says so in a way that cannot be read.
 */
export function readBatch(folder: string): Batch | null {
  let text: string;
  try {
    text = readFileSync(path.join(folder, BATCH), 'utf8');
  } catch (thrown) {
    const { code } = thrown as NodeJS.ErrnoException;
    if (code === 'ENOENT') return null;
    if (code === 'ENOTDIR') throw misuse(`${folder} is a file, not a folder`);
    throw thrown;
  }
  try {
    const { rockField, version, items, list, options } = JSON.parse(text) as Batch & { rockField: unknown };
    const batch = { version, items, list, options };
    if (rockField === FORMAT && Number.isInteger(items) && items >= 0 && items <= MOST_ITEMS && textOf(batch) === text) return batch;
  } catch {
    // As below.
  }
  throw misuse(`${path.join(folder, BATCH)} was written by another version of rock-field, or has been changed: choose another folder`);
}

function checkSame(folder: string, there: Batch, batch: Batch): void {
  const differs = differences(there, batch);
  if (differs.length > 0)
    throw misuse(`${folder} belongs to another batch: ${differs.join('; ')}. Choose another folder, or repeat that batch`);
}

function differences(there: Batch, batch: Batch): string[] {
  const found: string[] = [];
  if (there.version !== batch.version) found.push(`it was made by rock-field ${there.version}, and this is ${batch.version}`);
  if (there.items !== batch.items) found.push(`its list has ${there.items} scenes, and this one ${batch.items}`);
  else if (there.list !== batch.list) found.push('its list has other scenes');
  for (const key of [...new Set([...Object.keys(there.options), ...Object.keys(batch.options)])].sort()) {
    const [before, now] = [there.options[key], batch.options[key]].map((value) => JSON.stringify(value));
    if (before !== now) found.push(`its ${key} is ${before ?? 'not given'}, and here it is ${now ?? 'not given'}`);
  }
  return found;
}

/** A batch of this version. */
export function batchOf(items: number, list: string, options: Readonly<Record<string, unknown>>): Batch {
  return { version: VERSION, items, list, options: sorted(options) };
}

function sorted(options: Readonly<Record<string, unknown>>): Record<string, unknown> {
  return Object.fromEntries(
    Object.keys(options)
      .sort()
      .filter((key) => options[key] !== undefined)
      .map((key) => [key, options[key]]),
  );
}
