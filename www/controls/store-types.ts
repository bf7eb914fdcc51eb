/** What a store holds and tells. */

import type { Notice } from '../table/notices.ts';
import type { Link } from '../table/link.ts';
import type { Theme } from '../base/view.ts';
import type { Language } from '../base/language.ts';
import type { Row } from '../table/row.ts';
import type { Kind } from '../table/table.ts';

/** A message that belongs under a control. It is put into words when it is shown, in the language of that moment. */
export interface Problem {
  key: string;
  /** Of a row of items: whose. */
  item: number | null;
  component: number | null;
  text: (language: Language) => string;
  /** What was set there and refused: the control still shows it, until something else is set. */
  refused?: number | string | null;
}

/** A value that was set in a control. */
export interface Wish {
  row: Row;
  item: number | null;
  value: number | string | null;
}

/** How things stood when the error came. */
export interface Circumstances<K extends Kind> {
  params: K['params'];
  /** The edit was taken back. */
  isBack: boolean;
  /** What was set in a control and taken back. */
  wish: Wish | null;
}

/** How the result is looked at. */
export type Seen<K extends Kind> = Pick<Link<K>, 'view' | 'color' | 'camera'>;

/** A quicker way to what a long run is after. */
export interface Offer {
  text: string;
  label: string;
  take: () => void;
}

/** A line for the whole page. */
export type Message = (language: Language) => string;

/** What helps when the page itself is not whole any more, with a button for it. */
export interface Remedy {
  text: Message;
  label: Message;
  act: () => void;
}

export interface Line {
  text: Message;
  /** Something went wrong; else something is merely said. */
  isProblem: boolean;
}

/** What changed, so that the wiring does no more than it must. */
export type Change = 'params' | 'look' | 'camera' | 'preferences' | 'result' | 'progress' | 'messages';

/** What a link says, and what was wrong with it. */
export type OpenedLink<K extends Kind> = Link<K> & { notices: readonly Notice[] };

export interface Preferences {
  language: Language;
  theme: Theme;
}
