/** `rock-field/three`: fields of rocks for scenes of three.js. They are generated in the workers that the element has, so that the page stays free. */

import { addSetters, RockFieldBuilder } from '../three/rock-field.ts';
import type { Setters } from '../three/rock-field.ts';
import { workers } from '../three/in-workers.ts';
import type { RockFieldOptions } from '../three/options.ts';

export { RockFieldError } from '../base/errors.ts';
export type { ErrorInfo, ErrorName } from '../base/errors.ts';
export type { BuildProgress, BuildRun, FoundRock } from '../three/rock-field.ts';
export type { RockFieldOptions } from '../three/options.ts';
export type { FieldRequest, LayerRequest } from '../rocks/request.ts';
export type { Layer, Params, PresetName, Triple } from '../rocks/params.ts';

class Fields extends RockFieldBuilder {
  constructor(options?: RockFieldOptions) {
    super(workers, options);
  }
}
addSetters(Fields);

/**
 * A field of rocks in the shape of three's own generators, but that `build()` is asynchronous:
 *
 * ```js
 * const rocks = new RockField({ preset: 'riverbed' });
 * scene.add(await rocks.setSeed(7).build());
 * ```
 */
export interface RockField extends RockFieldBuilder, Setters<RockField> {}
export const RockField = Fields as unknown as new (options?: RockFieldOptions) => RockField;
