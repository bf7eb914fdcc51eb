/**
 * `rock-field/core` for browsers, workers and bundlers: fields without a page.
 *
 * The work is done on the thread that calls, in slices of about 16 ms. It imports nothing from Node.
 */

import start, { __wbg_reset_state, fresh_seed, Generator, memory_estimate } from '../../pkg/generator.js';
import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import { generateOnce, openGenerator } from '../rocks/headless.ts';
import { Realm } from '../generator/headless.ts';
import type { FieldGenerator, FieldGeneratorOptions, GenerateOptions } from '../rocks/headless.ts';
import type { FullModule } from '../rocks/full-session.ts';
import type { GeneratorOptions } from '../generator/headless.ts';
import type { GeneratorGlue } from '../rocks/session.ts';
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
export type { Field, FieldLayer, FieldStats, StageTimes } from '../data/field.ts';
export type { FieldGenerator, FieldGeneratorOptions, GenerateOptions } from '../rocks/headless.ts';
export type { GeneratorOptions } from '../generator/headless.ts';
export type { Progress, StageName } from '../generator/protocol.ts';
export type { FieldRequest, LayerRequest } from '../rocks/request.ts';
export type { Mask } from '../rocks/mask.ts';
export type { PaintedRequest } from '../rocks/painted.ts';
export type { Stroke, StrokeMode } from '../rocks/strokes.ts';
export type { Layer, Params, PresetName, Triple } from '../rocks/params.ts';
export type { WoodEarColony, WoodEarLog, WoodEarStats, WoodEarTimes } from '../data/colony.ts';
export type { WoodEarGenerator, WoodEarOptions } from '../wood-ear/headless.ts';
export type { WoodEarStage } from '../wood-ear/session.ts';
export type {
  WoodEarBase,
  WoodEarLogMesh,
  WoodEarLogShape,
  WoodEarParams,
  WoodEarPresetName,
  WoodEarRequest,
} from '../wood-ear/request.ts';

// By name: a bundler's object of a whole module would put a helper into every script of the page.
const glue: GeneratorGlue = { default: start, Generator, fresh_seed, memory_estimate, __wbg_reset_state };
const realms = {
  plain: new Realm(glue, () => new URL('./generator_bg.wasm', import.meta.url)),
  // Fetched when a field is first painted.
  full: /* @__PURE__ */ new Realm<FullModule>(
    () => import('../../pkg/generator-full.js'),
    () => new URL('./generator-full_bg.wasm', import.meta.url),
  ),
};
// Fetched when a colony is first asked for.
const woodEars = /* @__PURE__ */ new Realm<WoodEarModule>(
  () => import('../../pkg/wood-ear.js'),
  () => new URL('./wood-ear_bg.wasm', import.meta.url),
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
