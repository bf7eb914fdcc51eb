/** `rock-field/core` for Node: the same as `core.ts`, with the wasm read from the file beside this script. */

import { readFile } from 'node:fs/promises';
import * as glue from '../pkg/generator.js';
import type { Field } from './field.ts';
import { generateOnce, openGenerator, Realm } from './generator/headless.ts';
import type { FieldGenerator, GenerateOptions, GeneratorOptions } from './generator/headless.ts';
import type { FieldRequest } from './params-flat.ts';

export { RockFieldError } from './errors.ts';
export { presets, schema } from './generator/catalogue.ts';

const realm = new Realm(glue, () => readFile(new URL('./generator_bg.wasm', import.meta.url)));

/** A generator that keeps its stages between runs; free it with `dispose()`. */
export function createGenerator(options?: GeneratorOptions): Promise<FieldGenerator> {
  return openGenerator(realm, options);
}

/** One field, no cache kept. */
export function generate(request?: FieldRequest, options?: GenerateOptions): Promise<Field> {
  return generateOnce(realm, request, options);
}
