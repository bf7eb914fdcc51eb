/** The page's icons: 16 × 16, drawn with the text's colour. */

import { html } from 'lit';
import type { TemplateResult } from 'lit';

const PATHS = {
  undo: 'M6.5 2.5 3 6l3.5 3.5M3.3 6H9a3.75 3.75 0 0 1 0 7.5H6',
  redo: 'M9.5 2.5 13 6 9.5 9.5M12.7 6H7a3.75 3.75 0 0 0 0 7.5h3',
  reset: 'M3.2 8a4.8 4.8 0 1 0 1.5-3.5L3 6M3 2.5V6h3.5',
  randomise:
    'M1.5 4.5h1.9c1 0 1.9.5 2.4 1.3l2.9 4.4c.5.8 1.4 1.3 2.4 1.3H14M12 9.2l2.2 2.3L12 13.8M1.5 11.5h1.9c1 0 1.9-.5 2.4-1.3M8.7 5.8c.5-.8 1.4-1.3 2.4-1.3H14M12 2.2l2.2 2.3L12 6.8',
  dice: 'M4.2 2.5h7.6c.9 0 1.7.8 1.7 1.7v7.6c0 .9-.8 1.7-1.7 1.7H4.2c-.9 0-1.7-.8-1.7-1.7V4.2c0-.9.8-1.7 1.7-1.7zM5.5 5.5h.01M10.5 5.5h.01M8 8h.01M5.5 10.5h.01M10.5 10.5h.01',
  share: 'M8 9.7V2M5 4.7 8 1.8l3 2.9M5 7H3.3v6.7h9.4V7H11',
  save: 'M8 1.8v7.7M5 6.7 8 9.8l3-3.1M2.8 10.5v3h10.4v-3',
  previous: 'M10 3.5 5.5 8l4.5 4.5',
  next: 'M6 3.5 10.5 8 6 12.5',
  down: 'M3.5 6 8 10.5 12.5 6',
  add: 'M8 3v10M3 8h10',
  remove: 'M2.8 4.5h10.4M6.3 4.2V2.5h3.4v1.7M4.3 4.5l.6 9h6.2l.6-9M6.8 7v4M9.2 7v4',
  duplicate: 'M5.7 5.7h7.8v7.8H5.7zM10.3 5.5v-3H2.5v7.8h3',
  frame: 'M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3M5.5 6.5h5v3h-5z',
  fullScreen: 'M9.5 2.5h4v4M13.3 2.7 9.5 6.5M6.5 13.5h-4v-4M2.7 13.3l3.8-3.8',
  leaveFullScreen: 'M13.5 6.5h-4v-4M9.7 6.3l3.8-3.8M2.5 9.5h4v4M6.3 9.7l-3.8 3.8',
  close: 'M4 4l8 8M12 4l-8 8',
  lock: 'M3.5 7.5h9v6h-9zM5.2 7.3V5.2a2.8 2.8 0 0 1 5.6 0v2.1',
  unlock: 'M3.5 7.5h9v6h-9zM5.2 7.3V5a2.8 2.8 0 0 1 5.3-1.2',
  code: 'M5.5 4 1.8 8l3.7 4M10.5 4l3.7 4-3.7 4',
  help: 'M5.8 6.1a2.2 2.2 0 1 1 3.3 1.9c-.8.5-1.1.9-1.1 1.7M8 12h.01',
} as const;

export type IconName = keyof typeof PATHS;

export function icon(name: IconName): TemplateResult {
  return drawn(PATHS[name]);
}

/** Of a path that is not in the list, since the first picture does not need it. */
export function drawn(path: string): TemplateResult {
  return html`<svg class="icon" viewBox="0 0 16 16" aria-hidden="true" focusable="false"><path d=${path}></path></svg>`;
}
