/** PNG (ISO/IEC 15948), compressed in JavaScript, so that all engines write the same bytes. */

import { joined } from '../formats/byte-writer.ts';
import { chunk, header, RowFilter } from '../formats/png-parts.ts';
import { zlibStream } from '../formats/zlib-stream.ts';
import { textChunk } from '../origin/png-text.ts';
import type { Turn } from '../pace.ts';
import type { Raster } from './rasters.ts';

/** Of 9: on maps more of it takes twice the time, and saves 1 %. */
const LEVEL = 3;
/** So many bytes are compressed at once, or a row. */
const STRETCH = 1 << 18;

/**
 * The file.
 *
 * fast-png has no filters, which makes 16-bit heights half as large again, and holds the image four times.
 *
 * @param text chunks of text by their keywords, in order.
 */
export async function writePng(
  { width, height, channels, samples }: Raster,
  text: Readonly<Record<string, string>>,
  turn?: Turn,
): Promise<Uint8Array<ArrayBuffer>> {
  return joined([
    ...header(width, height, channels, samples.BYTES_PER_ELEMENT),
    ...Object.entries(text).map(([keyword, value]) => textChunk(keyword, value)),
    ...chunk('IDAT', await compressed(samples, width, channels, turn)),
    ...chunk('IEND', []),
  ]);
}

async function compressed(samples: Raster['samples'], width: number, channels: number, turn: Turn | undefined): Promise<Uint8Array[]> {
  const pieces: Uint8Array[] = [];
  const zlib = zlibStream(LEVEL, (piece) => pieces.push(piece));
  const rows = samples.length / (width * channels);
  const filter = new RowFilter(width * channels * samples.BYTES_PER_ELEMENT, channels * samples.BYTES_PER_ELEMENT);
  const rowsAtOnce = Math.max(1, Math.floor(STRETCH / filter.length));
  for (let first = 0; first < rows; first += rowsAtOnce) {
    await turn?.(first / rows);
    const last = Math.min(rows, first + rowsAtOnce);
    const stretch = new Uint8Array((last - first) * filter.length);
    for (let row = first; row < last; row++) {
      stretch.set(filter.next(samples.subarray(row * width * channels, (row + 1) * width * channels)), (row - first) * filter.length);
    }
    zlib.push(stretch, last === rows);
  }
  return pieces;
}
