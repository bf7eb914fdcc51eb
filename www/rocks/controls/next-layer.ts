/** The layer that is added to others. */

import { boundsOf, defaultLayer, LAYER_ROWS } from '../request.ts';
import type { ParamSpec } from '../spec.ts';
import type { Layer, Params } from '../params.ts';

/** A layer that is added has no more than some 10,000 cells: the finest of Fig. 1 has r = 10 at 1024 px. */
const FINEST_SHARE = 100;
/** The first layer of a bare field is three times that: the middle one of Fig. 1. */
const DEFAULT_SHARE = 3;

const RADIUS = LAYER_ROWS.find(({ key }) => key === 'radius') as ParamSpec;

/** The layer that an empty place asks for: a third of the smallest radius, as from size to size in the papers, as steep as the table's defaults, and worn like the last. */
export function nextLayer({ layers, notation, imageWidth, imageHeight }: Params, id: number): Layer {
  const layer = defaultLayer(id, notation);
  const side = Math.sqrt(imageWidth * imageHeight);
  const finest = notation === 'px' ? side / FINEST_SHARE : (100 * side) / imageWidth / FINEST_SHARE;
  const { min } = boundsOf(RADIUS, notation).slider;
  const smallest = Math.min(...layers.map(({ radius }) => radius));
  const radius = round(Math.max(min, layers.length > 0 ? Math.max(finest, smallest / 3) : finest * DEFAULT_SHARE));
  const scale = radius / layer.radius;
  const scaled = (triple: Layer['taper']) => triple.map((value) => round(value * scale)) as Layer['taper'];
  // In the conference's notation heights are multiples of the radius already.
  const height = notation === 'px' ? scaled(layer.height) : layer.height;
  return { ...(layers.at(-1) ?? layer), id, radius, areaFraction: layer.areaFraction, cellCount: null, taper: scaled(layer.taper), height };
}

function round(value: number): number {
  return Number(value.toPrecision(2));
}
