/** The worker of the build with everything in it: its script is a text of this one. Put by scripts/inline.mjs in the place of the worker's address. */

import script from 'inlined:worker';

let address: string | undefined;

/** One for all workers of the page. Needs `worker-src blob:`, where the page has a Content-Security-Policy. */
export function workerAddress(): string {
  address ??= URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  return address;
}
