/** The rocks' generator, as the parts that all generators share know it. */

import type { Field } from '../data/field.ts';
import type { StageName } from '../generator/protocol.ts';
import { lazily } from '../base/lazy.ts';
import { MAX_LAYERS, PRESETS } from './params.ts';
import type { Layer, Params, PresetName } from './params.ts';
import { boundsOf, defaultLayer, FIELD_ROWS, LAYER_ROWS, presetParams, readValue, resolveParams, writeValue } from './request.ts';
import type { Kind, Table } from '../table/table.ts';

export interface Rocks extends Kind {
  params: Params;
  item: Layer;
  preset: PresetName;
  result: Field;
  stage: StageName;
}

export const ROCKS: Table<Rocks> = {
  rows: FIELD_ROWS,
  itemRows: LAYER_ROWS,
  itemCount: { min: 0, max: MAX_LAYERS },
  presets: PRESETS,
  views: ['3d', 'wireframe', 'diagrams', 'selection'],
  colors: ['layer', 'rock', 'plain', 'natural'],
  presetParams,
  items: ({ layers }) => layers,
  withItems: (params, layers) => ({ ...params, layers: [...layers] }),
  // Not an id that another layer has, or had.
  newItem: (index, { notation, layers }) => defaultLayer(1 + Math.max(-1, ...layers.map(({ id }) => id)) + index - layers.length, notation),
  boundsOf: (row, { notation }) => boundsOf(row, notation),
  unitOf: ({ unit }, { notation }) => unit[notation],
  read: readValue,
  written: (owner, row, value) => {
    const copy = row.component === null ? { ...owner } : structuredClone(owner);
    writeValue(copy, row, value);
    return copy;
  },
  resolve: resolveParams,
  docs: async () => (await lazily(() => import('./param-docs.gen.ts'))).PARAM_DOCS,
  // Triangles smaller than a pixel are wasted: a quarter of them will do.
  pictured: (params) => ({ ...params, layers: params.layers.map((layer) => ({ ...layer, detail: layer.detail / 2 })) }),
  sameBesides: (one, other) => one.strokes === other.strokes && one.layers.every(({ id }, index) => id === other.layers[index]?.id),
};
