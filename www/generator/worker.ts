/** The module worker: wires the run loops to the messages of this worker and to the wasm that lies beside it. */

import * as glue from '../../pkg/generator.js';
import { LoopHost } from './host.ts';
import type { FromWorker, ToWorker } from './protocol.ts';
import { loadGenerator } from './wasm.ts';

/** This global, as the DOM's types for pages do not know it. */
const scope = globalThis as unknown as {
  postMessage(message: FromWorker, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
};

const host = new LoopHost(
  // Bundlers copy the file when they see it in this literal form.
  () => loadGenerator(glue, new URL('./generator_bg.wasm', import.meta.url)),
  (message, transfer = []) => scope.postMessage(message, transfer),
);

scope.onmessage = (event) => host.receive(event.data);
