/** What PNG files (ISO/IEC 15948) are made of, whether they are written in one piece or row by row. */

import { crc32, SIGNATURE } from '../origin/png-text.ts';

/** Colour types by the number of channels. */
const COLORS = { 1: 0, 3: 2, 4: 6 } as const;

/** What a file begins with. `bytes`: of a sample. */
export function header(width: number, height: number, channels: keyof typeof COLORS, bytes: number): Uint8Array[] {
  const content = new Uint8Array(13);
  const view = new DataView(content.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  content[8] = 8 * bytes;
  content[9] = COLORS[channels];
  return [Uint8Array.from(SIGNATURE), ...chunk('IHDR', [content])];
}

/** Length, name, content and checksum. */
export function chunk(name: string, content: readonly Uint8Array[]): Uint8Array[] {
  const before = new Uint8Array(8);
  new DataView(before.buffer).setUint32(
    0,
    content.reduce((sum, piece) => sum + piece.length, 0),
  );
  before.set(new TextEncoder().encode(name), 4);
  const after = new Uint8Array(4);
  new DataView(after.buffer).setUint32(
    0,
    content.reduce((rest, piece) => crc32(piece, rest), crc32(before.subarray(4))),
  );
  return [before, ...content, after];
}

/** Filters of rows, by their number in the file; the third one, the mean of two neighbours, is hardly ever the best. */
const [NONE, SUB, UP, PAETH] = [0, 1, 2, 4];

/** What a row becomes: of the filters the one whose bytes are nearest to 0, as the standard recommends. */
export class RowFilter {
  /** Of a filtered row, with the byte that says which filter it is. */
  readonly length: number;
  readonly #perPixel: number;
  #row: Uint8Array;
  #above: Uint8Array;
  readonly #tries: Uint8Array[];

  constructor(bytes: number, perPixel: number) {
    this.length = 1 + bytes;
    this.#perPixel = perPixel;
    // Pixels of zeros stand on the left of both rows.
    this.#row = new Uint8Array(perPixel + bytes);
    this.#above = new Uint8Array(perPixel + bytes);
    this.#tries = [NONE, SUB, UP, PAETH].map((filter) => {
      const bytesOf = new Uint8Array(this.length);
      bytesOf[0] = filter;
      return bytesOf;
    });
  }

  /** Valid until the next call. */
  next(samples: Uint8Array | Uint16Array): Uint8Array {
    [this.#row, this.#above] = [this.#above, this.#row];
    const row = this.#row;
    const above = this.#above;
    const perPixel = this.#perPixel;
    if (samples instanceof Uint8Array) row.set(samples, perPixel);
    else for (let at = perPixel, s = 0; s < samples.length; s++, at += 2) [row[at], row[at + 1]] = [samples[s]! >> 8, samples[s]! & 255];
    const [none, sub, up, paeth] = this.#tries as [Uint8Array, Uint8Array, Uint8Array, Uint8Array];
    let [noneSum, subSum, upSum, paethSum] = [0, 0, 0, 0];
    for (let at = perPixel, to = 1; at < row.length; at++, to++) {
      const [value, a, b, c] = [row[at]!, row[at - perPixel]!, above[at]!, above[at - perPixel]!];
      none[to] = value;
      sub[to] = value - a;
      up[to] = value - b;
      paeth[to] = value - predicted(a, b, c);
      noneSum += fromZero(value);
      subSum += fromZero(sub[to]!);
      upSum += fromZero(up[to]!);
      paethSum += fromZero(paeth[to]!);
    }
    const sums = [noneSum, subSum, upSum, paethSum];
    return this.#tries[sums.indexOf(Math.min(...sums))]!;
  }
}

/** A byte as a signed number, without the sign. */
function fromZero(byte: number): number {
  return byte < 128 ? byte : 256 - byte;
}

/** Paeth's: of the neighbours on the left, above and above that one the nearest to left + above − the third. */
function predicted(a: number, b: number, c: number): number {
  const [pa, pb, pc] = [Math.abs(b - c), Math.abs(a - c), Math.abs(a + b - c - c)];
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}
