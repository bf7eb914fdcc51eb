/** A layer of rocks in another size. */

import { boundsOf, LAYER_ROWS, readValue, writeValue } from '../request.ts';
import type { Notation } from '../../table/row.ts';
import type { Layer } from '../params.ts';

/** Digits kept, so that links stay short. */
const DIGITS = 4;

/** `layer` with another radius, and with height and taper in the same proportion. `isClamped`: some of them have reached their bounds. */
export function scaledLayer(layer: Layer, radius: number, notation: Notation): { scaled: Layer; isClamped: boolean } {
  const scaled = { ...structuredClone(layer), radius };
  const factor = radius / layer.radius;
  let isClamped = false;
  if (factor === 1) return { scaled, isClamped };
  for (const row of LAYER_ROWS) {
    // In the conference's notation heights are multiples of the radius already.
    if (row.component === null || (row.key === 'height' && notation === 'relative')) continue;
    const { min, max } = boundsOf(row, notation);
    const wanted = Number(((readValue(layer, row) as number) * factor).toPrecision(DIGITS));
    const value = Math.min(max, Math.max(min, wanted)) + 0;
    isClamped ||= value !== wanted + 0;
    writeValue(scaled, row, value);
  }
  return { scaled, isClamped };
}
