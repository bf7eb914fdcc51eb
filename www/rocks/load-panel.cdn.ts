/** The panel, on demand, from beside cdn.js: a classic script of another origin has no address to import relative to. */

import { lazily } from '../base/lazy.ts';
import type * as Panel from './panel.ts';

export function loadPanel(): Promise<typeof Panel> {
  return lazily(() => import(new URL('./panel.js', import.meta.url).href));
}
