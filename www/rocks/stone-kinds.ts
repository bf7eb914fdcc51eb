/** What each rock is made of in natural colours: the same as src/shading/palette.rs draws. */

import type { Field } from '../data/field.ts';
import { MIXED, STONE_KINDS } from '../data/palette.gen.ts';
import type { Params } from './params.ts';
import { ROCKS } from './table.ts';

/** For each rock, its place in `STONE_KINDS`. */
export function stoneKinds({ layers, rockLayer }: Field, params: Params): Uint8Array {
  const choices = ROCKS.itemRows.find(({ key }) => key === 'material')!.choices.map(({ value }) => value);
  const placeInLayer = layers.map(() => 0);
  return Uint8Array.from(rockLayer, (layer) => {
    const { id, selected } = layers[layer]!;
    const site = selected[placeInLayer[layer]!++]!;
    // The first choice is the mixture; the others are kinds in their order.
    const choice = choices.indexOf(params.layers[layer]!.material);
    return choice > 0 ? choice - 1 : mixed(hash(id, site) >>> 24);
  });
}

function mixed(byte: number): number {
  let left = Math.floor((byte * 100) / 256);
  let kind = 0;
  while (kind < STONE_KINDS.length - 1 && left >= MIXED[kind]!) left -= MIXED[kind++]!;
  return kind;
}

/** As `hash` of palette.rs. */
export function hash(layer: number, site: number): number {
  let h = Math.imul(layer, 0x9e3779b9) ^ (Math.imul(site, 0x85ebca6b) + 1);
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return (h ^ (h >>> 16)) >>> 0;
}
