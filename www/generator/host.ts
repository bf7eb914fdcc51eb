/**
 * The worker's side of the pool, without the worker: one wasm, a run loop with its own session per client.
 *
 * The loops take turns by slices. A trap in one spoils the instance for all; the page discards the worker when it is told, and
 * with it whatever the others said after that.
 */

import { errorInfo } from '../base/errors.ts';
import type { RunLoop } from './loop.ts';
import type { FromLoop, FromWorker, ToWorker } from './protocol.ts';

type Post = (message: FromWorker, transfer?: Transferable[]) => void;

type AnyLoop<Flat> = Pick<RunLoop<never, Flat, never, never>, 'receive' | 'close'>;

export class LoopHost<Module, Flat> {
  #post: Post;
  #module: Promise<Module>;
  #newLoop: (module: Promise<Module>, post: (message: FromLoop, transfer?: Transferable[]) => void) => AnyLoop<Flat>;
  #loops = new Map<number, AnyLoop<Flat>>();
  #heard = 0;

  constructor(
    load: () => Promise<Module>,
    newLoop: (module: Promise<Module>, post: (message: FromLoop, transfer?: Transferable[]) => void) => AnyLoop<Flat>,
    post: Post,
  ) {
    this.#newLoop = newLoop;
    this.#post = post;
    this.#post({ type: 'started' });
    this.#module = load();
    this.#module.then(
      () => this.#post({ type: 'ready' }),
      (error: unknown) => this.#post({ type: 'failed', error: errorInfo(error) }),
    );
  }

  receive(message: ToWorker<Flat>): void {
    this.#heard += 1;
    switch (message.type) {
      case 'ping':
        this.#post({ type: 'pong', heard: this.#heard });
        break;
      case 'close':
        this.#loops.get(message.client)?.close();
        this.#loops.delete(message.client);
        break;
      default:
        this.#loopOf(message.client).receive(message);
    }
  }

  #loopOf(client: number): AnyLoop<Flat> {
    let loop = this.#loops.get(client);
    if (!loop) {
      loop = this.#newLoop(this.#module, (message, transfer) => this.#post({ ...message, client }, transfer));
      this.#loops.set(client, loop);
    }
    return loop;
  }
}
