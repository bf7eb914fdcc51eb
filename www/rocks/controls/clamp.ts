/** The legal parameters nearest to others. */

import type { Notation, Row } from '../../table/row.ts';
import { MAX_LAYERS } from '../params.ts';
import type { Layer, Params } from '../params.ts';
import { boundsOf, defaultOf, FIELD_ROWS, LAYER_ROWS, MAX_ID, readValue, writeValue } from '../request.ts';

/** One value that `clampParams` replaced. */
export interface Clamping {
  key: string;
  /** Index in the list that was given; null for a parameter of the field. */
  layer: number | null;
  component: number | null;
  from: unknown;
  to: unknown;
}

/**
 * The legal parameters nearest to `params`, for values that people type: numbers are moved to the nearest bound and rounded
 * where they have to be whole, what is no value at all becomes the default, surplus layers are left out, a repeated id becomes
 * the least free one. The result shares nothing with `params`.
 */
export function clampParams(params: Params): { params: Params; changes: Clamping[] } {
  const changes: Clamping[] = [];
  const record = (change: Clamping) => {
    if (!Object.is(change.from, change.to)) changes.push(change);
  };
  const clamped = {} as Params;
  for (const spec of FIELD_ROWS) {
    const from = readValue(params, spec);
    const to = clampValue(spec, 'px', from);
    record({ key: spec.key, layer: null, component: null, from, to });
    writeValue(clamped, spec, to);
  }
  const given: unknown[] = Array.isArray(params.layers) ? params.layers : [];
  if (given.length > MAX_LAYERS || given !== params.layers) {
    record({
      key: 'layers',
      layer: null,
      component: null,
      from: given === params.layers ? given.length : params.layers,
      to: Math.min(given.length, MAX_LAYERS),
    });
  }
  const ids = new Set<number>();
  clamped.layers = given.slice(0, MAX_LAYERS).map((entry, index) => {
    const from = (typeof entry === 'object' && entry !== null ? entry : {}) as Layer;
    const id = freeId(from.id, ids, given);
    ids.add(id);
    record({ key: 'id', layer: index, component: null, from: from.id, to: id });
    const layer = { id } as Layer;
    for (const spec of LAYER_ROWS) {
      const value = readValue(from, spec);
      const to = clampValue(spec, clamped.notation, value);
      record({ key: spec.key, layer: index, component: spec.component, from: value, to });
      writeValue(layer, spec, to);
    }
    return layer;
  });
  if (params.strokes) clamped.strokes = params.strokes;
  return { params: clamped, changes };
}

function clampValue(spec: Row, notation: Notation, value: unknown): number | string | null {
  if (spec.kind === 'choice') return spec.choices.some((choice) => choice.value === value) ? (value as string) : defaultOf(spec, notation);
  if (typeof value !== 'number' || Number.isNaN(value)) {
    return spec.kind === 'optional-integer' ? null : defaultOf(spec, notation);
  }
  const { min, max } = boundsOf(spec, notation);
  const inside = Math.min(Math.max(value, min), max);
  return spec.kind === 'real' ? (inside === 0 ? 0 : inside) : Math.round(inside);
}

function freeId(id: unknown, taken: ReadonlySet<number>, given: readonly unknown[]): number {
  if (typeof id === 'number' && Number.isInteger(id) && id >= 0 && id <= MAX_ID && !taken.has(id)) return id;
  // Not an id that a later layer holds: that one would have to move in its turn.
  const held = new Set(given.map((entry) => (entry as Layer | null)?.id));
  let free = 0;
  while (taken.has(free) || held.has(free)) free += 1;
  return free;
}
