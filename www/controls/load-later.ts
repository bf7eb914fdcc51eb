/** The way to what comes later; of it nothing is fetched before. */

import { lazily } from '../base/lazy.ts';
import type * as module from './later.ts';

export type Later = typeof module;

let loaded: Later | undefined;

export async function loadLater(): Promise<Later> {
  return (loaded = await lazily(() => import('./later.ts')));
}

/** Calls `use` with it: at once where it has been loaded, so that edits are made in the order in which they were asked for. */
export async function withLater(use: (later: Later) => void): Promise<void> {
  use(loaded ?? (await loadLater()));
}
