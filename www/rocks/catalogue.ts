/** What can be asked for, as data: the presets and a JSON Schema, both built from the parameter table. */

import { PARAM_DOCS } from './param-docs.gen.ts';
import { MAX_LAYERS, PRESETS } from './params.ts';
import type { Notation } from '../table/row.ts';
import type { ParamSpec } from './spec.ts';
import type { Params, PresetName } from './params.ts';
import { boundsOf, defaultOf, FIELD_ROWS, LAYER_ROWS, presetParams } from './request.ts';
import { UNITS } from './stroke-numbers.ts';
import { MAX_STROKES_LENGTH } from './stroke-text.ts';
import { FARTHEST, STROKE_MODES } from './strokes.ts';

export type JsonSchema = { readonly [key: string]: unknown };

/** Painted strokes: as links have them, or spelt out. */
const STROKES: JsonSchema = {
  description: 'Painted on the ground: where rocks are added, erased, kept off a path, or as if nothing had been painted.',
  anyOf: [
    { type: 'string', maxLength: MAX_STROKES_LENGTH },
    {
      type: 'array',
      items: {
        type: 'object',
        additionalProperties: false,
        required: ['mode', 'width', 'points'],
        properties: {
          mode: { enum: STROKE_MODES },
          layer: {
            type: ['integer', 'null'],
            minimum: 0,
            maximum: 0xffff_ffff,
            description: 'The id of one layer; all of them without it.',
          },
          width: { type: 'number', minimum: 1 / UNITS, maximum: FARTHEST, description: 'In widths of the image.' },
          points: {
            type: 'array',
            minItems: 2,
            items: { type: 'number', minimum: -FARTHEST, maximum: FARTHEST },
            description: 'x, y, x, y … in widths of the image, from its lower left corner seen from above.',
          },
        },
      },
    },
  ],
};

/** The presets by name, all parameters spelt out, seed 0. Each is a complete request. */
export const presets: Readonly<Record<PresetName, Readonly<Params>>> = frozen(
  Object.fromEntries(PRESETS.map(({ name }) => [name, presetParams(name)])) as Record<PresetName, Params>,
);

/** JSON Schema (2020-12) of a request. */
export const schema: JsonSchema = frozen(requestSchema());

function requestSchema(): JsonSchema {
  const relativePresets = PRESETS.filter(({ notation }) => notation === 'relative').map(({ name }) => name);
  return {
    $schema: 'https://json-schema.org/draft/2020-12/schema',
    title: 'Request for a field of rocks',
    type: 'object',
    additionalProperties: false,
    properties: {
      preset: {
        enum: PRESETS.map(({ name }) => name),
        default: PRESETS[0].name,
        description: 'Fills every parameter; each key given then replaces it.',
      },
      ...propertiesOf(FIELD_ROWS, 'px'),
      layers: { type: 'array', maxItems: MAX_LAYERS, description: 'Replaces all layers of the preset.' },
      strokes: STROKES,
    },
    // Lengths of a layer are in other units, and have other bounds, in the conference's notation.
    if: {
      anyOf: [
        { properties: { notation: { const: 'relative' } }, required: ['notation'] },
        { not: { required: ['notation'] }, properties: { preset: { enum: relativePresets } }, required: ['preset'] },
      ],
    },
    then: { properties: { layers: { items: layerSchema('relative') } } },
    else: { properties: { layers: { items: layerSchema('px') } } },
  };
}

function layerSchema(notation: Notation): JsonSchema {
  const id = {
    type: 'integer',
    minimum: 0,
    maximum: 0xffff_ffff,
    description: 'Stable identity of the layer, unique; default: its index.',
  };
  return { type: 'object', additionalProperties: false, properties: { id, ...propertiesOf(LAYER_ROWS, notation) } };
}

/** One property per key; the three rows of a triple become one list. */
function propertiesOf(rows: readonly ParamSpec[], notation: Notation): Record<string, JsonSchema> {
  const properties: Record<string, JsonSchema> = {};
  for (const spec of rows) {
    if (spec.component === null) {
      properties[spec.key] = valueSchema(spec, notation);
    } else if (spec.component === 0) {
      const parts = rows.filter(({ key }) => key === spec.key).map((part) => valueSchema(part, notation));
      const fallback = parts.map((part) => part['default']);
      properties[spec.key] = { type: 'array', prefixItems: parts, minItems: parts.length, maxItems: parts.length, default: fallback };
    }
  }
  return properties;
}

function valueSchema(spec: ParamSpec, notation: Notation): JsonSchema {
  const words = { title: spec.label, description: PARAM_DOCS[spec.url]?.en, default: defaultOf(spec, notation) };
  if (spec.kind === 'choice') return { ...words, enum: spec.choices.map(({ value }) => value) };
  const { min, max } = boundsOf(spec, notation);
  const type = { real: 'number', integer: 'integer', 'optional-integer': ['integer', 'null'] }[spec.kind];
  return { ...words, type, minimum: min, maximum: max };
}

export function frozen<T>(value: T): T {
  if (typeof value === 'object' && value !== null) {
    Object.values(value).forEach(frozen);
    Object.freeze(value);
  }
  return value;
}
