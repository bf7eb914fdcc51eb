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

/** How long a script may take to arrive before it is given up, ms. All of them are a few kB. */
const SCRIPT_MS = 15_000;
/** Then the page gets so many turns, 100 ms apart, to take what has arrived while it was busy. */
const TURNS = 20;

/**
 * The module that `load` imports. `isSaid` as in `onMissingFile`.
 *
 * @throws {RockFieldError} `ScriptUnavailable`. A later call tries again, in browsers that do not remember a failed import. A
 * script that arrives after it was given up is used by the next call.
 */
export async function lazily<Module>(load: () => Promise<Module>, isSaid = false): Promise<Module> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  try {
    let turns = TURNS;
    const late = new Promise<never>((_, reject) => {
      const turn = () => {
        turns -= 1;
        if (turns < 0) reject('it does not arrive');
        else timer = setTimeout(turn, 100);
      };
      timer = setTimeout(turn, SCRIPT_MS);
    });
    return await Promise.race([load(), late]);
  } catch (cause) {
    tellMissingFile(isSaid);
    throw scriptUnavailable(cause);
  } finally {
    clearTimeout(timer);
  }
}
