/** Scripts that are fetched when they are wanted. On a page that was open during a deployment, the server may not have them any more. */

import { scriptUnavailable } from './errors.ts';

/** Undefined: nothing is missing. */
let missing: { isSaid: boolean } | undefined;
let listener: ((isSaid: boolean) => void) | undefined;

/**
 * `hear` is called whenever a file of this build could not be had, and at once if that has happened already. `isSaid`: the element that
 * needs the file says so, and offers to try again.
 */
export function onMissingFile(hear: (isSaid: boolean) => void): void {
  listener = hear;
  if (missing) hear(missing.isSaid);
}

/** To be called by whoever could not fetch a file of this build. */
export function tellMissingFile(isSaid = false): void {
  missing = { isSaid: isSaid && missing?.isSaid !== false };
  listener?.(isSaid);
}

/**
 * The module that `load` imports. `isSaid` as in `onMissingFile`.
 *
 * @throws {RockFieldError} `ScriptUnavailable`. A later call tries again, in browsers that do not remember a failed import.
 */
export async function lazily<Module>(load: () => Promise<Module>, isSaid = false): Promise<Module> {
  try {
    return await load();
  } catch (cause) {
    tellMissingFile(isSaid);
    throw scriptUnavailable(cause);
  }
}
