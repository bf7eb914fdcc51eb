/** What of the parameters is only seen: no generator stage reads it, so an edit of it is drawn and nothing is run. */

import type { Layer, Params } from './params.ts';
import { FIELD_ROWS, LAYER_ROWS, readValue } from './request.ts';
import type { Look } from '../renderer/renderer.ts';
import { isLook } from '../table/table.ts';
import type { Row } from '../table/table.ts';

/** For a renderer. */
export function lookOf(params: Params): Look {
  const layers = params.layers.map((layer) => ({ id: layer.id, ...part(layer, LAYER_ROWS) }));
  return { ...part(params, FIELD_ROWS), layers } as unknown as Look;
}

function part(owner: Params | Layer, rows: readonly Row[]): Record<string, unknown> {
  return Object.fromEntries(rows.filter(isLook).map((spec) => [spec.key, readValue(owner, spec)]));
}
