/** The parameters of a field, and their table (generated from the Rust one). */

import { MAX_LAYERS, PARAMS, PRESETS } from './params.gen.ts';
import type { Layer, Params as TableParams } from './params.gen.ts';
import type { Triple } from './spec.ts';

export { MAX_LAYERS, PARAMS, PRESETS };
export type { Layer, Triple };

export interface Params extends TableParams {
  /** Painted strokes as links have them; absent where there are none. */
  strokes?: string | undefined;
}

export type PresetName = (typeof PRESETS)[number]['name'];

type LayerKey = Exclude<keyof Layer, 'id'>;

/** The layers' values of one parameter as a list, whose length is the number of layers; of a triple, one list for each part. */
type LayerProperties = {
  [Key in LayerKey as Layer[Key] extends Triple ? `${Key}${'Base' | 'Rock' | 'Vertex'}` : Key]: (Layer[Key] extends Triple
    ? number
    : Layer[Key])[];
};

export type ParameterProperties = Omit<Params, 'layers' | 'strokes'> & LayerProperties & { strokes: string };
