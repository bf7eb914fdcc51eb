/** What can be written on the element in a template: attributes and properties by name, and listeners as each framework spells them. */

import type { Backend, PresetName, RockFieldElement, RockFieldEventMap } from '../element.ts';

type Settable = 'params' | 'layers' | 'view' | 'color' | 'interaction' | 'cameraOrbit' | 'metresPerPixel' | 'theme';

export type RockFieldProps = { [Name in Settable]?: RockFieldElement[Name] | undefined } & {
  camera?: RockFieldElement['camera'] | null | undefined;
  /** Name of a preset; default `journal-fig1`. */
  preset?: PresetName | undefined;
  /** Whole number; replaces the seed of `src` or of the preset. */
  seed?: number | string | undefined;
  /** A share link or its fragment, or parameters as JSON; fills everything. */
  src?: string | undefined;
  /** Read when the element is connected; `null` draws nothing. */
  backend?: 'auto' | Backend | undefined;
  /** `lazy`: nothing is loaded before the element comes near the screen. */
  loading?: 'eager' | 'lazy' | undefined;
  /** Address of a picture that stands in until the first one is painted. */
  poster?: string | undefined;
  /** A button that opens the panel; `open`: it begins open. */
  controls?: boolean | 'open' | undefined;
  disabled?: boolean | undefined;
};

/** `ongenerate`, `oncamera-change`, …: React 19 and Svelte 5 listen to whatever follows the `on`. */
export type RockFieldListeners = {
  [Type in keyof RockFieldEventMap as `on${Type}`]?: ((event: RockFieldEventMap[Type]) => void) | undefined;
};
