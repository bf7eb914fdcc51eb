/** Stills of a page are made one after the other: each holds much of the device's memory, and all of its time. */

let last: Promise<unknown> = Promise.resolve();
/** How many are waited for by somebody. */
let wanted = 0;

/** Makes a still that somebody waits for, when it is its turn: before those that merely refine what is on a screen. */
export function inTurn<T>(make: () => Promise<T>): Promise<T> {
  wanted += 1;
  return queued(make).finally(() => {
    wanted -= 1;
  });
}

/** Makes one that nobody waits for. It ends early, and has another turn, when `isWanted`. */
export function inLaterTurn<T>(make: (isWanted: () => boolean) => Promise<T>): Promise<T> {
  return queued(() => make(() => wanted > 0));
}

function queued<T>(make: () => Promise<T>): Promise<T> {
  const made = last.then(make);
  last = made.catch(() => undefined);
  return made;
}
