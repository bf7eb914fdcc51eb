/** What is on the screen. At rest, each is followed by the next one that makes a difference. */

/** Fewer pixels than the stage has. */
export const SMALL = 0;
/** All of them, with a sample each. */
export const ROUGH = 1;
/** All that a picture of its level has. */
export const WHOLE = 2;
/** Nothing can follow. */
export const FINAL = 3;
