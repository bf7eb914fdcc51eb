/** The panel of wood ears, on demand, from beside the classic script: of another origin it has no address to import relative to. */

import type * as Panel from './wood-ear-panel.ts';

export function loadWoodEarPanel(): Promise<typeof Panel> {
  return import(new URL('./wood-ear-panel.js', import.meta.url).href);
}
