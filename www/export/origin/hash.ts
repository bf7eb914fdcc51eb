/**
 * The hash that a file carries of the scene it shows: SHA-256 of all buffers, the same as in `tests/data/golden.json`. Whoever brings the scene
 * back can tell whether it is the same to the last bit.
 *
 * `crypto.subtle` is ten times as fast, but pages without https have none, and it takes a copy of all buffers in one.
 */

import { sha256 } from '@noble/hashes/sha2.js';
import { bytesToHex } from '@noble/hashes/utils.js';

/** Bytes that are hashed at a time: some 5 ms. */
const SLICE = 1 << 20;
/** Bytes of which no copy is made. */
const MUCH = 1 << 26;

/** At once, for workers and Node. */
export function hashOf(buffers: Iterable<ArrayBufferView>): string {
  const hash = sha256.create();
  for (const bytes of slicesOf(buffers)) hash.update(bytes);
  return bytesToHex(hash.digest());
}

/** Beside other things that a page does, or in slices between them. */
export async function hashInSlices(buffers: readonly ArrayBufferView[]): Promise<string> {
  const length = buffers.reduce((sum, { byteLength }) => sum + byteLength, 0);
  const { subtle } = globalThis.crypto ?? {};
  if (subtle && length <= MUCH) return bytesToHex(new Uint8Array(await subtle.digest('SHA-256', joined(buffers, length))));
  const hash = sha256.create();
  for (const bytes of slicesOf(buffers)) {
    hash.update(bytes);
    if (bytes.length === SLICE) await new Promise((resolve) => setTimeout(resolve));
  }
  return bytesToHex(hash.digest());
}

function joined(buffers: Iterable<ArrayBufferView>, length: number): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(length);
  let at = 0;
  for (const { buffer, byteOffset, byteLength } of buffers) {
    all.set(new Uint8Array(buffer, byteOffset, byteLength), at);
    at += byteLength;
  }
  return all;
}

/** Typed arrays are little-endian on every machine that a browser runs on. */
function* slicesOf(buffers: Iterable<ArrayBufferView>): Generator<Uint8Array<ArrayBuffer>> {
  for (const { buffer, byteOffset, byteLength } of buffers) {
    for (let at = 0; at < byteLength; at += SLICE) {
      yield new Uint8Array(buffer as ArrayBuffer, byteOffset + at, Math.min(SLICE, byteLength - at));
    }
  }
}
