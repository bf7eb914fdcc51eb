/** `rock-field/core` for Node: the same as `core.ts`, with the wasm read from the file beside this script. */

import { readFile } from 'node:fs/promises';
import * as glue from '../../pkg/generator.js';
import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import { generateOnce, openGenerator } from '../rocks/headless.ts';
import { Realm } from '../generator/headless.ts';
import type { FieldGenerator, FieldGeneratorOptions, GenerateOptions } from '../rocks/headless.ts';
import type { FullModule } from '../rocks/full-session.ts';
import type { GeneratorModule } from '../rocks/session.ts';
import type { GeneratorOptions } from '../generator/headless.ts';
import { growOnce, openWoodEars } from '../wood-ear/headless.ts';
import type { WoodEarGenerator, WoodEarOptions } from '../wood-ear/headless.ts';
import type { WoodEarModule } from '../wood-ear/session.ts';
import type { PaintedRequest } from '../rocks/painted.ts';
import type { WoodEarRequest } from '../wood-ear/request.ts';

export { RockFieldError } from '../base/errors.ts';
export type { ErrorInfo, ErrorName } from '../base/errors.ts';
export { presets, schema } from '../rocks/catalogue.ts';
export { strokesOfText, strokesToText } from '../rocks/strokes.ts';
export { woodEarPresets, woodEarSchema } from '../wood-ear/catalogue.ts';

const realms = {
  plain: new Realm<GeneratorModule>(glue, () => readFile(new URL('./generator_bg.wasm', import.meta.url))),
  full: /* @__PURE__ */ new Realm<FullModule>(
    () => import('../../pkg/generator-full.js'),
    () => readFile(new URL('./generator-full_bg.wasm', import.meta.url)),
  ),
};
// Fetched when a colony is first asked for.
const woodEars = /* @__PURE__ */ new Realm<WoodEarModule>(
  () => import('../../pkg/wood-ear.js'),
  () => readFile(new URL('./wood-ear_bg.wasm', import.meta.url)),
);

/** A generator that keeps its stages between runs; free it with `dispose()`. */
export function createGenerator(options?: FieldGeneratorOptions): Promise<FieldGenerator> {
  return openGenerator(realms, options);
}

/** One field, no cache kept. */
export function generate(request?: PaintedRequest, options?: GenerateOptions): Promise<Field> {
  return generateOnce(realms, request, options);
}

/** A generator of wood ears that keeps its stages between runs; free it with `dispose()`. */
export function createWoodEarGenerator(options?: GeneratorOptions): Promise<WoodEarGenerator> {
  return openWoodEars(woodEars, options);
}

/** One colony of wood ears on its log, no cache kept. */
export function growWoodEar(request?: WoodEarRequest, options?: WoodEarOptions & GeneratorOptions): Promise<WoodEarColony> {
  return growOnce(woodEars, request, options);
}
