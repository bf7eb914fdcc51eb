/** `rock-field/svelte`: `<rock-field>` in the templates of Svelte 5. */

import type { HTMLAttributes } from 'svelte/elements';
import type { RockFieldElement } from '../element.ts';
import type { RockFieldListeners, RockFieldProps } from './props.ts';

declare module 'svelte/elements' {
  interface SvelteHTMLElements {
    'rock-field': Omit<HTMLAttributes<RockFieldElement>, keyof RockFieldProps | keyof RockFieldListeners> & RockFieldProps & RockFieldListeners;
  }
}
