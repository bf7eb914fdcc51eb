/**
 * What is there of a batch, and what is not: every file is read and compared with its record, and whatever else lies between the files is named.
 */

import { readdirSync } from 'node:fs';
import path from 'node:path';
import { misuse } from '../failures.ts';
import { idOf, readBatch } from './batch-file.ts';
import type { Batch } from './batch-file.ts';
import { BATCH, PER_FOLDER, RECORDS, SCENES, groupOf, inFolder, recordPath } from './folder.ts';
import { readRecord, stateOf } from './record.ts';
import type { ItemRecord } from './record.ts';

/** What is wrong. */
export type Finding =
  /** `missing`: to be made yet. `corrupt`: not what was written; to be made again. */
  | { status: 'missing' | 'corrupt'; index: number; file?: string }
  /** A file that belongs to no item, or a manifest that is not of these files. */
  | { status: 'foreign'; file: string };

export interface Checked {
  batch: Batch;
  /** Items whose files are whole. */
  whole: number;
  bytes: number;
  missing: number;
  corrupt: number;
  foreign: number;
}

/** Files that are read at a time: on network drives each waits for its turn. */
const AT_ONCE = 8;

/**
 * @param onWhole is told of every item in order, null of one that is not whole.
 * @throws {Ending} where the folder is none of a batch.
 */
export async function checkFolder(
  folder: string,
  onFinding: (finding: Finding) => void,
  onItem: (index: number, record: ItemRecord | null) => void,
): Promise<Checked> {
  const batch = readBatch(folder);
  if (!batch) throw misuse(`${folder} is no folder of a batch: there is no ${BATCH} in it`);
  const id = idOf(batch);
  const checked: Checked = { batch, whole: 0, bytes: 0, missing: 0, corrupt: 0, foreign: 0 };
  const tell = (finding: Finding): void => {
    checked[finding.status] += 1;
    onFinding(finding);
  };
  for (let first = 0; first < batch.items; first += PER_FOLDER) {
    const group = Array.from({ length: Math.min(PER_FOLDER, batch.items - first) }, (_, k) => first + k);
    const known = new Set<string>(group.map(recordPath));
    for (let at = 0; at < group.length; at += AT_ONCE) {
      const some = await Promise.all(group.slice(at, at + AT_ONCE).map((index) => checkItem(folder, id, index)));
      for (const { index, record, finding } of some) {
        if (record) known.add(record.file);
        if (finding) tell(finding);
        else if (record) {
          checked.whole += 1;
          checked.bytes += record.bytes;
        }
        onItem(index, finding ? null : record);
      }
    }
    for (const file of [SCENES, RECORDS].flatMap((name) => filesIn(folder, `${name}/${groupOf(first)}`)))
      if (!known.has(file) && !isUnrecorded(file, known)) tell({ status: 'foreign', file });
  }
  for (const file of strangeFolders(folder, batch.items)) tell({ status: 'foreign', file });
  return checked;
}

async function checkItem(
  folder: string,
  batch: string,
  index: number,
): Promise<{ index: number; record: ItemRecord | null; finding?: Finding }> {
  const record = readRecord(folder, index);
  // One that was copied here from another folder tells nothing.
  if (!record || record.batch !== batch) return { index, record: null, finding: { status: 'missing', index } };
  const state = await stateOf(folder, record);
  return state === 'whole' ? { index, record } : { index, record, finding: { status: state, index, file: record.file } };
}

/** Whether it is the file of an item whose record was not written any more: that the item is missing has been told. */
function isUnrecorded(file: string, known: ReadonlySet<string>): boolean {
  const [, number] = /^scenes\/\d{3}\/(\d{6})-/.exec(file) ?? [];
  if (number === undefined) return false;
  const item = Number(number);
  const others = [...known].some((path) => path.startsWith(`${SCENES}/${groupOf(item)}/${number}-`));
  return known.has(recordPath(item)) && !others;
}

/** Paths below the folder, in order. What begins with a point is of the system, or of a run that is under way or was killed. */
function filesIn(folder: string, below: string): string[] {
  return namesIn(inFolder(folder, below)).map((name) => `${below}/${name}`);
}

function namesIn(folder: string): string[] {
  try {
    return readdirSync(folder)
      .filter((name) => !name.startsWith('.'))
      .sort();
  } catch (thrown) {
    const { code } = thrown as NodeJS.ErrnoException;
    if (code === 'ENOENT' || code === 'ENOTDIR') return [];
    throw thrown;
  }
}

/** Below `scenes` and `records`, whatever is no folder of items of this batch. */
function strangeFolders(folder: string, items: number): string[] {
  const groups = new Set(Array.from({ length: Math.ceil(items / PER_FOLDER) }, (_, k) => groupOf(k * PER_FOLDER)));
  return [SCENES, RECORDS].flatMap((below) =>
    namesIn(path.join(folder, below))
      .filter((name) => !groups.has(name))
      .map((name) => `${below}/${name}`),
  );
}
