/** The way to what comes later; of it nothing is fetched before. */

import { lazily } from '../lazy.ts';
import type * as module from './later.ts';

export type Later = typeof module;

export function loadLater(): Promise<Later> {
  return lazily(() => import('./later.ts'));
}
