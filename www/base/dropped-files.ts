/** The files that are dragged over a page and dropped on it. */

import type { Words } from './language.ts';

/** What is said of a drop without any. */
export const NO_FILES: Words = { en: 'There is no file in what was dropped', ja: 'ドロップされたものにファイルがありません' };

/** Whether a drag carries files. What they are is not known before they are dropped. */
export function hasFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes('Files') ?? false;
}

/** Of a folder that was dropped, the first so many files are looked at. */
const MOST_FILES = 1000;

/** The files of a drop, with those in folders. To be called while the event is told: later there is nothing in it. */
export async function droppedFiles(transfer: DataTransfer | null): Promise<File[]> {
  const files = [...(transfer?.files ?? [])];
  const entries = [...(transfer?.items ?? [])].flatMap((item) => item.webkitGetAsEntry?.() ?? []);
  if (!entries.some(({ isDirectory }) => isDirectory)) return files;
  const found: File[] = [];
  for (const entry of entries) {
    if (entries.length + found.length > MOST_FILES) break;
    if (isFolder(entry)) entries.push(...(await entriesOf(entry)));
    else found.push(await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)));
  }
  return found;
}

function isFolder(entry: FileSystemEntry): entry is FileSystemDirectoryEntry {
  return entry.isDirectory;
}

/** Browsers hand out some hundred at a time. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0 || found.length >= MOST_FILES) return found;
    found.push(...some);
  }
}
