/** PNG files that are written row by row: of a picture of a gigabyte, only some rows and what they are compressed to are in memory. */

import type { Zlib } from 'fflate';
import { chunk, header, RowFilter } from './png-parts.ts';
import { zlibStream } from './zlib-stream.ts';

/** Bytes of rows that are compressed in one go: some 20 ms. */
const SLICE = 1 << 19;
/** Compressed bytes that are kept as arrays; what is older is handed to the browser, which may keep it on the disk. */
const KEPT = 1 << 24;
/** Of 9: higher ones take twice the time and save little. */
const LEVEL = 3;

export class PngRows {
  readonly #width: number;
  /** Bytes of a pixel: three, or four with how opaque it is. */
  readonly #channels: 3 | 4;
  readonly #zlib: Zlib;
  readonly #filter: RowFilter;
  #done = new Blob();
  #parts: Uint8Array<ArrayBuffer>[] = [];
  #kept = 0;

  constructor(width: number, height: number, hasAlpha: boolean) {
    this.#width = width;
    this.#channels = hasAlpha ? 4 : 3;
    this.#filter = new RowFilter(width * this.#channels, this.#channels);
    this.#zlib = zlibStream(LEVEL, (data) => data.length > 0 && this.#keep(chunk('IDAT', [data])));
    this.#keep(header(width, height, this.#channels, 1));
  }

  /** The next rows, from above, four bytes a pixel. Between slices of them the page can do other things. */
  async add(rgba: Uint8ClampedArray): Promise<void> {
    const length = 4 * this.#width;
    const slice = length * Math.max(1, Math.floor(SLICE / length));
    for (let from = 0; from < rgba.length; from += slice) {
      this.#zlib.push(this.#filtered(rgba.subarray(from, from + slice)));
      await new Promise((resolve) => setTimeout(resolve));
    }
  }

  finish(): Blob {
    this.#zlib.push(new Uint8Array(0), true);
    this.#keep(chunk('IEND', []));
    return new Blob([this.#done, ...this.#parts], { type: 'image/png' });
  }

  #filtered(rgba: Uint8ClampedArray): Uint8Array {
    const channels = this.#channels;
    const row = new Uint8Array(channels * this.#width);
    const filtered = new Uint8Array((rgba.length / (4 * this.#width)) * this.#filter.length);
    for (let from = 0, at = 0; from < rgba.length; from += 4 * this.#width, at += this.#filter.length) {
      for (let pixel = 0; pixel < this.#width; pixel += 1)
        for (let k = 0; k < channels; k += 1) row[channels * pixel + k] = rgba[from + 4 * pixel + k]!;
      filtered.set(this.#filter.next(row), at);
    }
    return filtered;
  }

  #keep(parts: readonly Uint8Array[]): void {
    this.#parts.push(...(parts as Uint8Array<ArrayBuffer>[]));
    this.#kept += parts.reduce((sum, { length }) => sum + length, 0);
    if (this.#kept < KEPT) return;
    this.#done = new Blob([this.#done, ...this.#parts]);
    this.#parts = [];
    this.#kept = 0;
  }
}
