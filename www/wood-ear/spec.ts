/** The parameters of a wood-ear colony, and their table (generated from the Rust one). */

import type { Row } from '../table/row.ts';

/** One row of the table. Lengths are in cm; nothing is in the conference's notation. */
export interface WoodEarSpec extends Row {
  component: null;
  scope: 'field' | 'base';
  kind: 'real' | 'integer' | 'optional-real' | 'choice';
  stage: 'log' | 'spawn' | 'deform' | 'collide' | 'mesh' | 'look';
  relative: null;
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
