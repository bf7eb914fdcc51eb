/** Starts every worker of the package, wherever the page stands. */

import { lazily } from '../base/lazy.ts';
import type { WorkerLike } from './pool-worker.ts';

/** The part of `trustedTypes` that is used; TypeScript's DOM library has none of it. */
interface TrustedTypes {
  createPolicy(name: string, rules: { createScriptURL(address: string): string }): { createScriptURL(address: string): string };
}

let policy: ReturnType<TrustedTypes['createPolicy']> | undefined;
/** The page allows other policies alone. That does not mean that it requires any. */
let isPolicyRefused = false;

/**
 * The worker that `spawn` makes by nothing but the literal `new Worker(…)` that bundlers recognise. They put the worker's real address into
 * it, so the address is taken from the call itself: for the length of the call `Worker` is a function that starts
 * - the address through the policy `rock-field`, since pages may require Trusted Types;
 * - an address of another origin from a script of the page's own that imports it, since browsers refuse to start it directly. A page
 *   in `<iframe sandbox>` has no origin: there every address is another's.
 *
 * @throws an Error saying why the browser starts no worker.
 */
export function startWorker(spawn: () => Worker): WorkerLike {
  const Native = globalThis.Worker;
  let script = '';
  // A function that returns an object can be called with `new`.
  function Trusted(address: URL | string, options?: WorkerOptions): Worker {
    const { href, origin } = new URL(address);
    script = href;
    if (origin === globalThis.origin) return new Native(trusted(href), options);
    const blob = URL.createObjectURL(new Blob([importing(href)], { type: 'text/javascript' }));
    try {
      return new Native(trusted(blob));
    } finally {
      // The worker has looked it up by now.
      URL.revokeObjectURL(blob);
    }
  }
  globalThis.Worker = Trusted as unknown as typeof Worker;
  try {
    return Object.assign(spawn(), {
      probe: async (heard: () => void) => (await lazily(() => import('./probe.ts'))).probeScript(script, heard),
    });
  } catch (thrown) {
    throw isPolicyRefused
      ? new Error("the page's Content-Security-Policy must allow the policy: trusted-types rock-field", { cause: thrown })
      : thrown;
  } finally {
    globalThis.Worker = Native;
  }
}

/**
 * A script that imports `address` and then hands over the messages that came meanwhile. It is a classic one: Chromium starts no module
 * from a blob in a page without an origin, WebKit none under `Cross-Origin-Embedder-Policy`.
 */
function importing(address: string): string {
  return `const early = [];
onmessage = (event) => early.push(event);
import(${JSON.stringify(address)}).then(() => early.forEach((event) => onmessage(event)), (error) => setTimeout(() => { throw error; }));`;
}

function trusted(address: string): string {
  try {
    policy ??= (globalThis as { trustedTypes?: TrustedTypes }).trustedTypes?.createPolicy('rock-field', {
      createScriptURL: (given) => given,
    });
  } catch {
    isPolicyRefused = true;
  }
  return policy ? policy.createScriptURL(address) : address;
}
