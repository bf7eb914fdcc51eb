/** Where the objects of a glTF file stand. Metres from the middle of the whole, y up. */

import type { Kit } from './kit.ts';
import { isOneThing } from '../model.ts';
import type { Model } from '../model.ts';
import { rounded } from '../formats/significant.ts';

/** As many as a 32-bit float has. */
const DIGITS = 7;

export interface Placement {
  translation: readonly [number, number, number];
  rotation: readonly [number, number, number, number];
  scale: readonly [number, number, number];
}

/** Where a body stands. */
export function translationOf({ origins, centre, unit }: Model, k: number): Placement['translation'] {
  return [
    near(unit * (origins[3 * k]! - centre[0])),
    near(unit * (origins[3 * k + 2]! - centre[2])),
    near(-unit * (origins[3 * k + 1]! - centre[1])),
  ];
}

/** What makes the body's kind lie as the body does. */
export function placementOf(model: Model, k: number, { kinds, kindOf, frames }: Kit): Placement {
  const [own, kind] = [frames[k]!, frames[kinds[kindOf[k]!]!]!];
  const [along, across, height] = own.extents;
  // Half of the angle, which is between −90° and 90°.
  const [cos, sin] = [Math.sqrt((1 + own.cos) / 2), Math.sqrt(Math.max(0, (1 - own.cos) / 2)) * (own.sin < 0 ? -1 : 1)];
  return {
    translation: translationOf(model, k),
    rotation: [0, near(sin), 0, near(cos)],
    scale: [near(along / kind.extents[0]), near(height / kind.extents[2]), near(across / kind.extents[1])],
  };
}

/** For each kind, the bodies that it stands for; none of one thing, which is no instance. */
export function instancesByKind(model: Model, { kinds, kindOf }: Kit): number[][] {
  const bodies = Array.from(kinds, (): number[] => []);
  kindOf.forEach((kind, k) => {
    if (!isOneThing(model, model.groupOf[k]!)) bodies[kind]!.push(k);
  });
  return bodies;
}

function near(value: number): number {
  return rounded(value, DIGITS);
}
