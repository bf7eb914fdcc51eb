/** The parameters of a field, and their table (generated from the Rust one). */

import { MAX_LAYERS, PARAMS, PRESETS } from './params.gen.ts';
import type { Notation } from '../table/row.ts';

export { MAX_LAYERS, PARAMS, PRESETS };

export type Material = 'mixed' | 'granite' | 'basalt' | 'sandstone' | 'limestone' | 'slate';
export type Ground = 'soil' | 'sand' | 'gravel';
/** base, per rock, per vertex */
export type Triple = [number, number, number];

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

type LayerKey = Exclude<keyof Layer, 'id'>;

/** The layers' values of one parameter as a list, whose length is the number of layers; of a triple, one list for each part. */
type LayerProperties = {
  [Key in LayerKey as Layer[Key] extends Triple ? `${Key}${'Base' | 'Rock' | 'Vertex'}` : Key]: (Layer[Key] extends Triple ? number : Layer[Key])[];
};

export type ParameterProperties = Omit<Params, 'layers'> & LayerProperties;
