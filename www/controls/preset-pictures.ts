/** Small pictures of natural presets: drawn one after the other by an element that nobody sees, and kept for as long as the page is open. */

import type { GeneratorElement, ElementEventMap } from '../element/generator-element.ts';
import type { Kind, Table } from '../table/table.ts';

/** Device pixels: twice as many as on most screens. */
export const PICTURE_SIZE = { width: 192, height: 128 };
/** Composed events of an element in a shadow root are the host's too. */
const EVENTS: Record<keyof ElementEventMap<string> | 'generate', true> = {
  load: true,
  progress: true,
  generate: true,
  error: true,
  'camera-change': true,
  restored: true,
  notice: true,
};

const kept = new Map<string, ImageBitmap>();

/** Shows the pictures that there are at once, and draws the others, in `place`, until `signal` is aborted. */
export async function drawPictures<K extends Kind>(
  table: Table<K>,
  newElement: () => GeneratorElement<K>,
  place: HTMLElement,
  show: (name: string, picture: ImageBitmap) => void,
  signal: AbortSignal,
): Promise<void> {
  for (const [name, picture] of kept) show(name, picture);
  const missing = table.presets.filter(({ name, natural }) => natural && !kept.has(name));
  if (missing.length === 0) return;
  const element = unseen(newElement());
  signal.addEventListener('abort', () => element.remove());
  place.append(element);
  for (const { name: preset } of missing) {
    try {
      element.params = { ...table.pictured(table.presetParams(preset)), preset };
      await element.generate();
      const picture = await createImageBitmap(await element.toBlob({ ...PICTURE_SIZE, link: false }));
      kept.set(preset, picture);
      if (!signal.aborted) show(preset, picture);
    } catch (thrown) {
      // Its place stays empty; the name says enough.
      if (!signal.aborted) console.info(`rock-field: no picture of ${preset}:`, thrown);
    }
    if (signal.aborted) return;
  }
  element.remove();
}

/** On the screen, since nothing is drawn that is not, but not to be seen, found or touched. */
function unseen<K extends Kind>(element: GeneratorElement<K>): GeneratorElement<K> {
  Object.assign(element.style, {
    position: 'fixed',
    inset: '0 auto auto 0',
    width: '96px',
    height: '64px',
    opacity: '0',
    pointerEvents: 'none',
  });
  element.inert = true;
  element.ariaHidden = 'true';
  element.interaction = 'none';
  for (const type of Object.keys(EVENTS)) element.addEventListener(type, (event) => event.stopImmediatePropagation());
  return element;
}
