/** What of a ZIP archive (PKWARE APPNOTE 6.3) may say where it comes from: a few of its files, read from its list of them. */

import { Refused } from './refused.ts';

const [END, ENTRY, FILE] = [0x06054b50, 0x02014b50, 0x04034b50];
/** The end of the archive with the longest comment; the longest list that is read; bytes of an entry in it, and of the head of its file. */
const [MOST_TAIL, MOST_LIST, ENTRY_HEAD, FILE_HEAD] = [22 + 0xffff, 1 << 20, 46, 30];
/** So many files are looked into, and so much of a compressed one. */
const [MOST_FILES, MOST_INFLATED] = [24, 1 << 18];
const [STORED, DEFLATED] = [0, 8];

/** In the order in which they are looked into: what is small first. */
const KINDS = [/\.json$/i, /\.png$/i, /\.glb$/i, /\.gltf$/i];

interface Entry {
  kind: number;
  method: number;
  size: number;
  at: number;
}

/**
 * The files that may hold a scene, each from its beginning; compressed ones as far as a scene can be told from.
 *
 * @throws {Refused} `broken`: the archive has no list of its files.
 */
export async function* zipEntries(zip: Blob): AsyncGenerator<Blob> {
  for (const { method, size, at } of (await listOf(zip)).slice(0, MOST_FILES)) {
    const head = new DataView(await zip.slice(at, at + FILE_HEAD).arrayBuffer());
    if (head.byteLength < FILE_HEAD || head.getUint32(0, true) !== FILE) throw new Refused('broken');
    const from = at + FILE_HEAD + head.getUint16(26, true) + head.getUint16(28, true);
    const data = zip.slice(from, from + size);
    if (method === STORED) yield data;
    else if (method === DEFLATED) yield await inflated(data);
  }
}

async function listOf(zip: Blob): Promise<Entry[]> {
  const from = Math.max(0, zip.size - MOST_TAIL);
  const tail = new DataView(await zip.slice(from).arrayBuffer());
  let end = tail.byteLength - 22;
  while (end >= 0 && tail.getUint32(end, true) !== END) end -= 1;
  if (end < 0) throw new Refused('broken');
  const [length, start] = [tail.getUint32(end + 12, true), tail.getUint32(end + 16, true)];
  if (length > MOST_LIST) throw new Refused('foreign');
  const list = new DataView(await zip.slice(start, start + length).arrayBuffer());
  const entries: Entry[] = [];
  for (let at = 0; at + ENTRY_HEAD <= list.byteLength; ) {
    if (list.getUint32(at, true) !== ENTRY) throw new Refused('broken');
    const nameLength = list.getUint16(at + 28, true);
    const name = new TextDecoder().decode(
      new Uint8Array(list.buffer, at + ENTRY_HEAD, Math.min(nameLength, list.byteLength - at - ENTRY_HEAD)),
    );
    const kind = KINDS.findIndex((pattern) => pattern.test(name));
    if (kind >= 0) {
      entries.push({ kind, method: list.getUint16(at + 10, true), size: list.getUint32(at + 20, true), at: list.getUint32(at + 42, true) });
    }
    at += ENTRY_HEAD + nameLength + list.getUint16(at + 30, true) + list.getUint16(at + 32, true);
  }
  return entries.sort((one, other) => one.kind - other.kind);
}

/** The beginning of what was compressed. */
async function inflated(data: Blob): Promise<Blob> {
  const reader = data.stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  try {
    for (let total = 0; total < MOST_INFLATED; ) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      total += value.length;
    }
  } catch (thrown) {
    throw new Refused('broken', { cause: thrown });
  } finally {
    reader.cancel().catch(() => undefined);
  }
  return new Blob(parts);
}
