/** What can be written on the element in a template: attributes and properties by name, and listeners as each framework spells them. */

import type { Backend, ColorMode, Params, PresetName, RockFieldElement, RockFieldEventMap, View } from '../element.ts';

export interface RockFieldProps {
  /** Name of a preset; default `journal-fig1`. */
  preset?: PresetName | undefined;
  /** Whole number; replaces the seed of `src` or of the preset. */
  seed?: number | string | undefined;
  /** A share link, or its fragment; fills everything. */
  src?: string | undefined;
  view?: View | undefined;
  color?: ColorMode | undefined;
  /** Read when the element is connected; `null` draws nothing. */
  backend?: 'auto' | Backend | undefined;
  params?: Params | undefined;
  camera?: RockFieldElement['camera'] | null | undefined;
  theme?: RockFieldElement['theme'] | undefined;
}

/** `ongenerate`, `oncamera-change`, …: React 19 and Svelte 5 listen to whatever follows the `on`. */
export type RockFieldListeners = {
  [Type in keyof RockFieldEventMap as `on${Type}`]?: ((event: RockFieldEventMap[Type]) => void) | undefined;
};
