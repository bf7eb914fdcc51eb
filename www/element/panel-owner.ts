/** Between an element and its panel, which is a file of its own: neither knows more of the other than what stands here. */

import type { History } from '../base/history.ts';
import type { Language } from '../base/language.ts';
import type { ColorMode, Theme } from '../base/view.ts';
import type { Draw, Edition, Kind } from '../table/table.ts';

/** An element with a button for its panel. */
export type ControlledElement = HTMLElement & { readonly theme: Theme };

/** What the panel needs of its element beside what is public. */
export interface PanelOwner<K extends Kind, Owner extends ControlledElement> {
  element: Owner;
  root: ShadowRoot;
  language: () => Language;
  /** Whether the element's cycle has begun: before, nothing is loaded. */
  isOpen: () => boolean;
  /** Whether what is shown is what the parameters say. */
  isSettled: () => boolean;
  /** Null while the colour is the preset's. */
  chosenColor: () => ColorMode | null;
  result: () => K['result'] | null;
  random: (params: K['params'], draw: Draw) => Promise<K['params']>;
  history: () => History<Edition<K>>;
  /** The panel, on demand: nothing of it is fetched before. */
  loadPanel: () => Promise<PanelModule<K, Owner>>;
  say: (text: string) => void;
}

/** The panel while it is open. */
export interface OpenPanel {
  focus: () => void;
  readonly hasFocus: boolean;
  /** Something may have changed at the element: shows it. */
  sync: () => void;
  dispose: () => void;
}

/** What the file of a panel exports. */
export interface PanelModule<K extends Kind, Owner extends ControlledElement> {
  openPanel: (owner: PanelOwner<K, Owner>, close: () => void) => OpenPanel;
}
