/** Why a file brings no scene back, before it is put into words. */

/** `foreign`: nothing in it says that it was made here. `broken`: it cannot be read as what it says that it is. */
export type Reason = 'foreign' | 'broken';

export class Refused extends Error {
  readonly reason: Reason;

  constructor(reason: Reason, options?: ErrorOptions) {
    super(reason, options);
    this.reason = reason;
  }
}
