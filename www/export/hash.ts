/**
 * The hash that a file carries of the scene it shows: SHA-256 of all buffers, the same as in `tests/data/golden.json`. Whoever brings the scene
 * back can tell whether it is the same to the last bit.
 *
 * Not `crypto.subtle`: pages without https have none, and it would take a copy of all buffers in one.
 */

import { sha256 } from '@noble/hashes/sha2.js';
import { bytesToHex } from '@noble/hashes/utils.js';

/** Bytes that are hashed at a time: some 5 ms. */
const SLICE = 1 << 20;

/** At once, for workers and Node. */
export function hashOf(buffers: Iterable<ArrayBufferView>): string {
  const hash = sha256.create();
  for (const bytes of slicesOf(buffers)) hash.update(bytes);
  return bytesToHex(hash.digest());
}

/** In slices, between which a page can do other things. */
export async function hashInSlices(buffers: Iterable<ArrayBufferView>): Promise<string> {
  const hash = sha256.create();
  for (const bytes of slicesOf(buffers)) {
    hash.update(bytes);
    if (bytes.length === SLICE) await new Promise((resolve) => setTimeout(resolve));
  }
  return bytesToHex(hash.digest());
}

/** Typed arrays are little-endian on every machine that a browser runs on. */
function* slicesOf(buffers: Iterable<ArrayBufferView>): Generator<Uint8Array<ArrayBuffer>> {
  for (const { buffer, byteOffset, byteLength } of buffers) {
    for (let at = 0; at < byteLength; at += SLICE) {
      yield new Uint8Array(buffer as ArrayBuffer, byteOffset + at, Math.min(SLICE, byteLength - at));
    }
  }
}
