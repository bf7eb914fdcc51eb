/** Arrays for NumPy: `numpy.load('field.npz')['positions']`. The format is described in NumPy's `numpy.lib.format`. */

import { writeZip } from '../export/maps/zip.ts';

export interface NamedArray {
  name: string;
  values: Float32Array | Float64Array | Uint32Array | Uint8Array;
  /** Numbers in a row; 1: a list. */
  row: number;
}

/** The head of an array ends at a multiple of this. */
const ALIGNMENT = 64;

/** The archive, with other files in it. */
export function npz(arrays: readonly NamedArray[], others: Readonly<Record<string, Uint8Array>>): Uint8Array<ArrayBuffer> {
  return writeZip({ ...others, ...Object.fromEntries(arrays.map((array) => [`${array.name}.npy`, npy(array)])) });
}

function npy({ values, row }: NamedArray): Uint8Array {
  const count = values.length / row;
  const shape = row === 1 ? `(${count},)` : `(${count}, ${row})`;
  const words = `{'descr': '${typeOf(values)}', 'fortran_order': False, 'shape': ${shape}, }`;
  // Magic word, version 1.0, length of the words; a line's end after them.
  const before = 10;
  const length = Math.ceil((before + words.length + 1) / ALIGNMENT) * ALIGNMENT;
  const bytes = new Uint8Array(length + values.byteLength);
  bytes.set([0x93, ...new TextEncoder().encode('NUMPY'), 1, 0]);
  new DataView(bytes.buffer).setUint16(8, length - before, true);
  bytes.set(new TextEncoder().encode(`${words.padEnd(length - before - 1)}\n`), before);
  // Typed arrays are little-endian on every machine that Node runs on.
  bytes.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), length);
  return bytes;
}

function typeOf(values: NamedArray['values']): string {
  if (values instanceof Float32Array) return '<f4';
  if (values instanceof Float64Array) return '<f8';
  return values instanceof Uint32Array ? '<u4' : '|u1';
}
