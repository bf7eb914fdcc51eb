/** The hash of a field, for the files that show it. */

import { fieldBuffers } from '../data/buffers.ts';
import type { Field } from '../data/field.ts';
import { hashInSlices } from '../export/origin/hash.ts';

const hashes = new WeakMap<Field, Promise<string>>();

export function fieldHash(field: Field): Promise<string> {
  const known = hashes.get(field) ?? hashInSlices(fieldBuffers(field));
  hashes.set(field, known);
  return known;
}
