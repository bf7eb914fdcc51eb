/** The panel, on demand: nothing of it is fetched before. cdn.js has load-panel.cdn.ts in this file's place. */

import { lazily } from '../base/lazy.ts';
import type * as Panel from './panel.ts';

export function loadPanel(): Promise<typeof Panel> {
  return lazily(() => import('./panel.ts'));
}
