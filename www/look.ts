/** What of the parameters is only seen: no generator stage reads it, so an edit of it is drawn and nothing is run. */

import { PRESETS } from './params.ts';
import type { Layer, Params, ParamSpec, PresetName } from './params.ts';
import { FIELD_ROWS, LAYER_ROWS, readValue } from './params-flat.ts';
import type { ColorMode, Look } from './renderer/renderer.ts';

const isLook = ({ stage }: ParamSpec): boolean => stage === 'look';
const isRock = (spec: ParamSpec): boolean => !isLook(spec);

/** For a renderer. */
export function lookOf(params: Params): Look {
  const layers = params.layers.map((layer) => ({ id: layer.id, ...part(layer, LAYER_ROWS) }));
  return { ...part(params, FIELD_ROWS), layers } as unknown as Look;
}

function part(owner: Params | Layer, rows: readonly ParamSpec[]): Record<string, unknown> {
  return Object.fromEntries(rows.filter(isLook).map((spec) => [spec.key, readValue(owner, spec)]));
}

/** Whether the generator makes the same of both. */
export function sameRocks(one: Params, other: Params): boolean {
  return sameIn(one, other, isRock);
}

/** Whether the same field looks the same with both. */
export function sameLook(one: Params, other: Params): boolean {
  return sameIn(one, other, isLook);
}

function sameIn(one: Params, other: Params, counts: (spec: ParamSpec) => boolean): boolean {
  const same = (a: Params | Layer, b: Params | Layer, rows: readonly ParamSpec[]): boolean => rows.every((spec) => !counts(spec) || readValue(a, spec) === readValue(b, spec));
  return (
    same(one, other, FIELD_ROWS) &&
    one.layers.length === other.layers.length &&
    one.layers.every((layer, index) => {
      const like = other.layers[index] as Layer;
      return layer.id === like.id && same(layer, like, LAYER_ROWS);
    })
  );
}

/** The colour of a preset where nobody chose one: a ground as it is found in its own, a figure as the papers have it. */
export function presetColor(preset: PresetName): ColorMode {
  const found = PRESETS.find(({ name }) => name === preset);
  return found && 'natural' in found ? 'natural' : 'layer';
}
