/** Why a file brings no scene back, before it is put into words. */

/** `foreign`: it was not made here. `broken`: it says that it was, and cannot be read. */
export type Reason = 'foreign' | 'broken';

export class Refused extends Error {
  readonly reason: Reason;

  constructor(reason: Reason) {
    super(reason);
    this.reason = reason;
  }
}
