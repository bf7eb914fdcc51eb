/**
 * The scene that a file shows: a PNG picture, a glTF file, JSON, or a ZIP archive with one of these.
 *
 * Files come from anywhere. Of each only its heads and the text of a few kB are read, whatever lengths it claims, and nothing is believed
 * before it has been checked. What the link says is checked by whoever reads links.
 */

import { gltfExtras } from '../gltf/gltf-extras.ts';
import { KEYWORD } from './origin.ts';
import { isPng, textOf } from './png-text.ts';
import { Refused } from './refused.ts';
import { zipEntries } from './zip-entries.ts';

/** What a file says of its scene, unchecked; words that it does not say are empty. */
export interface FileOrigin {
  link: string;
  hash: string;
  /** Of the package that wrote the file. */
  version: string;
  /** How it was written, of exports: the options that are not as they are by themselves. Of all files the scale. */
  options: Readonly<Record<string, unknown>>;
}

/** What brings a scene back. */
export type SceneInFile =
  | FileOrigin
  /** Parameters as code passes them. */
  | { request: Record<string, unknown> };

/** The longest text that is taken for parameters, bytes. */
const MOST_TEXT = 1 << 18;

const [GLB, ZIP, EMPTY_ZIP] = ['glTF', 'PK\x03\x04', 'PK\x05\x06'];
/** A JSON file with one of these is one of parameters. */
const PARAMETERS = ['preset', 'seed', 'layers', 'bases'];

/** @throws {Refused} saying why there is none. */
export async function sceneInFile(file: Blob): Promise<SceneInFile> {
  try {
    return await sceneIn(file, true);
  } catch (thrown) {
    // The browser cannot read it, or the engine runs out of its stack over its nesting.
    throw thrown instanceof Refused ? thrown : new Refused('broken', { cause: thrown });
  }
}

/** `isWhole`: it may be an archive, which an entry of an archive may not. */
async function sceneIn(file: Blob, isWhole: boolean): Promise<SceneInFile> {
  const head = new Uint8Array(await file.slice(0, 8).arrayBuffer());
  if (isPng(head)) return sceneOfOrigin(parsed((await textOf(file, KEYWORD)) ?? refuse('foreign')));
  const word = String.fromCharCode(...head.subarray(0, 4));
  if (word === GLB) return sceneOfGltf(await gltfExtras(file));
  if (word === ZIP || word === EMPTY_ZIP) return isWhole ? sceneInZip(file) : refuse('foreign');
  if (file.size > MOST_TEXT || file.size === 0) return refuse('foreign');
  return sceneOfJson(await file.text());
}

/** What was pasted: any text that is no JSON is taken for a link. */
export function sceneInText(text: string): SceneInFile {
  return text.length > MOST_TEXT || isJson(text) ? sceneOfJson(text) : { link: text.trim(), hash: '', version: '', options: {} };
}

function isJson(text: string): boolean {
  return text.trimStart().startsWith('{');
}

function sceneOfJson(text: string): SceneInFile {
  if (text.length > MOST_TEXT || !isJson(text)) return refuse('foreign');
  const json = parsed(text, 'foreign');
  if ('link' in json) return sceneOfOrigin(json);
  if (isObject(json.asset)) return sceneOfGltf([json.asset.extras, ...(Array.isArray(json.scenes) ? json.scenes : []).map(extrasOf)]);
  return PARAMETERS.some((key) => Object.hasOwn(json, key)) ? { request: json } : refuse('foreign');
}

function extrasOf(scene: unknown): unknown {
  return isObject(scene) ? scene.extras : undefined;
}

/** Of all that the extras of a glTF file say, the first that is a scene. */
function sceneOfGltf(all: readonly unknown[]): SceneInFile {
  const extras = all.find((one) => isObject(one) && typeof one.link === 'string');
  return isObject(extras) ? sceneOfOrigin(extras) : refuse('foreign');
}

function sceneOfOrigin({ link, hash, version, options, metresPerPixel }: Record<string, unknown>): SceneInFile {
  if (typeof link !== 'string') return refuse('broken');
  const text = (value: unknown): string => (typeof value === 'string' ? value : '');
  const scale = typeof metresPerPixel === 'number' ? { metresPerPixel } : {};
  return { link, hash: text(hash), version: text(version), options: { ...(isObject(options) ? options : {}), ...scale } };
}

/** The scene of the first entry that has one; what is wrong with others matters where none has. */
async function sceneInZip(file: Blob): Promise<SceneInFile> {
  let wrong = new Refused('foreign');
  for await (const entry of zipEntries(file)) {
    try {
      return await sceneIn(entry, false);
    } catch (thrown) {
      if (thrown instanceof Refused && thrown.reason === 'broken') wrong = thrown;
      else if (!(thrown instanceof Refused)) throw thrown;
    }
  }
  throw wrong;
}

/** An object written as JSON. */
function parsed(text: string, reason: Refused['reason'] = 'broken'): Record<string, unknown> {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    // As below.
  }
  return isObject(json) ? json : refuse(reason);
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function refuse(reason: Refused['reason']): never {
  throw new Refused(reason);
}
