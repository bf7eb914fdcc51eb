/** `rock-field`: registers `<rock-field>`. Silent on a server, and when another copy of this script was first. */

import { RockFieldElement } from './rock-field-element.ts';
import type { RockFieldEventMap } from './rock-field-element.ts';

export { RockFieldElement };
export type { RockFieldEventMap };
export type { Field, FieldLayer, FieldStats, StageTimes } from './field.ts';
export type { Layer, Params, PresetName } from './params.ts';
export type { CameraState, ColorMode, View } from './renderer/renderer.ts';

declare global {
  interface HTMLElementTagNameMap {
    'rock-field': RockFieldElement;
  }
}

if (globalThis.customElements && !customElements.get('rock-field')) customElements.define('rock-field', RockFieldElement);
