/** The JSON of a glTF file and the bytes beside it, with everything checked that is asked for: each error names the thing at fault. */

import type { Words } from '../../base/language.ts';
import { MOST_BYTES } from './limits.ts';
import { shown } from '../../base/file-name.ts';
import { megabytes, refused } from './refusal.ts';

/** An object of the file. Nothing is known about its values before they are asked for. */
export type Item = Readonly<Record<string, unknown>>;

/** The lists of a file that are read. */
type List = 'accessors' | 'bufferViews' | 'buffers' | 'meshes' | 'nodes' | 'scenes';

const CHUNK = { json: 0x4e4f_534a, binary: 0x004e_4942 };
const HEAD = 12;

export class Gltf {
  readonly name: string;
  readonly #root: Item;
  readonly #binary: Uint8Array | undefined;
  readonly #buffers = new Map<number, Uint8Array>();

  constructor(root: Item, binary: Uint8Array | undefined, name: string) {
    this.name = name;
    this.#root = root;
    this.#binary = binary;
    const asset = this.object(root['asset'], 'asset');
    const version = String(asset['version']);
    if (!/^2(\.|$)/.test(version))
      throw this.unsupported({
        en: `it is glTF ${shown(version)}; save it as glTF 2.0`,
        ja: `glTF ${shown(version)} です。glTF 2.0 で保存してください`,
      });
  }

  /** The number of entries of a list. */
  count(list: List): number {
    const entries = this.#root[list] ?? [];
    if (!Array.isArray(entries)) throw this.broken({ en: `${list} is not a list`, ja: `${list} が配列ではありません` });
    return entries.length;
  }

