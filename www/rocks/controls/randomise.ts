/**
 * Fields worth looking at, drawn by lot. A natural preset is varied: its layers stay, a little larger or smaller, fuller or emptier.
 * From any other come one to four sizes of rock, the largest few and tall, the smallest many.
 */

import { PRESETS } from '../params.ts';
import type { Preset } from '../spec.ts';
import type { Layer, Params, Triple } from '../params.ts';
import { defaultLayer, defaultParams, presetParams } from '../request.ts';
import { clampParams } from './clamp.ts';
import type { Draw } from '../../table/table.ts';
import { mulberry32 } from '../../controls/mulberry32.ts';
import { inNotation } from './notation.ts';
import { scaledLayer } from './scaled-layer.ts';

/** Side of the image that the sizes below are meant for, px; other images scale them, so the number of rocks stays bounded. */
const REFERENCE_SIDE = 1024;
/** The smallest disc radius at that side: some 20,000 cells. */
const SMALLEST_RADIUS = 6;

/**
 * How a natural preset is varied: by factors of up to e to the power of these, either way. There are at most twice as many
 * triangles: rocks are as many as their area over the square of their radius.
 */
const VARIED = { grain: 0.18, radius: 0.08, coarseArea: 0.5, fineArea: 0.1, height: 0.3, taper: 0.25 };

/** Numbers by lot: between two, or a factor near one. */
function lot(seed: number): { between: (low: number, high: number) => number; factor: (most: number) => number } {
  const random = mulberry32(seed);
  const between = (low: number, high: number) => low + (high - low) * random();
  return { between, factor: (most) => Math.exp(between(-most, most)) };
}

/**
 * Sizes and shapes by lot over the image, notation, wear and look of `params`, with `seed` as both the lot and the field's seed:
 * a riverbed gives another riverbed. A locked `radius` is that of `params`, and heights and tapers go with it; locked `height` and
 * `taper` are too.
 */
export function randomParams(params: Params, { seed, preset, lock = [] }: Draw): Params {
  const presets: readonly Preset[] = PRESETS;
  const isNatural = presets.some(({ name, natural }) => name === preset && natural);
  let layers = isNatural ? variedLayers(params, preset, seed) : newLayers(params, seed);
  const { notation } = params;
  if (lock.includes('radius'))
    layers = params.layers.map((old, k) => ({
      ...scaledLayer(layers[k] ?? layers.at(-1) ?? old, old.radius, notation).scaled,
      id: old.id,
    }));
  layers = layers.map((layer, k) => {
    const { taper, height } = params.layers[k] ?? layer;
    return { ...layer, ...(lock.includes('taper') && { taper }), ...(lock.includes('height') && { height }) };
  });
  // Only these can leave the ground bare.
  const { packing, darts } = isNatural ? presetParams(preset) : defaultParams();
  return clampParams({ ...params, packing, darts, seed, layers }).params;
}

/** Of the preset, not of what has been made of it: what is varied again and again would drift away. */
function variedLayers(params: Params, preset: string, seed: number): Layer[] {
  const { factor } = lot(seed);
  const own = presetParams(preset);
  const { layers } = inNotation({ ...own, imageWidth: params.imageWidth }, params.notation).params;
  const grain = factor(VARIED.grain);
  const tall = factor(VARIED.height);
  return layers.map((layer, k) => {
    const isCoarse = k < layers.length / 2;
    const { scaled } = scaledLayer(layer, rounded(layer.radius * grain * factor(VARIED.radius)), params.notation);
    const wide = factor(VARIED.taper);
    const like = params.layers[k] ?? layer;
    return {
      ...like,
      id: layer.id,
      radius: scaled.radius,
      areaFraction: Math.min(1, rounded(layer.areaFraction * factor(isCoarse ? VARIED.coarseArea : VARIED.fineArea))),
      cellCount: null,
      taper: scaled.taper.map((value) => rounded(value * wide)) as Triple,
      height: scaled.height.map((value) => rounded(value * tall * factor(VARIED.height / 3))) as Triple,
    };
  });
}

function newLayers(params: Params, seed: number): Layer[] {
  const { between } = lot(seed);
  const { imageWidth, imageHeight, notation } = params;
  const scale = Math.sqrt(imageWidth * imageHeight) / REFERENCE_SIDE;
  const isRelative = notation === 'relative';
  const unit = isRelative ? imageWidth / 100 : 1;
  const length = (px: number) => rounded((px * scale) / unit);

  const count = 1 + Math.floor(between(0, 4) ** 0.8);
  const overhang = between(0, 1) < 0.5 ? between(0, 0.12) : between(-0.15, 0);
  const steepness = between(0.15, 0.6);
  const layers: Layer[] = [];
  let radius = 45 * between(0.7, 3.2) ** (count > 1 ? 1 : 0.7);
  for (let id = 0; id < count && radius >= SMALLEST_RADIUS; id += 1) {
    const isFinest = id === count - 1;
    const r = radius;
    const height = (share: number) => (isRelative ? rounded(share) : length(share * r));
    const taper: Triple = [length(overhang * r), length(between(0, 0.15) * r), length(between(0, 0.12) * r)];
    const heights: Triple = [
      height(steepness * between(0.3, 0.7)),
      height(steepness * between(0, 0.6)),
      height(steepness * between(0.1, 0.4)),
    ];
    const areaFraction = rounded(isFinest ? between(0.35, 0.6) : between(0.1, 0.3));
    const like = params.layers[id] ?? params.layers.at(-1) ?? defaultLayer(id, notation);
    layers.push({ ...like, id, radius: length(r), areaFraction, cellCount: null, taper, height: heights });
    radius /= between(2.2, 3.8);
  }
  return layers;
}

function rounded(value: number): number {
  return Number(value.toPrecision(2)) + 0;
}
