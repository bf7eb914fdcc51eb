/** What of the parameters is only seen: no generator stage reads it, so an edit of it is drawn and nothing is run. */

import type { Layer, Params } from './params.ts';
import { FIELD_ROWS, LAYER_ROWS, readValue } from './request.ts';
import type { Look } from '../data/look.ts';
import { isLook } from '../table/row.ts';
import type { Row } from '../table/row.ts';

/** For a renderer. */
export function lookOf(params: Params): Look {
  const layers = params.layers.map((layer) => ({ id: layer.id, ...part(layer, LAYER_ROWS) }));
  return { ...part(params, FIELD_ROWS), layers } as unknown as Look;
}

function part(owner: Params | Layer, rows: readonly Row[]): Record<string, unknown> {
  return Object.fromEntries(rows.filter(isLook).map((spec) => [spec.key, numberOf(spec, readValue(owner, spec))]));
}

/** A renderer knows no words: a choice is its place in the table. */
function numberOf({ kind, choices }: Row, value: unknown): unknown {
  return kind === 'choice' ? choices.findIndex((choice) => choice.value === value) : value;
}
