/** From the journal's notation to the conference's and back, so that the rocks stay the same. */

import { LAYER_ROWS, boundsOf, readValue, writeValue } from '../request.ts';
import type { Notation } from '../../table/row.ts';
import type { Layer, Params } from '../params.ts';

/** The same field in another notation; `clamped` when a value had to give way to that notation's bounds. */
export function inNotation(params: Params, notation: Notation): { params: Params; clamped: boolean } {
  if (notation === params.notation) return { params, clamped: false };
  // px in the conference's length unit, as in `Params::layer_in_px`: the same operations in the same order give the same bits.
  const unit = params.imageWidth / 100;
  const convert = notation === 'px' ? (value: number, scale: number) => value * scale : shortestQuotient;
  let clamped = false;
  const layers = params.layers.map((layer) => {
    const radius = convert(layer.radius, unit);
    const radiusPx = notation === 'px' ? radius : layer.radius;
    const copy: Layer = {
      ...layer,
      radius,
      taper: layer.taper.map((value) => convert(value, unit)) as Layer['taper'],
      height: layer.height.map((value) => convert(value, radiusPx)) as Layer['height'],
      detail: notation === 'px' ? layer.detail / unit : shortestProduct(layer.detail, unit),
    };
    for (const spec of LAYER_ROWS) {
      const value = readValue(copy, spec);
      const { min, max } = boundsOf(spec, notation);
      if (typeof value !== 'number' || (value >= min && value <= max)) continue;
      writeValue(copy, spec, Math.min(max, Math.max(min, value)));
      clamped = true;
    }
    return copy;
  });
  return { params: { ...params, notation, layers }, clamped };
}

/** The shortest decimal that times `scale` gives `value` again, to the bit where there is one. */
function shortestQuotient(value: number, scale: number): number {
  return shortest(value / scale, (candidate) => candidate * scale === value);
}

/** The shortest decimal that divided by `scale` gives `value` again. */
function shortestProduct(value: number, scale: number): number {
  return shortest(value * scale, (candidate) => candidate / scale === value);
}

function shortest(near: number, isRight: (candidate: number) => boolean): number {
  for (let digits = 1; digits <= 17; digits += 1) {
    const candidate = Number(near.toPrecision(digits));
    if (isRight(candidate)) return candidate;
  }
  return near;
}
