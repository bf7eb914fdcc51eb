/** The way to what comes later; of it nothing is fetched before. */

import type * as module from './later.ts';

export type Later = typeof module;

export function loadLater(): Promise<Later> {
  return import('./later.ts');
}
