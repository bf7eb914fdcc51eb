/** This global of a worker, as the DOM's types for pages do not know it. */

import type { LoopHost } from './host.ts';
import type { FromWorker, ToWorker } from './protocol.ts';

const scope = globalThis as unknown as {
  postMessage(message: FromWorker, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent) => void) | null;
};

/** The messages of this worker are the host's from now on. */
export function listen<Module, Flat>(
  newHost: (post: (message: FromWorker, transfer?: Transferable[]) => void) => LoopHost<Module, Flat>,
): void {
  const host = newHost((message, transfer = []) => scope.postMessage(message, transfer));
  scope.onmessage = (event: MessageEvent<ToWorker<Flat>>) => host.receive(event.data);
}
