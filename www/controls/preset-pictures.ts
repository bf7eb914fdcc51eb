/** Small pictures of natural grounds: drawn one after the other by an element that nobody sees, and kept for as long as the page is open. */

import { PRESETS } from '../params.ts';
import { presetParams } from '../params-flat.ts';
import type { Params, PresetName } from '../params.ts';
import type { RockFieldElement, RockFieldEventMap } from '../rock-field-element.ts';

/** Device pixels: twice as many as on most screens. */
export const PICTURE_SIZE = { width: 192, height: 128 };
/** Triangles smaller than a pixel are wasted. */
const MOST_DETAIL = 2;
/** Composed events of an element in a shadow root are the host's too. */
const EVENTS: Record<keyof RockFieldEventMap, true> = { load: true, progress: true, generate: true, error: true, 'camera-change': true, restored: true, notice: true };

const kept = new Map<PresetName, ImageBitmap>();

export const PICTURED: readonly PresetName[] = PRESETS.filter((preset) => 'natural' in preset).map(({ name }) => name);

/** Shows the pictures that there are at once, and draws the others, in `place`, until `signal` is aborted. */
export async function drawPictures(newField: () => RockFieldElement, place: HTMLElement, show: (name: PresetName, picture: ImageBitmap) => void, signal: AbortSignal): Promise<void> {
  for (const [name, picture] of kept) show(name, picture);
  const missing = PICTURED.filter((name) => !kept.has(name));
  if (missing.length === 0) return;
  const field = unseen(newField());
  signal.addEventListener('abort', () => field.remove());
  place.append(field);
  for (const preset of missing) {
    try {
      field.params = { ...coarse(presetParams(preset)), preset };
      await field.getField();
      const picture = await createImageBitmap(await field.toBlob(PICTURE_SIZE));
      kept.set(preset, picture);
      if (!signal.aborted) show(preset, picture);
    } catch (thrown) {
      // Its place stays empty; the name says enough.
      if (!signal.aborted) console.info(`rock-field: no picture of ${preset}:`, thrown);
    }
    if (signal.aborted) return;
  }
  field.remove();
}

function coarse(params: Params): Params {
  return { ...params, layers: params.layers.map((layer) => ({ ...layer, detail: Math.min(layer.detail, MOST_DETAIL) })) };
}

/** On the screen, since nothing is drawn that is not, but not to be seen, found or touched. */
function unseen(field: RockFieldElement): RockFieldElement {
  Object.assign(field.style, { position: 'fixed', inset: '0 auto auto 0', width: '96px', height: '64px', opacity: '0', pointerEvents: 'none' });
  field.inert = true;
  field.ariaHidden = 'true';
  field.interaction = 'none';
  for (const type of Object.keys(EVENTS)) field.addEventListener(type, (event) => event.stopImmediatePropagation());
  return field;
}
