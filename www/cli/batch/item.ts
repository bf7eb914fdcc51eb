/** One item of a batch, in a worker: it is left as it is where it is there and whole, and else made. */

import type { ExportNote } from '../../export/file.ts';
import { endingOf } from '../export-tasks.ts';
import { writeWhole } from '../whole-file.ts';
import type { Work } from '../work.ts';
import { inFolder, scenePath } from './folder.ts';
import type { Item } from './list.ts';
import { readRecord, stateOf, writeRecord } from './record.ts';
import type { ItemRecord } from './record.ts';

/** What a worker is sent. */
export interface BatchTask extends Item {
  folder: string;
  /** Of the batch. */
  batch: string;
  /** Of the item. */
  key: string;
}

export interface ItemDone extends Pick<ItemRecord, 'file' | 'bytes' | 'sha256'> {
  status: 'made' | 'skipped';
  /** What the file could not have; of one that was there nothing is known. */
  notes: readonly ExportNote[];
}

/**
 * The same item may be made by several processes at once: their files are the same, and each appears whole.
 *
 * @throws whatever the generator, the exporter or the file system says.
 */
export async function doItem({ folder, index, batch, key, scene, given, options }: BatchTask, work: Work): Promise<ItemDone> {
  const before = readRecord(folder, index);
  if (before && before.batch === batch && before.key === key && (await stateOf(folder, before)) === 'whole') {
    const { file, bytes, sha256 } = before;
    return { status: 'skipped', file, bytes, sha256, notes: [] };
  }
  const file = scenePath(index, `${scene.preset}-${scene.seed}.${endingOf(options)}`);
  // The bytes, since the record is of them, whatever becomes of the file.
  const { data, bytes, sha256, notes } = await work.do(
    { scene, wanted: { as: 'export', options: given }, file: null, isWatched: false },
    () => undefined,
  );
  writeWhole(inFolder(folder, file), data!);
  writeRecord(folder, index, { batch, key, file, bytes, sha256 });
  return { status: 'made', file, bytes, sha256, notes };
}
