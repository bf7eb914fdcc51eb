/** What a row of the rocks' table and a preset are; both are generated from the Rust tables. */

import type { Notation, Row } from '../table/row.ts';

export interface ParamSpec extends Row {
  scope: 'field' | 'layer';
  kind: 'real' | 'integer' | 'optional-integer' | 'choice';
  stage: 'sites' | 'cells' | 'selection' | 'shape' | 'mesh' | 'look';
}

export interface Preset {
  name: string;
  /** A ground as it is found, shown in natural colours; absent for the papers'. */
  natural?: true;
  notation: Notation;
  /** Parameters of the field; the rest have the table's defaults. */
  fields?: Readonly<Record<string, number | string>>;
  /** One row per layer, in the order of the layer's rows of the table without `cellCount`; values missing at the end have the table's defaults. */
  layers: readonly (readonly number[])[];
}

/** base, per rock, per vertex */
export type Triple = [number, number, number];
