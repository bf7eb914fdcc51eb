/** The options of an export as data. */

import { OPTIONS, TARGETS } from './options.ts';

type JsonSchema = { readonly [key: string]: unknown };

/** JSON Schema (2020-12) of the options. */
export const exportSchema: JsonSchema = /* @__PURE__ */ optionsSchema();

function optionsSchema(): JsonSchema {
  const properties: Record<string, JsonSchema> = {
    target: {
      oneOf: Object.entries(TARGETS).map(([name, { title, options }]) => ({ const: name, title, description: defaultsOf(options) })),
      default: 'gltf',
      description: 'The tool that the file is for. It sets defaults, in whose place any option given beside it counts.',
    },
  };
  for (const [key, row] of Object.entries(OPTIONS)) {
    const { doc: description, default: value } = row;
    if (row.kind === 'choice') properties[key] = { enum: row.choices, default: value, description };
    else if (row.kind === 'switch') properties[key] = { type: 'boolean', default: value, description };
    else {
      const type = row.kind === 'integer' ? 'integer' : 'number';
      properties[key] = { type, minimum: row.min, maximum: row.max, default: value, description };
    }
  }
  return {
    $schema: 'https://json-schema.org/draft/2020-12/schema',
    title: 'Options of an export',
    type: 'object',
    additionalProperties: false,
    properties,
  };
}

function defaultsOf(options: object): string {
  const words = Object.entries(options).map(([key, value]) => `${key} ${String(value)}`);
  return words.length > 0 ? words.join(', ') : 'the defaults';
}
