/** The manifest of a batch that is complete: every item with its file, and one hash for all of them. */

import { existsSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import path from 'node:path';
import { isAbandoned, writeWhole } from '../whole-file.ts';
import { checkFolder } from './check.ts';
import type { Checked, Finding } from './check.ts';
import { MANIFEST } from './folder.ts';
import { MerkleTree } from './merkle.ts';

export interface Merged extends Checked {
  /** Null where something is missing or corrupt. */
  merkle: string | null;
}

/** Checks a folder; `onLine` is told what the manifest says of each item, in order. */
async function examine(folder: string, onFinding: (finding: Finding) => void, onLine?: (line: string) => void): Promise<Merged> {
  const tree = new MerkleTree();
  const checked = await checkFolder(folder, onFinding, (_, record) => {
    if (!record) return;
    const { key, file, bytes, sha256 } = record;
    tree.add(Buffer.from(key, 'hex'), Buffer.from(sha256, 'hex'));
    onLine?.(JSON.stringify([file, bytes, sha256, key]));
  });
  return { ...checked, merkle: checked.whole === checked.batch.items ? tree.root() : null };
}

/** Checks a folder, and its manifest where it has one. */
export async function verify(folder: string, onFinding: (finding: Finding) => void): Promise<Merged> {
  const file = path.join(folder, MANIFEST);
  if (!existsSync(file)) return examine(folder, onFinding);
  const lines: string[] = [];
  const found = await examine(folder, onFinding, (line) => lines.push(line));
  if (found.merkle === null || readFileSync(file).equals(manifestOf(found, lines))) return found;
  onFinding({ status: 'foreign', file: MANIFEST });
  return { ...found, foreign: found.foreign + 1 };
}

/** A line for each item, so that other programs can read it by lines, and people can compare two of them. */
function manifestOf({ batch, bytes, merkle }: Merged, lines: readonly string[]): Buffer {
  const head = JSON.stringify({ version: batch.version, items: batch.items, bytes, merkle, list: batch.list, options: batch.options });
  return Buffer.from(`${head.slice(0, -1)},"files":[\n${lines.join(',\n')}\n]}\n`);
}

/**
 * Writes the manifest of a folder in which nothing is missing or corrupt. Its bytes depend on the items alone: not on shards, machines, or how often
 * anything was repeated.
 */
export async function merge(folder: string, onFinding: (finding: Finding) => void): Promise<Merged> {
  const lines: string[] = [];
  const merged = await examine(folder, onFinding, (line) => lines.push(line));
  if (merged.merkle === null) return merged;
  writeWhole(path.join(folder, MANIFEST), manifestOf(merged, lines));
  clearTemporary(folder);
  return merged;
}

/** Everything is there, so that whatever a killed run has left can go, also one of another machine. */
function clearTemporary(folder: string): void {
  for (const name of readdirSync(folder, { recursive: true, encoding: 'utf8' })) {
    const own = path.basename(name);
    if (isAbandoned(own) || /^\.batch\.json-.*\.tmp$/.test(own)) rmSync(path.join(folder, name), { force: true });
  }
}
