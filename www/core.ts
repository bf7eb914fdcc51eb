/**
 * `rock-field/core` for browsers, workers and bundlers: fields without a page.
 *
 * The work is done on the thread that calls, in slices of about 16 ms. It imports nothing from Node.
 */

import * as glue from '../pkg/generator.js';
import type { Field } from './field.ts';
import { generateOnce, openGenerator, Realm } from './generator/headless.ts';
import type { FieldGenerator, GenerateOptions, GeneratorOptions } from './generator/headless.ts';
import type { FieldRequest } from './params-flat.ts';

export { RockFieldError } from './errors.ts';
export { presets, schema } from './generator/catalogue.ts';
export type { Field, FieldLayer, FieldStats, StageTimes } from './field.ts';
export type { FieldGenerator, GenerateOptions, GeneratorOptions } from './generator/headless.ts';
export type { Progress, StageName } from './generator/protocol.ts';
export type { FieldRequest, LayerRequest } from './params-flat.ts';
export type { Layer, Params, PresetName, Triple } from './params.ts';

const realm = new Realm(glue, () => new URL('./generator_bg.wasm', import.meta.url));

/** A generator that keeps its stages between runs; free it with `dispose()`. */
export function createGenerator(options?: GeneratorOptions): Promise<FieldGenerator> {
  return openGenerator(realm, options);
}

/** One field, no cache kept. */
export function generate(request?: FieldRequest, options?: GenerateOptions): Promise<Field> {
  return generateOnce(realm, request, options);
}
