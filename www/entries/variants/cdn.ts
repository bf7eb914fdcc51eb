/**
 * What makes of `entries/rock-field.ts` the classic script `cdn.js`: the bundler puts `scriptUrl` in the place of `import.meta.url`, which a
 * classic script does not have (scripts/build/web.mjs). The module build knows nothing of it.
 */

import { RockFieldError } from '../../base/errors.ts';

const MESSAGE =
  'this script cannot find the files beside it, because it was evaluated or written into the page; include it by its address, <script src="…/cdn.js">, or use rock-field/inline, which has everything in it';

/** The address of this script, beside which the worker and the wasm lie. Where it has none, to use it throws an error that says so. */
export const scriptUrl: string | { toString: () => string } = ownAddress() ?? {
  toString() {
    throw new RockFieldError({ name: 'WorkerUnavailable', message: MESSAGE });
  },
};

/** To be called while the script runs for the first time. Null without an address; also on a server, which has no use for one. */
function ownAddress(): string | null {
  const element = globalThis.document?.currentScript as HTMLScriptElement | null | undefined;
  // The first frame is this function: `at name (address:1:2)`, or `name@address:1:2`. A script that is evaluated has others' addresses in it.
  const frame = new Error().stack?.split('\n').find((line) => /@|^\s*at /.test(line)) ?? '';
  const [, address] =
    /^(?!.*(?:\(eval at | > (?:eval|Function))).*?(?<!blob:)((?:https?|file|[a-z]+-extension):\/\/.+?):\d+:\d+\)?$/.exec(frame) ?? [];
  const isInPage = element ? !element.src : address === globalThis.location?.href.replace(/#.*/s, '');
  return address && !isInPage ? element?.src || address : null;
}
