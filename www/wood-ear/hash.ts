/** The hash of a colony, for the files that show it. */

import { colonyBuffers } from '../data/buffers.ts';
import type { WoodEarColony } from '../data/colony.ts';
import { hashInSlices } from '../export/origin/hash.ts';

const hashes = new WeakMap<WoodEarColony, Promise<string>>();

export function colonyHash(colony: WoodEarColony): Promise<string> {
  const known = hashes.get(colony) ?? hashInSlices(colonyBuffers(colony));
  hashes.set(colony, known);
  return known;
}
