/** `rock-field/wood-ear-log`: registers `<wood-ear-log>`. Silent on a server, and when another copy of this script was first. */

import { WoodEarLogElement } from '../wood-ear/element.ts';

export { WoodEarLogElement };
export type { WoodEarLogEventMap } from '../wood-ear/element.ts';
export type { ErrorInfo, ErrorName } from '../base/errors.ts';
export type { WoodEarColony, WoodEarLog, WoodEarStats, WoodEarTimes } from '../data/colony.ts';
export type { WoodEarBase, WoodEarLogShape, WoodEarParams, WoodEarPresetName } from '../wood-ear/request.ts';
export type { WoodEarSceneParams } from '../wood-ear/table.ts';

declare global {
  interface HTMLElementTagNameMap {
    'wood-ear-log': WoodEarLogElement;
  }
}

if (globalThis.customElements && !customElements.get('wood-ear-log')) customElements.define('wood-ear-log', WoodEarLogElement);
