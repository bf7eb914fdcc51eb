/**
 * Text in PNG files: chunks of the type iTXt (PNG specification, 11.3.3.4), which are UTF-8. A file stays as it is but for the chunk that is
 * added; its pixels are not looked at.
 */

import { Refused } from './refused.ts';

export const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
/** Signature and header chunk, which comes first. */
const HEAD = 8 + 25;
/** Length and type before a chunk's data, and the checksum after it. */
const AROUND = 12;
/** The longest text that is read or written, bytes. */
export const MOST_TEXT = 65_536;
/** So much of a file is looked at in one go, so many times, and so many texts: a file of a million chunks takes no longer than others. */
const [WINDOW, MOST_WINDOWS, MOST_TEXTS] = [4096, 2048, 256];

/** A chunk with `text` under a keyword of at most 79 Latin letters. */
export function textChunk(keyword: string, text: string): Uint8Array<ArrayBuffer> {
  // Not compressed, no language, and no keyword in that language.
  const data = new TextEncoder().encode(`${keyword}\0\0\0\0\0${text}`);
  if (data.length > MOST_TEXT) throw new RangeError(`the text has ${data.length} bytes; it may have at most ${MOST_TEXT}`);
  const chunk = new Uint8Array(AROUND + data.length);
  const view = new DataView(chunk.buffer);
  view.setUint32(0, data.length);
  chunk.set([0x69, 0x54, 0x58, 0x74], 4);
  chunk.set(data, 8);
  view.setUint32(8 + data.length, crc32(chunk.subarray(4, 8 + data.length)));
  return chunk;
}

/** The PNG file with the text in it, after its header: whoever looks for it need not read on. */
export function withText(png: Blob, keyword: string, text: string): Blob {
  return new Blob([png.slice(0, HEAD), textChunk(keyword, text), png.slice(HEAD)], { type: png.type });
}

export function isPng(head: Uint8Array): boolean {
  return SIGNATURE.every((byte, k) => head[k] === byte);
}

/**
 * The text under `keyword` in a PNG file; undefined where it has none. Of the file nothing is read but the heads of chunks and that text.
 *
 * @throws {Refused} `broken`: the chunk, or one before it, is not as the specification has it.
 */
export async function textOf(png: Blob, keyword: string): Promise<string | undefined> {
  let at = SIGNATURE.length;
  let texts = 0;
  for (let windows = 0; windows < MOST_WINDOWS; windows += 1) {
    const from = at;
    const bytes = new Uint8Array(await png.slice(from, from + WINDOW).arrayBuffer());
    const view = new DataView(bytes.buffer);
    // A chunk whose head is whole in the window.
    while (at - from + 8 <= bytes.length) {
      const length = view.getUint32(at - from);
      const type = String.fromCharCode(...bytes.subarray(at - from + 4, at - from + 8));
      if (!/^[a-z]{4}$/i.test(type) || length > 0x7fff_ffff) throw new Refused('broken');
      if (type === 'IEND') return undefined;
      if (type === 'iTXt' && length <= MOST_TEXT) {
        texts += 1;
        if (texts > MOST_TEXTS) return undefined;
        const text = await readChunk(png, at, length, keyword);
        if (text !== undefined) return text;
      }
      at += AROUND + length;
    }
    if (at === from || at >= png.size) throw new Refused('broken');
  }
  return undefined;
}

async function readChunk(png: Blob, at: number, length: number, keyword: string): Promise<string | undefined> {
  const chunk = new Uint8Array(await png.slice(at, at + AROUND + length).arrayBuffer());
  if (chunk.length < AROUND + length) throw new Refused('broken');
  const data = chunk.subarray(8, 8 + length);
  const isOurs = keyword.length < data.length && data[keyword.length] === 0 && latin(data.subarray(0, keyword.length)) === keyword;
  if (!isOurs) return undefined;
  if (crc32(chunk.subarray(4, 8 + length)) !== new DataView(chunk.buffer).getUint32(8 + length)) throw new Refused('broken');
  // Two bytes say how it is compressed; then come a language and the keyword in it, both up to a zero.
  if (data[keyword.length + 1] !== 0) throw new Refused('broken');
  const language = data.indexOf(0, keyword.length + 3);
  const keywordInIt = language < 0 ? -1 : data.indexOf(0, language + 1);
  if (keywordInIt < 0) throw new Refused('broken');
  return new TextDecoder().decode(data.subarray(keywordInIt + 1));
}

function latin(bytes: Uint8Array): string {
  return String.fromCharCode(...bytes);
}

/** By byte. */
const TABLE = /* @__PURE__ */ Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; bit += 1) rest = rest & 1 ? 0xedb8_8320 ^ (rest >>> 1) : rest >>> 1;
  return rest;
});

/** The checksum of PNG and ZIP (ISO 3309), of type and data of a chunk. */
export function crc32(bytes: Uint8Array, before = 0): number {
  let rest = ~before;
  for (const byte of bytes) rest = TABLE[(rest ^ byte) & 0xff]! ^ (rest >>> 8);
  return ~rest >>> 0;
}
