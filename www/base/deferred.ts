/** A file that the first picture does not need. */

import { lazily } from './lazy.ts';

/** Nothing of the file is fetched before one of these is called. */
export interface Deferred<Module> {
  /** One attempt at a time; after one that failed, the next call tries again. */
  load(): Promise<Module>;
  /** Calls `use` with the file: at once where it has been loaded, so that edits are made in the order in which they were asked for. */
  use(use: (module: Module) => void): Promise<void>;
}

export function deferred<Module>(from: () => Promise<Module>): Deferred<Module> {
  let loading: Promise<Module> | undefined;
  let loaded: Module | undefined;
  const load = (): Promise<Module> =>
    (loading ??= lazily(from).then(
      (module) => (loaded = module),
      (error: unknown) => {
        loading = undefined;
        throw error;
      },
    ));
  return { load, use: async (use) => use(loaded ?? (await load())) };
}
