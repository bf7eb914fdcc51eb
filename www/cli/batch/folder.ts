/**
 * What is where in the folder of a batch:
 *
 *     batch.json                               what the folder is for; written before anything else
 *     scenes/000/000017-riverbed-7.glb         the file of item 17
 *     records/000/000017.json                  what is known of it; written after it
 *     manifest.json                            all items; written last, by `batch merge`
 *
 * No folder has more than a thousand files. A name depends on the item alone, never on the shard or the machine that makes it.
 */

import path from 'node:path';

/** As many as six digits count. */
export const MOST_ITEMS = 1_000_000;
/** Items in a folder. */
export const PER_FOLDER = 1000;

export const [BATCH, MANIFEST, SCENES, RECORDS] = ['batch.json', 'manifest.json', 'scenes', 'records'];

const SCENE = /^scenes\/(\d{3})\/((\d{3})\d{3})-[\w.-]+$/;

/** The name of the folder that an item's files are in. */
export function groupOf(item: number): string {
  return String(Math.floor(item / PER_FOLDER)).padStart(3, '0');
}

/** The path of an item's file below the folder, with slashes; `name` is what an export calls it. */
export function scenePath(item: number, name: string): string {
  return `${SCENES}/${groupOf(item)}/${numbered(item)}-${name}`;
}

export function recordPath(item: number): string {
  return `${RECORDS}/${groupOf(item)}/${numbered(item)}.json`;
}

/** Whether a path that was read somewhere is one of the item's file, and leads nowhere else. */
export function isSceneOf(item: number, file: string): boolean {
  const [, group, number, of] = SCENE.exec(file) ?? [];
  return number === numbered(item) && group === of;
}

/** The path of a file of the batch as the system writes it. */
export function inFolder(folder: string, file: string): string {
  return path.join(folder, ...file.split('/'));
}

function numbered(item: number): string {
  return String(item).padStart(6, '0');
}
