/** A mask: a picture over the whole ground that says how dense the rocks stand where. */

import { RockFieldError } from '../base/errors.ts';
import { checkNumber, wrongType } from '../table/param-checks.ts';

/** What code may paint with. */
export interface Mask {
  /** Whole pixels, 1 … 16,384. */
  width: number;
  height: number;
  /**
   * Row by row from the top, as in `ImageData`: one number per pixel, of 8 or 16 bits, or four of 8 bits, of which the brightness times the alpha
   * counts.
   */
  data: ArrayLike<number>;
}

/** A mask as the generator takes it. */
export interface MaskRows {
  width: number;
  rows: Uint8Array;
}

const MAX_SIDE = 16_384;

/**
 * A mask, checked. What comes back shares nothing with it.
 *
 * @throws {RockFieldError} naming key, value and bounds; `OverBudget` where it would not leave room for the field.
 */
export function maskRows(given: Mask, maxBytes: number): MaskRows {
  // `ImageData` has these as accessors of its prototype.
  if (typeof given !== 'object' || given === null) throw wrongType('mask', given, 'an object with width, height and data');
  const { width, height, data } = given;
  const pixels = checkedSize({ width, height }, Infinity);
  if (!(data instanceof Uint8Array || data instanceof Uint8ClampedArray || data instanceof Uint16Array)) {
    throw wrongType('mask', data, 'a Uint8Array, a Uint8ClampedArray or a Uint16Array', undefined, 'mask.data');
  }
  const channels = data.length / pixels;
  const isColour = channels === 4 && data.BYTES_PER_ELEMENT === 1;
  if (channels !== 1 && !isColour) {
    const message = `mask.data has ${data.length} numbers; a mask of ${width} × ${height} px has ${pixels} of them, or ${4 * pixels} of 8 bits`;
    throw new RockFieldError({ name: 'MalformedRequest', key: 'mask', value: data.length, min: pixels, max: 4 * pixels, message });
  }
  checkedSize({ width, height }, maxBytes);
  return { width, rows: isColour ? brightness(data) : data instanceof Uint16Array ? rounded(data) : Uint8Array.from(data) };
}

/**
 * The number of pixels of a mask.
 *
 * @throws {RockFieldError} naming the side and its bounds; `OverBudget`.
 */
export function checkedSize({ width, height }: { width: number; height: number }, maxBytes: number): number {
  const bounds = { min: 1, max: MAX_SIDE };
  const pixels =
    checkNumber('mask', width, bounds, true, undefined, 'mask.width') * checkNumber('mask', height, bounds, true, undefined, 'mask.height');
  // Here, on the way, and twice in the generator, while one replaces another.
  const bytes = 4 * pixels;
  if (bytes > maxBytes) {
    const [needed, budget] = [bytes, maxBytes].map((size) => Math.floor(size / 2 ** 20));
    const message = `this mask would need about ${needed} MiB and the budget is ${budget} MiB; make it smaller`;
    throw new RockFieldError({ name: 'OverBudget', key: 'mask', value: bytes, min: 0, max: maxBytes, message });
  }
  return pixels;
}

/** Of sRGB's weights, times the alpha; whole numbers, so that it is the same everywhere. */
function brightness(data: Uint8Array | Uint8ClampedArray | Uint16Array): Uint8Array {
  const rows = new Uint8Array(data.length / 4);
  for (let k = 0; k < rows.length; k += 1) {
    const at = 4 * k;
    const grey = (13_933 * data[at]! + 46_871 * data[at + 1]! + 4_732 * data[at + 2]! + 32_768) >> 16;
    rows[k] = (grey * data[at + 3]! + 127) / 255;
  }
  return rows;
}

function rounded(data: Uint16Array): Uint8Array {
  return Uint8Array.from(data, (value) => (value * 255 + 32_767) / 65_535);
}
