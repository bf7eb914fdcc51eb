/** Fields worth looking at, drawn by lot: one to four sizes of rock, the largest few and tall, the smallest many. */

import { clampParams, defaultLayer, defaultParams } from '../params-flat.ts';
import { mulberry32 } from './mulberry32.ts';
import type { Layer, Params, Triple } from '../params.ts';

/** Side of the image that the sizes below are meant for, px; other images scale them, so the number of rocks stays bounded. */
const REFERENCE_SIDE = 1024;
/** The smallest disc radius at that side: some 20,000 cells. */
const SMALLEST_RADIUS = 6;

/**
 * Sizes and shapes by lot over the image, notation, wear and look of `params`, with `seed` as both the lot and the field's seed:
 * a riverbed gives another riverbed.
 */
export function randomParams(params: Params, seed: number): Params {
  const random = mulberry32(seed);
  const between = (low: number, high: number) => low + (high - low) * random();
  const { imageWidth, imageHeight, notation } = params;
  const scale = Math.sqrt(imageWidth * imageHeight) / REFERENCE_SIDE;
  const isRelative = notation === 'relative';
  const unit = isRelative ? imageWidth / 100 : 1;
  const length = (px: number) => rounded((px * scale) / unit);

  const count = 1 + Math.floor(between(0, 4) ** 0.8);
  const overhang = random() < 0.5 ? between(0, 0.12) : between(-0.15, 0);
  const steepness = between(0.15, 0.6);
  const layers: Layer[] = [];
  let radius = 45 * between(0.7, 3.2) ** (count > 1 ? 1 : 0.7);
  for (let id = 0; id < count && radius >= SMALLEST_RADIUS; id += 1) {
    const isFinest = id === count - 1;
    const r = radius;
    const height = (share: number) => (isRelative ? rounded(share) : length(share * r));
    const taper: Triple = [length(overhang * r), length(between(0, 0.15) * r), length(between(0, 0.12) * r)];
    const heights: Triple = [height(steepness * between(0.3, 0.7)), height(steepness * between(0, 0.6)), height(steepness * between(0.1, 0.4))];
    const areaFraction = rounded(isFinest ? between(0.35, 0.6) : between(0.1, 0.3));
    const like = params.layers[id] ?? params.layers.at(-1) ?? defaultLayer(id, notation);
    layers.push({ ...like, id, radius: length(r), areaFraction, cellCount: null, taper, height: heights });
    radius /= between(2.2, 3.8);
  }
  // Only these can leave the ground bare.
  const { packing, darts } = defaultParams();
  return clampParams({ ...params, packing, darts, seed, layers }).params;
}

function rounded(value: number): number {
  return Number(value.toPrecision(2)) + 0;
}
