/** Scripts that are fetched when they are wanted. On a page that was open during a deployment, the server may not have them any more. */

import { scriptUnavailable } from './errors.ts';

let isMissing = false;
let listener: (() => void) | undefined;

/** `hear` is called whenever a file of this build could not be had, and at once if that has happened already. */
export function onMissingFile(hear: () => void): void {
  listener = hear;
  if (isMissing) hear();
}

/** To be called by whoever could not fetch a file of this build. */
export function tellMissingFile(): void {
  isMissing = true;
  listener?.();
}

/**
 * The module that `load` imports.
 *
 * @throws {RockFieldError} `ScriptUnavailable`. A later call tries again, in browsers that do not remember a failed import.
 */
export async function lazily<Module>(load: () => Promise<Module>): Promise<Module> {
  try {
    return await load();
  } catch (cause) {
    tellMissingFile();
    throw scriptUnavailable(cause);
  }
}
