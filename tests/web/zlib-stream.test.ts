// What PNG files are compressed by: every reader has to be able to read it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { zlibStream } from '../../www/export/formats/zlib-stream.ts';

/** Runs of a few values, as rows of maps have after their filters. */
function runs(length: number, random: () => number): Uint8Array {
  let value = 0;
  return Uint8Array.from({ length }, () => {
    if (random() < 0.05) value = Math.floor(random() * 4);
    return value;
  });
}

test('what is compressed in pieces of any length is what was given', () => {
  let seed = 1;
  const random = (): number => {
    seed = (Math.imul(seed, 1_103_515_245) + 12_345) >>> 0;
    return seed / 2 ** 32;
  };
  // As long as a small map, and longer than fflate's buffer.
  for (const [most, count, piece] of [
    [6000, 150, 6000],
    [6000, 50, 100],
    [600_000, 5, 150_000],
  ] as const) {
    for (let k = 0; k < count; k++) {
      const given = runs(1 + Math.floor(random() * most), random);
      const out: Uint8Array[] = [];
      const stream = zlibStream(3, (data) => out.push(data));
      for (let from = 0; from < given.length; from += piece) stream.push(given.subarray(from, from + piece), from + piece >= given.length);
      assert.ok(inflateSync(Buffer.concat(out)).equals(given), `${given.length} bytes in pieces of ${piece}`);
    }
  }
});
