// What the types have to refuse; a line that they let pass is an error of its own. In a template there is no way to expect one.
import type { SvelteHTMLElements } from 'svelte/elements';
import type {} from 'rock-field/svelte';

export const wrong: SvelteHTMLElements['rock-field'][] = [
  // @ts-expect-error no such view
  { view: '4d' },
  // @ts-expect-error no such preset
  { preset: 'journal-fig99' },
  // @ts-expect-error not a number
  { seed: 'seven' },
  // @ts-expect-error a list, one radius for each layer
  { radius: 90 },
  // @ts-expect-error not a number, as an attribute
  { 'image-width': 'wide' },
  // @ts-expect-error no such choice
  { swing: 'both' },
  // @ts-expect-error no such parameter
  { imageSize: 800 },
  // @ts-expect-error a generate event has no camera
  { ongenerate: ({ detail }) => detail.camera },
  // @ts-expect-error a camera event has no statistics
  { 'oncamera-change': ({ detail }) => detail.stats },
];
