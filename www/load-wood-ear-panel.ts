/** The panel of wood ears, on demand: nothing of it is fetched before. The classic script has load-wood-ear-panel.cdn.ts in this file's place. */

import { lazily } from './lazy.ts';
import type * as Panel from './wood-ear-panel.ts';

export function loadWoodEarPanel(): Promise<typeof Panel> {
  return lazily(() => import('./wood-ear-panel.ts'));
}
