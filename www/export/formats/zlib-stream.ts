/** Zlib (RFC 1950) in pieces, for what is too large to be compressed in one. */

import type { FlateStreamHandler, ZlibOptions } from 'fflate';
import { Zlib } from 'fflate';

/** What fflate remembers from piece to piece: `l` whether it was the last, and in its buffer where it goes on, where the next block begins, and where the data end. */
interface State {
  l: number;
  i: number;
  w: number;
  z: number;
}

/**
 * A stream of fflate.
 *
 * That of fflate 0.8.3 begins with 32 kB of zeros for a dictionary, whether there is one or not, and takes zeros of the data for a repetition of
 * those: readers say “invalid distance too far back”. So it is told that it has no data yet.
 */
export function zlibStream(level: NonNullable<ZlibOptions['level']>, onData: FlateStreamHandler): Zlib {
  const stream = new Zlib({ level }, onData);
  (stream as unknown as { s: State }).s = { l: 0, i: 0, w: 0, z: 0 };
  return stream;
}
