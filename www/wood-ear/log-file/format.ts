/** What a file is, by its content: names and types are missing or wrong too often. */

import type { Words } from '../../base/language.ts';
import { refused } from './refusal.ts';

export type Format = 'glb' | 'gltf' | 'obj';

interface Foreign {
  /** Of the first bytes, as Latin-1. */
  begins: RegExp;
  kind: Words;
}

/** Formats that people try, so that they are told what they have. */
const FOREIGN: readonly Foreign[] = [
  { begins: /^Kaydara FBX|^; FBX/, kind: { en: 'an FBX file', ja: 'FBX ファイル' } },
  { begins: /^ply[\r\n]/, kind: { en: 'a PLY file', ja: 'PLY ファイル' } },
  { begins: /^solid\b(?![\s\S]*\nv )/, kind: { en: 'an STL file', ja: 'STL ファイル' } },
  { begins: /^BLENDER|^\x28\xb5\x2f\xfd/, kind: { en: 'a Blender file', ja: 'Blender ファイル' } },
  { begins: /^PXR-USDC|^#usda/, kind: { en: 'a USD file', ja: 'USD ファイル' } },
  { begins: /^ISO-10303/, kind: { en: 'a STEP file', ja: 'STEP ファイル' } },
  { begins: /^\s*(<\?xml[\s\S]*?)?<COLLADA/, kind: { en: 'a COLLADA file', ja: 'COLLADA ファイル' } },
  { begins: /^\s*<(!doctype html|html)/i, kind: { en: 'a web page', ja: 'ウェブページ' } },
  {
    begins: /^(\s*(#[^\n]*)?[\r\n]+)*\s*newmtl\b/,
    kind: { en: 'a material library that belongs to an OBJ file', ja: 'OBJ 用の材質ファイル' },
  },
  { begins: /^\x89PNG|^\xff\xd8\xff/, kind: { en: 'a picture', ja: '画像' } },
];

/** Files that have a log in them, perhaps. */
const PACKED: readonly Foreign[] = [
  { begins: /^PK\x03\x04/, kind: { en: 'a ZIP archive', ja: 'ZIP ファイル' } },
  { begins: /^\x1f\x8b/, kind: { en: 'a gzip archive', ja: 'gzip ファイル' } },
  { begins: /^7z\xbc\xaf|^Rar!/, kind: { en: 'an archive', ja: '圧縮ファイル' } },
];

const HEAD = 4096;
/** Of a binary STL: a heading, the number of triangles, 50 bytes for each. */
const STL = { head: 84, triangle: 50, count: 80 };

/** @throws {RockFieldError} `LogFileUnknown` saying what the file is instead, where that is known. */
export function formatOf(bytes: Uint8Array, name: string): Format {
  const head = latin1(bytes.subarray(0, HEAD));
  if (head.startsWith('glTF')) return 'glb';
  if (/^(\xef\xbb\xbf)?\s*\{/.test(head)) return 'gltf';
  if (bytes.length === 0)
    throw refused('LogFileUnknown', {
      en: `${name} is empty: it is neither a GLB nor an OBJ file`,
      ja: `${name} は空です。GLB・OBJ ファイルではありません`,
    });
  const archive = PACKED.find(({ begins }) => begins.test(head));
  if (archive) {
    throw refused('LogFileUnknown', {
      en: `${name} is ${archive.kind.en}; unpack it and open the GLB or OBJ file in it`,
      ja: `${name} は${archive.kind.ja}です。展開して、中の GLB・OBJ ファイルを開いてください`,
    });
  }
  const foreign =
    FOREIGN.find(({ begins }) => begins.test(head))?.kind ?? (isBinaryStl(bytes) ? { en: 'an STL file', ja: 'STL ファイル' } : undefined);
  if (foreign) {
    throw refused('LogFileUnknown', {
      en: `${name} is ${foreign.en}, neither a GLB nor an OBJ file; save the log as one of those`,
      ja: `${name} は${foreign.ja}です。GLB か OBJ で保存してください`,
    });
  }
  return 'obj';
}

/** The text of a file in UTF-8, or in UTF-16 with or without a mark of its byte order. */
export function textOf(bytes: Uint8Array): string {
  const [a = 1, b = 1, c = 1, d = 1] = bytes;
  if ((a === 0xff && b === 0xfe) || (a !== 0 && b === 0 && c !== 0 && d === 0)) return new TextDecoder('utf-16le').decode(bytes);
  if ((a === 0xfe && b === 0xff) || (a === 0 && b !== 0 && c === 0 && d !== 0)) return new TextDecoder('utf-16be').decode(bytes);
  return new TextDecoder().decode(bytes);
}

function latin1(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}

function isBinaryStl(bytes: Uint8Array): boolean {
  if (bytes.length < STL.head) return false;
  const triangles = new DataView(bytes.buffer, bytes.byteOffset).getUint32(STL.count, true);
  return bytes.length === STL.head + STL.triangle * triangles;
}
