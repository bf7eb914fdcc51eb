/** `rock-field/svelte`: `<rock-field>` and `<wood-ear-log>` in the templates of Svelte 5. */

import type { HTMLAttributes } from 'svelte/elements';
import type { RockFieldElement } from '../entries/element.ts';
import type { WoodEarLogElement } from '../entries/wood-ear-log.ts';
import type { RockFieldListeners, RockFieldProps, WoodEarLogListeners, WoodEarLogProps } from './props.ts';

declare module 'svelte/elements' {
  interface SvelteHTMLElements {
    'rock-field': Omit<HTMLAttributes<RockFieldElement>, keyof RockFieldProps | keyof RockFieldListeners> &
      RockFieldProps &
      RockFieldListeners;
    'wood-ear-log': Omit<HTMLAttributes<WoodEarLogElement>, keyof WoodEarLogProps | keyof WoodEarLogListeners> &
      WoodEarLogProps &
      WoodEarLogListeners;
  }
}
