/** `rock-field`: registers `<rock-field>`. Silent on a server, and when another copy of this script was first. */

import { RockFieldElement } from './element.ts';

export * from './element.ts';

declare global {
  interface HTMLElementTagNameMap {
    'rock-field': RockFieldElement;
  }
}

if (globalThis.customElements && !customElements.get('rock-field')) customElements.define('rock-field', RockFieldElement);
