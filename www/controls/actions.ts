/** What the buttons of a panel do. */

import type { GeneratorElement } from '../element/generator-element.ts';
import type { Kind } from '../table/table.ts';

/** What the panel's place does that the store cannot. */
export interface Actions<K extends Kind> {
  /** The element whose panel this is, or the page's. */
  element: GeneratorElement<K>;
  freshSeed: () => void;
  randomise: () => void;
  /** An element like the one whose panel this is. */
  newElement: () => GeneratorElement<K>;
  share: () => void;
  /** The link to what is shown; the page's alone. */
  link?: () => string;
  /** Absent where nobody knows the address of a script to embed. */
  embed?: (() => void) | undefined;
  /** Saves what is shown as a picture; the page's alone. */
  showPicture?: () => void;
  /** Brings back the scene of a file; the page's alone. */
  openFiles?: (files: readonly File[]) => void;
  /** Lists the page's keys. */
  help?: () => void;
  /** Resolves when the first picture is there, or takes too long to wait for it: its controls come after it. The page's alone. */
  pictured?: Promise<unknown>;
  /** An element's panel alone is closed, and cancels in itself: on the page, `<stage-overlay>` has that. */
  close?: () => void;
  cancel?: () => void;
}
