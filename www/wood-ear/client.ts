/** The page's side of the wood ears' generator. */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import { RockFieldError } from '../base/errors.ts';
import { flatColony } from './request.ts';
import type { FlatColony, WoodEarRequest } from './request.ts';
import type { WorkerLike } from '../generator/pool-worker.ts';
import { startWorker } from '../generator/start-worker.ts';
import { WorkerClient } from '../generator/worker-client.ts';
import type { ClientOptions } from '../generator/worker-client.ts';
import type { PackedColony, WoodEarStage } from './session.ts';

export class ColonyClient extends WorkerClient<WoodEarRequest, FlatColony, WoodEarColony, WoodEarStage> {
  /** The last that crossed. */
  #log: WoodEarLog | null = null;

  constructor(options: ClientOptions<WoodEarRequest, WoodEarColony> = {}) {
    super(options, spawnWorker);
  }

  protected override encode(request: WoodEarRequest, maxBytes: number): FlatColony {
    return flatColony(request, maxBytes);
  }

  protected override unpack(packed: unknown): WoodEarColony {
    const colony = packed as PackedColony;
    this.#log = colony.log ?? this.#log;
    if (!this.#log) throw new RockFieldError({ name: 'Internal', message: 'a colony came without its log' });
    return { ...colony, log: this.#log };
  }
}

function spawnWorker(): WorkerLike {
  // This literal form is the one that bundlers recognise.
  return startWorker(() => new Worker(new URL('./wood-ear-worker.js', import.meta.url), { type: 'module' }));
}
