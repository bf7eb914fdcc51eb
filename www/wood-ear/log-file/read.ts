/** The one place that knows files: bytes in, a log out. Runs in a worker of its own (`entries/wood-ear-file-worker.ts`); in Node as it is. */

import { RockFieldError } from '../../base/errors.ts';
import { formatOf, textOf } from './format.ts';
import { openGlb, openGltf } from './gltf-json.ts';
import { readGltf } from './gltf.ts';
import { MOST_BYTES } from './limits.ts';
import { logOf } from './mesh.ts';
import type { LogFile, Soup } from './mesh.ts';
import { readObj } from './obj.ts';
import { shown } from '../../base/file-name.ts';
import { megabytes, refused } from './refusal.ts';

export type { LogFile };

/** Share of the work that is left when the triangles are read. */
const REST = 0.2;

export interface ReadOptions {
  /** 0 … 1, some 60 times. */
  onProgress?: (fraction: number) => void;
}

/**
 * The log in a file: the triangles of all its meshes.
 *
 * @throws {RockFieldError} `LogFileTooLarge`, `LogFileUnreadable`, `LogFileUnknown` (neither GLB nor OBJ), `LogFileUnsupported`,
 *   `LogFileBroken`, `LogFileNoMesh`, `LogTooLarge` or `LogNoArea`; the message says what is wrong, and where.
 */
export async function readLogFile(file: Blob & { name?: string }, { onProgress = () => {} }: ReadOptions = {}): Promise<LogFile> {
  const name = shown(file.name || '') || 'the file';
  if (file.size > MOST_BYTES) {
    throw refused(
      'LogFileTooLarge',
      {
        en: `${name} is ${megabytes(file.size)}; a log file may be at most ${megabytes(MOST_BYTES)}`,
        ja: `${name} は ${megabytes(file.size)} です。丸太のファイルは ${megabytes(MOST_BYTES)} までです`,
      },
      { value: file.size, max: MOST_BYTES },
    );
  }
  const bytes = await bytesOf(file, name);
  try {
    const soup = await soupOf(bytes, name, (fraction) => onProgress((1 - REST) * fraction));
    onProgress(1 - REST);
    return logOf(soup, name);
  } catch (thrown) {
    if (thrown instanceof RockFieldError) throw thrown;
    const reason = thrown instanceof Error ? thrown.message : String(thrown);
    throw refused('LogFileBroken', { en: `${name} cannot be read (${shown(reason)})`, ja: `${name} を読み込めません（${shown(reason)}）` });
  }
}

async function bytesOf(file: Blob, name: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    // Deleted or changed since it was chosen, forbidden, or a folder.
    throw refused('LogFileUnreadable', {
      en: `${name} could not be read: it is a folder, or it has been moved or changed since it was chosen`,
      ja: `${name} を読み取れません。フォルダーであるか、選択後に移動または変更されています`,
    });
  }
}

function soupOf(bytes: Uint8Array, name: string, onProgress: (fraction: number) => void): Promise<Soup> | Soup {
  switch (formatOf(bytes, name)) {
    case 'glb':
      return readGltf(openGlb(bytes, name), onProgress);
    case 'gltf':
      return readGltf(openGltf(textOf(bytes), name), onProgress);
    case 'obj':
      return readObj(textOf(bytes), name, onProgress);
  }
}
