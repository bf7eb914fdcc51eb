/** Colonies worth looking at, drawn by lot, on the log and the ground that there are. */

import { WOOD_EARS } from '../table.ts';
import type { WoodEarSceneParams } from '../table.ts';
import type { Draw } from '../../table/table.ts';
import { mulberry32 } from '../../controls/mulberry32.ts';

/** What is drawn, and between what: not so dense that nothing is seen of the log, nor so sparse that there is no colony. */
const DRAWN: Readonly<Record<string, readonly [number, number]>> = {
  density: [18, 60],
  range: [25, 80],
  moisture: [15, 100],
  wrinkles: [0, 90],
  size: [1.2, 3],
  sizeSpread: [1.1, 2],
  variation: [0.2, 0.8],
};

/**
 * How a natural preset is varied: by a factor of up to e to the power of these, either way, or by up to so much more or less. There
 * are at most twice as many wood ears: they are as many as their density times the range, round the log and along it.
 */
const FACTOR: Readonly<Record<string, number>> = { density: 0.2, range: 0.15, size: 0.2, thickness: 0.25 };
const SHIFT: Readonly<Record<string, number>> = {
  moisture: 10,
  wrinkles: 20,
  sizeSpread: 0.3,
  perIndividual: 0.2,
  droop: 0.2,
  variation: 0.3,
};

/** `params` with other sliders, with `seed` as both the lot and the colony's seed: near those of a natural preset, or any. */
export function randomWoodEars(params: WoodEarSceneParams, { seed, preset }: Draw): WoodEarSceneParams {
  const random = mulberry32(seed);
  const between = (low: number, high: number) => low + (high - low) * random();
  const isNatural = WOOD_EARS.presets.some(({ name, natural }) => name === preset && natural);
  const own = WOOD_EARS.presetParams(preset);
  let drawn: WoodEarSceneParams = { ...params, seed };
  for (const row of WOOD_EARS.rows) {
    const { key, min, max } = row;
    let value: number | undefined;
    if (isNatural) {
      // Of the preset, not of what has been made of it: what is varied again and again would drift away.
      const printed = Number(WOOD_EARS.read(own, row));
      if (key in FACTOR) value = printed * Math.exp(between(-FACTOR[key]!, FACTOR[key]!));
      if (key in SHIFT) value = printed + between(-SHIFT[key]!, SHIFT[key]!);
    } else if (key in DRAWN) value = between(...DRAWN[key]!);
    if (value !== undefined) drawn = WOOD_EARS.written(drawn, row, Math.min(max, Math.max(min, Number(value.toPrecision(2)))));
  }
  return drawn;
}
