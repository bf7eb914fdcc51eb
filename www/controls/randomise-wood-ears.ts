/** Colonies worth looking at, drawn by lot, on the log and the ground that there are. */

import { WOOD_EARS } from '../wood-ears.ts';
import type { WoodEarSceneParams } from '../wood-ears.ts';
import { mulberry32 } from './mulberry32.ts';

/** What is drawn, and between what: not so dense that nothing is seen of the log, nor so sparse that there is no colony. */
const DRAWN: Readonly<Record<string, readonly [number, number]>> = {
  density: [18, 60], range: [25, 80], moisture: [15, 100], wrinkles: [0, 90], size: [1.2, 3], sizeSpread: [1.1, 2], variation: [0.2, 0.8],
};

/** `params` with other sliders, with `seed` as both the lot and the colony's seed. */
export function randomWoodEars(params: WoodEarSceneParams, seed: number): WoodEarSceneParams {
  const random = mulberry32(seed);
  let drawn: WoodEarSceneParams = { ...params, seed };
  for (const row of WOOD_EARS.rows) {
    const [low, high] = DRAWN[row.key] ?? [0, 0];
    if (low !== high) drawn = WOOD_EARS.written(drawn, row, Number((low + (high - low) * random()).toPrecision(2)));
  }
  return drawn;
}
