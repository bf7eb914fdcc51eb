/** The panel of wood ears, on demand, from beside the classic script: of another origin it has no address to import relative to. */

import { lazily } from '../base/lazy.ts';
import type * as Panel from './panel.ts';

export function loadWoodEarPanel(): Promise<typeof Panel> {
  return lazily(() => import(new URL('./wood-ear-panel.js', import.meta.url).href));
}