  item(list: List, index: unknown): Item {
    if (typeof index !== 'number' || !Number.isInteger(index) || index < 0 || index >= this.count(list))
      throw this.broken({ en: `there is no ${list}[${shown(String(index))}]`, ja: `${list}[${shown(String(index))}] がありません` }, index);
    return this.object((this.#root[list] as unknown[])[index], `${list}[${index}]`);
  }

  /** The scene that the file opens with, where it says so. */
  get scene(): unknown {
    return this.#root['scene'];
  }

  isRequired(extension: string): boolean {
    const names = this.#root['extensionsRequired'];
    return Array.isArray(names) && names.includes(extension);
  }

  object(value: unknown, what: string): Item {
    if (typeof value !== 'object' || value === null || Array.isArray(value))
      throw this.broken({ en: `${what} is not an object`, ja: `${what} がオブジェクトではありません` });
    return value as Item;
  }

  list(value: unknown, what: string): readonly unknown[] {
    if (value === undefined) return [];
    if (!Array.isArray(value)) throw this.broken({ en: `${what} is not a list`, ja: `${what} が配列ではありません` });
    return value;
  }

  extension(item: Item, name: string, what: string): Item | undefined {
    const extensions = item['extensions'];
    if (extensions === undefined) return undefined;
    const found = this.object(extensions, `${what}.extensions`)[name];
    return found === undefined ? undefined : this.object(found, `${name} of ${what}`);
  }

  /** A number that counts: an integer from 0. */
  whole(item: Item, key: string, what: string, fallback?: number): number {
    const value = item[key] ?? fallback;
    if (typeof value !== 'number' || !Number.isSafeInteger(value) || value < 0)
      throw this.broken(
        {
          en: `${key} of ${what} is ${shown(String(value))}; it must be a whole number`,
          ja: `${what} の ${key} が ${shown(String(value))} です。整数でなければなりません`,
        },
        value,
      );
    return value;
  }

  numbers(item: Item, key: string, what: string, fallback: readonly number[]): readonly number[] {
    const value = item[key];
    if (value === undefined) return fallback;
    const isGood =
      Array.isArray(value) &&
      value.length === fallback.length &&
      value.every((number) => typeof number === 'number' && Number.isFinite(number));
    if (!isGood)
      throw this.broken({
        en: `${key} of ${what} must be ${fallback.length} numbers`,
        ja: `${what} の ${key} は ${fallback.length} 個の数値でなければなりません`,
      });
    return value as number[];
  }

  /** The bytes of a buffer, which is in the file itself. */
  buffer(index: unknown): Uint8Array {
    const buffer = this.item('buffers', index);
    const number = index as number;
    const length = this.whole(buffer, 'byteLength', `buffers[${number}]`);
    const bytes = this.#buffers.get(number) ?? this.#load(buffer, number);
    this.#buffers.set(number, bytes);
    if (bytes.length < length)
      throw this.broken(
        {
          en: `buffers[${number}] has ${bytes.length} of its ${length} bytes`,
          ja: `buffers[${number}] は ${length} バイト中 ${bytes.length} バイトしかありません`,
        },
        length,
      );
    return bytes.subarray(0, length);
  }

  #load(buffer: Item, index: number): Uint8Array {
    const { uri } = buffer;
    if (uri === undefined) {
      if (index !== 0 || !this.#binary)
        throw this.broken({ en: `buffers[${index}] has no bytes`, ja: `buffers[${index}] にデータがありません` });
      return this.#binary;
    }
    const [, encoded] = typeof uri === 'string' ? (/^data:[^,]*;base64,(.*)$/s.exec(uri) ?? []) : [];
    if (encoded === undefined) {
      const file = shown(String(uri).startsWith('data:') ? 'data:…' : String(uri));
      throw this.unsupported({
        en: `its geometry is in another file, ${file}; save it as one GLB file`,
        ja: `形状が別のファイル（${file}）にあります。1 つの GLB ファイルとして保存してください`,
      });
    }
    try {
      return Uint8Array.from(atob(encoded), (char) => char.charCodeAt(0));
    } catch {
      throw this.broken({ en: `buffers[${index}] is no base64`, ja: `buffers[${index}] が base64 ではありません` });
    }
  }

  broken(reason: Words, value?: unknown): Error {
    return refused(
      'LogFileBroken',
      { en: `${this.name} is no whole glTF file: ${reason.en}`, ja: `${this.name} は glTF ファイルとして壊れています：${reason.ja}` },
      { value },
    );
  }

  unsupported(reason: Words): Error {
    return refused('LogFileUnsupported', {
      en: `${this.name} cannot be read: ${reason.en}`,
      ja: `${this.name} は読み込めません：${reason.ja}`,
    });
  }

  tooLarge(what: string, bytes: number): Error {
    return refused(
      'LogFileTooLarge',
      {
        en: `${what} of ${this.name} unpacks to ${megabytes(bytes)}; at most ${megabytes(MOST_BYTES)} are read`,
        ja: `${this.name} の ${what} を展開すると ${megabytes(bytes)} になります（上限 ${megabytes(MOST_BYTES)}）`,
      },
      { value: bytes, max: MOST_BYTES },
    );
  }
}

/** A binary glTF file: a heading, the JSON, and the bytes of its first buffer. */
export function openGlb(bytes: Uint8Array, name: string): Gltf {
  const broken = (reason: Words) =>
    refused('LogFileBroken', {
      en: `${name} is no whole GLB file: ${reason.en}`,
      ja: `${name} は GLB ファイルとして壊れています：${reason.ja}`,
    });
  const cut = (length: number) =>
    broken({ en: `it has ${bytes.length} of ${length} bytes`, ja: `${length} バイト中 ${bytes.length} バイトしかありません` });
  if (bytes.length < HEAD) throw cut(HEAD);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const version = view.getUint32(4, true);
  if (version === 1) {
    throw refused('LogFileUnsupported', {
      en: `${name} cannot be read: it is glTF 1; save it as glTF 2.0`,
      ja: `${name} は読み込めません：glTF 1 です。glTF 2.0 で保存してください`,
    });
  }
  const length = view.getUint32(8, true);
  if (bytes.length < length) throw cut(length);
  let root: Item | undefined;
  let binary: Uint8Array | undefined;
  for (let at = HEAD; at + 8 <= length; ) {
    const [size, kind] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    if (at + 8 + size > length) throw cut(at + 8 + size);
    const chunk = bytes.subarray(at + 8, at + 8 + size);
    if (kind === CHUNK.json) root ??= parsed(new TextDecoder().decode(chunk), name);
    else if (kind === CHUNK.binary) binary ??= chunk;
    at += 8 + size;
  }
  if (!root) throw broken({ en: 'it has no description', ja: '記述がありません' });
  return new Gltf(root, binary, name);
}

/** A glTF file as text, with its buffers in it. */
export function openGltf(text: string, name: string): Gltf {
  const root = parsed(text, name);
  if (!('asset' in root)) {
    throw refused('LogFileUnknown', {
      en: `${name} is JSON, but neither a glTF nor an OBJ file`,
      ja: `${name} は JSON ですが、glTF ファイルではありません`,
    });
  }
  return new Gltf(root, undefined, name);
}

function parsed(text: string, name: string): Item {
  try {
    const root: unknown = JSON.parse(text);
    if (typeof root === 'object' && root !== null && !Array.isArray(root)) return root as Item;
  } catch {
    // Said below.
  }
  throw refused('LogFileBroken', {
    en: `${name} is no whole glTF file: its JSON cannot be read`,
    ja: `${name} は glTF ファイルとして壊れています：JSON を読み取れません`,
  });
}
