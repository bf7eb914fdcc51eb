/** `rock-field/three` for Node: the same as `three.ts`, on the thread that calls. three.js itself needs no browser as long as nothing is drawn. */

import { readFile } from 'node:fs/promises';
import { Realm } from '../generator/headless.ts';
import type { GroundModule } from '../rocks/ground.ts';
import { onThisThread } from '../three/on-this-thread.ts';
import type { RockFieldOptions } from '../three/options.ts';
import { addSetters, RockFieldBuilder } from '../three/rock-field.ts';
import type { Setters } from '../three/rock-field.ts';
import { generate } from './core.node.ts';

export { RockFieldError } from '../base/errors.ts';

// Fetched when a ground is first asked for.
const ground = /* @__PURE__ */ new Realm<GroundModule>(
  () => import('../../pkg/ground-mesh.js'),
  () => readFile(new URL('./ground-mesh_bg.wasm', import.meta.url)),
);

class Fields extends RockFieldBuilder {
  constructor(options?: RockFieldOptions) {
    super(() => onThisThread(generate, ground), options);
  }
}
addSetters(Fields);

export interface RockField extends RockFieldBuilder, Setters<RockField> {}
export const RockField = Fields as unknown as new (options?: RockFieldOptions) => RockField;
