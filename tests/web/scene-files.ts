// Files that say which scene they show, for tests that read them.
import { deflateRawSync } from 'node:zlib';
import { PNG } from 'pngjs';
import { VERSION } from '../../www/data/version.ts';
import { KEYWORD, originOf } from '../../www/export/origin/origin.ts';
import { crc32, withText } from '../../www/export/origin/png-text.ts';
import type { SceneInFile } from '../../www/export/origin/scene-in-file.ts';

export const LINK = 'v=1&preset=riverbed&seed=7';
export const ORIGIN = originOf({ link: LINK, hash: 'c0ffee', metresPerPixel: 0.01 });
export const SCENE: SceneInFile = { link: LINK, hash: 'c0ffee', version: VERSION, options: { metresPerPixel: 0.01 } };

export const PIXELS = Buffer.from(PNG.sync.write(new PNG({ width: 9, height: 7 })));

export async function png(text = JSON.stringify(ORIGIN)): Promise<Buffer<ArrayBuffer>> {
  return Buffer.from(await withText(new Blob([PIXELS]), KEYWORD, text).arrayBuffer());
}

export function glb(json: string): Buffer<ArrayBuffer> {
  const text = Buffer.from(json.padEnd(Math.ceil(json.length / 4) * 4));
  const head = Buffer.alloc(20);
  head.write('glTF');
  [2, 20 + text.length, text.length].forEach((word, k) => head.writeUInt32LE(word, 4 + 4 * k));
  head.write('JSON', 16);
  return Buffer.concat([head, text]);
}

/** With a node for each rock, and nothing that says where it comes from but `asset` and `scene`. */
export function gltf(asset: object, scene: object, nodes = 3): string {
  const list = Array.from({ length: nodes }, (_, k) => ({ name: `rock "${k}" {[\\`, extras: { asset: { extras: { link: 'no' } } } }));
  return JSON.stringify({ nodes: list, asset: { version: '2.0', ...asset }, scenes: [{ name: 'a', ...scene }], meshes: [] });
}

export function zip(files: [name: string, bytes: Buffer, isDeflated?: boolean][], comment = ''): Buffer<ArrayBuffer> {
  const parts: Buffer[] = [];
  const list: Buffer[] = [];
  let at = 0;
  for (const [name, bytes, isDeflated = false] of files) {
    const data = isDeflated ? deflateRawSync(bytes) : bytes;
    const head = Buffer.alloc(30);
    head.writeUInt32LE(0x04034b50);
    head.writeUInt16LE(isDeflated ? 8 : 0, 8);
    [crc32(bytes), data.length, bytes.length].forEach((word, k) => head.writeUInt32LE(word, 14 + 4 * k));
    head.writeUInt16LE(name.length, 26);
    const entry = Buffer.alloc(46);
    entry.writeUInt32LE(0x02014b50);
    head.copy(entry, 6, 4, 30);
    entry.writeUInt32LE(at, 42);
    list.push(entry, Buffer.from(name));
    parts.push(head, Buffer.from(name), data);
    at += 30 + name.length + data.length;
  }
  const listed = Buffer.concat(list);
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50);
  [files.length, files.length].forEach((count, k) => end.writeUInt16LE(count, 8 + 2 * k));
  [listed.length, at].forEach((word, k) => end.writeUInt32LE(word, 12 + 4 * k));
  end.writeUInt16LE(comment.length, 20);
  return Buffer.concat([...parts, listed, end, Buffer.from(comment)]);
}
