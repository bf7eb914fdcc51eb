/** What a row of the rocks' table and a preset are; both are generated from the Rust tables. */

import type { Notation, Row } from '../table/row.ts';

export interface ParamSpec extends Row {
  scope: 'field' | 'layer';
  kind: 'real' | 'integer' | 'optional-integer' | 'choice';
  stage: 'sites' | 'cells' | 'selection' | 'shape' | 'mesh' | 'look';
}

/** One row per layer: r, A_s, c_w1..3, c_h1..3, and for natural grounds weathering, roughness, detail, embedding, material. */
export interface Preset {
  name: string;
  /** A ground as it is found, shown in natural colours; absent for the papers'. */
  natural?: true;
  notation: Notation;
  /** Parameters of the field; the rest have the table's defaults. */
  fields?: Readonly<Record<string, number | string>>;
  layers: readonly (readonly number[])[];
}
