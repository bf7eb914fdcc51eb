/** Scenes out of files that were made here, in the words that everybody understands. */

import { notConnected, RockFieldError } from '../base/errors.ts';
import type { ErrorName } from '../base/errors.ts';
import { shown } from '../base/file-name.ts';
import { filled } from '../base/filled.ts';
import type { Words } from '../base/language.ts';
import { Refused } from '../export/origin/refused.ts';
import { isPng } from '../export/origin/png-text.ts';
import { sceneInFile, sceneInText } from '../export/origin/scene-in-file.ts';
import type { SceneInFile } from '../export/origin/scene-in-file.ts';
import { isLink } from '../table/link.ts';
import type { DecodedLink } from '../table/link.ts';
import type { Kind, Table } from '../table/table.ts';

/** What reads the links of a generator. */
export interface LinkReading<K extends Kind> {
  table: Table<K>;
  decode(text: string): DecodedLink<K>;
}

/** `hash`: of the buffers that the scene had; empty where the file does not say. */
export type ImportedScene<K extends Kind> = DecodedLink<K> & { hash: string };

const WORDS = {
  ImportForeign: {
    en: '{file} brings no scene back: it was not made here, or what it said of its scene was taken out of it',
    ja: '{file} にはシーンの情報がありません。ここで作られたファイルではないか、情報が取り除かれています。',
  },
  ImportBroken: {
    en: '{file} is damaged: the scene in it cannot be read',
    ja: '{file} は壊れているため、シーンを読み込めません。',
  },
  ImportOther: {
    en: '{file} shows a scene of another kind',
    ja: '{file} は別の種類のシーンです。',
  },
} as const satisfies Partial<Record<ErrorName, Words>>;

/**
 * The scene that a file, or a text that was pasted, brings back. What is wrong with its link is replaced, with a notice, as in any other link.
 *
 * @throws {RockFieldError} `ImportForeign`, `ImportBroken`; `ImportOther` where it is one of another generator; about a parameter of JSON.
 */
export async function importedScene<K extends Kind>(reading: LinkReading<K>, file: Blob | string): Promise<ImportedScene<K>> {
  let found: SceneInFile;
  try {
    found = typeof file === 'string' ? sceneInText(file) : await sceneInFile(file);
  } catch (thrown) {
    if (thrown instanceof Refused && thrown.reason === 'foreign') throw refused('ImportForeign', file, thrown);
    throw refused('ImportBroken', file, thrown);
  }
  if ('link' in found) return { ...sceneOfLink(reading, found.link, file), hash: found.hash };
  return { ...sceneOfRequest(reading, found.request, file), hash: '' };
}

function sceneOfLink<K extends Kind>({ table, decode }: LinkReading<K>, link: string, file: Blob | string): DecodedLink<K> {
  if (!isLink(table, link)) throw refused('ImportForeign', file);
  const scene = decode(link);
  if (scene.notices.some(({ code }) => code === 'unknown-preset')) throw refused('ImportOther', file);
  return scene;
}

/** Only of what is made: it is seen as the preset is. */
function sceneOfRequest<K extends Kind>({ table }: LinkReading<K>, request: Record<string, unknown>, file: Blob | string): DecodedLink<K> {
  const { presets, views } = table;
  const preset = request.preset === undefined ? presets[0] : presets.find(({ name }) => name === request.preset);
  if (!preset) throw refused('ImportOther', file);
  const params = table.resolve(request);
  return { params, preset: preset.name, view: views[0] ?? '3d', color: null, camera: null, notices: [] };
}

function refused(name: keyof typeof WORDS, file: Blob | string, cause?: unknown): RockFieldError {
  const given = shown((file as Partial<File>).name ?? '');
  const what = typeof file === 'string' ? { en: 'what was pasted', ja: '貼り付けた内容' } : { en: 'the file', ja: 'このファイル' };
  const [en, ja] = [filled(WORDS[name].en, { file: given || what.en }), filled(WORDS[name].ja, { file: given || what.ja })];
  return new RockFieldError({ name, message: en, words: { en, ja } }, { cause });
}

/** The same for an element, which has to be in a document before and after the file has been read. */
export async function importFile<K extends Kind>(reading: LinkReading<K>, element: Node, file: Blob): Promise<ImportedScene<K>> {
  if (!element.isConnected) throw notConnected();
  const scene = await importedScene(reading, file);
  if (!element.isConnected) throw notConnected();
  return scene;
}

/** Whether a file that could also be something else is to be taken for a scene: one that says so, or a picture, which is nothing else. */
export async function isSceneFile(file: Blob): Promise<boolean> {
  try {
    await sceneInFile(file);
    return true;
  } catch {
    return isPng(
      new Uint8Array(
        await file
          .slice(0, 8)
          .arrayBuffer()
          .catch(() => new ArrayBuffer(0)),
      ),
    );
  }
}
