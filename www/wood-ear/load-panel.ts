/** The panel of wood ears, on demand: nothing of it is fetched before. The classic script has load-panel.cdn.ts in this file's place. */

import { lazily } from '../base/lazy.ts';
import type * as Panel from './panel.ts';

export function loadWoodEarPanel(): Promise<typeof Panel> {
  return lazily(() => import('./panel.ts'));
}
