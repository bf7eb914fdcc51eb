/**
 * What the attributes of `<rock-field>` say; see `element/attribute-reader.ts`. Those of a layer list all layers, `radius="90 30 10"`.
 */

import { attributesOf, AttributeReader, COMMON_ATTRIBUTES, quote } from '../element/attribute-reader.ts';
import type { ElementAttributes } from '../element/attribute-reader.ts';
import { isReadable } from '../table/link.ts';
import { MAX_LAYERS, PRESETS } from './params.ts';
import type { Params } from './params.ts';
import { resolveParams } from './request.ts';
import type { FieldRequest } from './request.ts';
import { isStrokes } from './stroke-text.ts';
import { ROCKS } from './table.ts';
import type { Rocks } from './table.ts';
import { decodeLink } from './link.ts';

export const FIELD_ATTRIBUTES = attributesOf(ROCKS.rows);
export const LAYER_ATTRIBUTES = attributesOf(ROCKS.itemRows);

/** All that say what is shown. */
export const ATTRIBUTES: readonly string[] = [...COMMON_ATTRIBUTES, ...FIELD_ATTRIBUTES.keys(), ...LAYER_ATTRIBUTES.keys(), 'strokes'];

export type AttributeState = ElementAttributes<Rocks>;

/** `src` fills everything and `preset` is then not looked at; the other attributes replace what `src` says. */
export function readAttributes(get: (name: string) => string | null): AttributeState {
  const reader = new AttributeReader(ROCKS, get);
  const source = reader.source({
    ofRequest: (request) => ({
      params: resolveParams(request as FieldRequest),
      preset: (request as FieldRequest).preset ?? PRESETS[0].name,
    }),
    ofLink: decodeLink,
  });
  const params = withStrokes(reader, reader.rows(FIELD_ATTRIBUTES, source.params));
  return reader.common(source, ROCKS.withItems(params, readLayers(reader, params)));
}

function withStrokes(reader: AttributeReader<Rocks>, { strokes, ...params }: Params): Params {
  let used = reader.get('strokes') ?? strokes ?? '';
  if (!isStrokes(used)) {
    reader.note('strokes', 'no-strokes', { given: quote(used) });
    used = '';
  }
  return used ? { ...params, strokes: used } : params;
}

/** The first list in the order of the table tells the number of layers; one of another length is malformed. */
function readLayers(reader: AttributeReader<Rocks>, params: Params): Params['layers'] {
  const lists = [...LAYER_ATTRIBUTES].flatMap(([name, row]) => {
    const given = reader.get(name);
    const items = given?.split(/[\s,]+/).filter((item) => item !== '');
    if (!items) return [];
    if (isReadable(row, items)) return [{ name, row, items }];
    // This says so.
    reader.one(name, items[0]!, row, ROCKS.boundsOf(row, params), ROCKS.read(params.layers[0] ?? ROCKS.newItem(0, params), row));
    return [];
  });
  const [first] = lists;
  if (!first) return params.layers;
  if (first.items.length > MAX_LAYERS) reader.note(first.name, 'more-layers', { given: first.items.length, used: MAX_LAYERS });
  const count = Math.min(MAX_LAYERS, first.items.length);
  let layers = Array.from({ length: count }, (_, id) => params.layers[id] ?? ROCKS.newItem(id, params));
  for (const { name, row, items } of lists) {
    if (items.length !== first.items.length) {
      reader.note(name, 'other-length', { given: items.length, used: count });
      continue;
    }
    const bounds = ROCKS.boundsOf(row, params);
    layers = layers.map((layer, index) =>
      ROCKS.written(layer, row, reader.one(name, items[index] ?? '', row, bounds, ROCKS.read(layer, row))),
    );
  }
  return layers;
}
