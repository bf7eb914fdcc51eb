/** The parameters of a wood-ear colony, and their table (generated from the Rust one). */

import type { Bounds, Notation, Words } from './params.ts';

/** One row of the table. Lengths are in cm; nothing is in the conference's notation. */
export interface WoodEarSpec extends Bounds {
  key: string;
  component: null;
  url: string;
  scope: 'field' | 'base';
  kind: 'real' | 'integer' | 'optional-real' | 'choice';
  /** First stage an edit re-runs; `look` re-runs none and is drawn at once. */
  stage: 'log' | 'spawn' | 'deform' | 'collide' | 'mesh' | 'look';
  relative: null;
  unit: Record<Notation, string>;
  label: Words;
  doc: Words;
  choices: readonly { value: string; label: Words }[];
}

export interface WoodEarPreset {
  name: string;
  /** A colony as it is found; absent for the thesis's scenes. */
  natural?: true;
  /** Parameters of the colony; the rest have the table's defaults. */
  fields?: Readonly<Record<string, number | string>>;
  /** x, y, z, range (null: the colony's) per base; absent for one base at the default. */
  bases?: readonly (readonly (number | null)[])[];
}
