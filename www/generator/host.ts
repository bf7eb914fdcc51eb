/**
 * The worker's side of the pool, without the worker: one wasm, a run loop with its own session per client.
 *
 * The loops take turns by slices. A trap in one spoils the instance for all; the page discards the worker when it is told, and
 * with it whatever the others said after that.
 */

import { errorInfo } from '../errors.ts';
import { RunLoop } from './loop.ts';
import type { FromWorker, ToWorker } from './protocol.ts';
import type { GeneratorModule } from './wasm.ts';

type Post = (message: FromWorker, transfer?: Transferable[]) => void;

export class LoopHost {
  #post: Post;
  #module: Promise<GeneratorModule>;
  #loops = new Map<number, RunLoop>();

  constructor(load: () => Promise<GeneratorModule>, post: Post) {
    this.#post = post;
    this.#module = load();
    this.#module.then(
      () => this.#post({ type: 'ready' }),
      (error: unknown) => this.#post({ type: 'failed', error: errorInfo(error) }),
    );
  }

  receive(message: ToWorker): void {
    switch (message.type) {
      case 'ping':
        this.#post({ type: 'pong' });
        break;
      case 'close':
        this.#loops.get(message.client)?.close();
        this.#loops.delete(message.client);
        break;
      default:
        this.#loopOf(message.client).receive(message);
    }
  }

  #loopOf(client: number): RunLoop {
    let loop = this.#loops.get(client);
    if (!loop) {
      loop = new RunLoop(this.#module, (message, transfer) => this.#post({ ...message, client }, transfer));
      this.#loops.set(client, loop);
    }
    return loop;
  }
}
