/**
 * What is known of an item's file, in a file of its own, which is written when the item's file is there. So a process may be killed at any moment:
 * an item without a record, or whose file is not what the record says, is made again.
 */

import { createHash } from 'node:crypto';
import { createReadStream, readFileSync } from 'node:fs';
import { writeWhole } from '../whole-file.ts';
import { inFolder, isSceneOf, recordPath } from './folder.ts';

export interface ItemRecord {
  /** Of the batch that the item is one of: `batch-file.ts`. */
  batch: string;
  /** SHA-256 of everything that the file depends on. */
  key: string;
  /** Path below the folder, with slashes. */
  file: string;
  bytes: number;
  /** Of the file. */
  sha256: string;
}

const HASH = /^[\da-f]{64}$/;

/** The record of an item; null where there is none that can be read. */
export function readRecord(folder: string, item: number): ItemRecord | null {
  let read: unknown;
  try {
    read = JSON.parse(readFileSync(inFolder(folder, recordPath(item)), 'utf8'));
  } catch (thrown) {
    // What was lost with the power of the machine is not JSON. What may not be read is another matter.
    if (thrown instanceof SyntaxError || (thrown as NodeJS.ErrnoException).code === 'ENOENT') return null;
    throw thrown;
  }
  return isRecord(item, read) ? read : null;
}

export function writeRecord(folder: string, item: number, { batch, key, file, bytes, sha256 }: ItemRecord): void {
  const record = { batch, key, file, bytes, sha256 };
  const text = `${JSON.stringify({ ...record, check: checkOf(record) })}\n`;
  writeWhole(inFolder(folder, recordPath(item)), Buffer.from(text));
}

function isRecord(item: number, read: unknown): read is ItemRecord {
  if (typeof read !== 'object' || read === null) return false;
  const { batch, key, file, bytes, sha256, check } = read as Partial<Record<keyof ItemRecord | 'check', unknown>>;
  const areHashes = [batch, key, sha256].every((hash) => typeof hash === 'string' && HASH.test(hash));
  if (!areHashes || !Number.isSafeInteger(bytes) || typeof file !== 'string' || !isSceneOf(item, file)) return false;
  return check === checkOf(read as ItemRecord);
}

/** Of the record itself: its key is in the Merkle root, and no file tells whether it is still what was written. */
function checkOf({ batch, key, file, bytes, sha256 }: ItemRecord): string {
  return sha256Of(JSON.stringify([batch, key, file, bytes, sha256]));
}

/** `whole`: the file is what the record says. */
export type FileState = 'whole' | 'missing' | 'corrupt';

/** Reads the whole file. */
export async function stateOf(folder: string, { file, bytes, sha256 }: ItemRecord): Promise<FileState> {
  const hash = createHash('sha256');
  let length = 0;
  try {
    for await (const piece of createReadStream(inFolder(folder, file))) {
      hash.update(piece as Buffer);
      length += (piece as Buffer).length;
      if (length > bytes) return 'corrupt';
    }
  } catch (thrown) {
    const { code } = thrown as NodeJS.ErrnoException;
    if (code === 'ENOENT' || code === 'ENOTDIR') return 'missing';
    // A folder in its place.
    if (code === 'EISDIR') return 'corrupt';
    throw thrown;
  }
  return length === bytes && hash.digest('hex') === sha256 ? 'whole' : 'corrupt';
}

export function sha256Of(bytes: Uint8Array | string): string {
  return createHash('sha256').update(bytes).digest('hex');
}
