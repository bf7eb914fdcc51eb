/** `rock-field/three` for Node: the same as `three.ts`, on the thread that calls. three.js itself needs no browser as long as nothing is drawn. */

import { onThisThread } from '../three/on-this-thread.ts';
import type { RockFieldOptions } from '../three/options.ts';
import { addSetters, RockFieldBuilder } from '../three/rock-field.ts';
import type { Setters } from '../three/rock-field.ts';
import { generate } from './core.node.ts';
import { ground } from './ground.node.ts';

export { RockFieldError } from '../base/errors.ts';

class Fields extends RockFieldBuilder {
  constructor(options?: RockFieldOptions) {
    super(() => onThisThread(generate, ground), options);
  }
}
addSetters(Fields);

export interface RockField extends RockFieldBuilder, Setters<RockField> {}
export const RockField = Fields as unknown as new (options?: RockFieldOptions) => RockField;
