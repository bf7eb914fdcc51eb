/** What colonies can be asked for, as data; built from their parameter table. */

import { BASE_ROWS, COLONY_ROWS, LOG_ROWS, logName, woodEarDefault, woodEarPreset } from './request.ts';
import type { WoodEarParams, WoodEarPresetName } from './request.ts';
import type { WoodEarSpec } from './spec.ts';
import { WOOD_EAR_DOCS } from './param-docs.gen.ts';
import { MAX_BASES, WOOD_EAR_PRESETS } from './params.gen.ts';
import { frozen } from '../rocks/catalogue.ts';
import type { JsonSchema } from '../rocks/catalogue.ts';

/** The presets by name, all parameters spelt out, seed 0. Each is a complete request. */
export const woodEarPresets: Readonly<Record<WoodEarPresetName, Readonly<WoodEarParams>>> = /* @__PURE__ */ allPresets();

/** JSON Schema (2020-12) of a request. */
export const woodEarSchema: JsonSchema = /* @__PURE__ */ requestSchema();

function allPresets(): Readonly<Record<WoodEarPresetName, Readonly<WoodEarParams>>> {
  return frozen(
    Object.fromEntries(WOOD_EAR_PRESETS.map(({ name }) => [name, woodEarPreset(name)])) as Record<WoodEarPresetName, WoodEarParams>,
  );
}

function requestSchema(): JsonSchema {
  const object = (properties: JsonSchema) => ({ type: 'object', additionalProperties: false, properties });
  const [x, y, z, range] = BASE_ROWS.map(valueSchema);
  const base = object({
    position: { type: 'array', prefixItems: [x, y, z], minItems: 3, maxItems: 3, default: [x, y, z].map((part) => part?.['default']) },
    range,
  });
  const logValues: JsonSchema = Object.fromEntries(LOG_ROWS.map((spec) => [logName(spec.key), valueSchema(spec)]));
  const list = (minimum: number) => ({ type: 'array', items: { type: 'number', minimum } });
  const mesh = {
    ...object({ positions: { type: 'array', items: { type: 'number' } }, indices: list(0), spacing: logValues['spacing'] }),
    required: ['positions', 'indices'],
  };
  return frozen({
    $schema: 'https://json-schema.org/draft/2020-12/schema',
    title: 'Request for a colony of wood ears',
    ...object({
      preset: {
        enum: WOOD_EAR_PRESETS.map(({ name }) => name),
        default: WOOD_EAR_PRESETS[0].name,
        description: 'Fills every parameter; each key given then replaces it.',
      },
      ...Object.fromEntries(COLONY_ROWS.map((spec) => [spec.key, valueSchema(spec)])),
      log: { anyOf: [object(logValues), mesh], description: 'The log that is made, or one of your own.' },
      base: { ...base, description: 'The only base.' },
      bases: { type: 'array', minItems: 1, maxItems: MAX_BASES, items: base, description: 'Replaces all bases of the preset.' },
    }),
    not: { required: ['base', 'bases'] },
  });
}

function valueSchema(spec: WoodEarSpec): JsonSchema {
  const words = { title: spec.label, description: WOOD_EAR_DOCS[spec.url]?.en, default: woodEarDefault(spec) };
  if (spec.kind === 'choice') return { ...words, enum: spec.choices.map(({ value }) => value) };
  const type = { real: 'number', integer: 'integer', 'optional-real': ['number', 'null'] }[spec.kind];
  return { ...words, type, minimum: spec.min, maximum: spec.max };
}
