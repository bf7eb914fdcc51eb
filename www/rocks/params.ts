/** The parameters of a field, and their table (generated from the Rust one). */

import { MAX_LAYERS, PARAMS, PRESETS } from './params.gen.ts';
import type { Words } from '../base/language.ts';
import type { Row } from '../table/table.ts';

export { MAX_LAYERS, PARAMS, PRESETS };

export type Notation = 'px' | 'relative';
export type Material = 'mixed' | 'granite' | 'basalt' | 'sandstone' | 'limestone' | 'slate';
export type Ground = 'soil' | 'sand' | 'gravel';
/** base, per rock, per vertex */
export type Triple = [number, number, number];

export interface Bounds {
  min: number;
  max: number;
  step: number;
  default: number | null;
  slider: { min: number; max: number; logarithmic: boolean };
}

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

export type PresetName = (typeof PRESETS)[number]['name'];

export interface Layer {
  /** Stable identity; the layer's random streams hang on it. */
  id: number;
  radius: number;
  areaFraction: number;
  cellCount: number | null;
  taper: Triple;
  height: Triple;
  weathering: number;
  roughness: number;
  detail: number;
  embedding: number;
  material: Material;
}

export interface Params {
  seed: number;
  imageWidth: number;
  imageHeight: number;
  packing: number;
  notation: Notation;
  darts: 'saturate' | 'attempts';
  border: 'clip' | 'drop';
  swing: 'shared' | 'separate';
  variation: number;
  wetness: number;
  moss: number;
  dust: number;
  ground: Ground;
  sunAzimuth: number;
  sunElevation: number;
  layers: Layer[];
}
