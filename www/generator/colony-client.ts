/** The page's side of the wood ears' generator. */

import type { WoodEarColony, WoodEarLog } from '../colony.ts';
import { RockFieldError } from '../errors.ts';
import { flatColony } from '../wood-ear-flat.ts';
import type { FlatColony, WoodEarRequest } from '../wood-ear-flat.ts';
import type { WorkerLike } from './pool-worker.ts';
import { startWorker } from './start-worker.ts';
import { WorkerClient } from './worker-client.ts';
import type { ClientOptions } from './worker-client.ts';
import type { PackedColony, WoodEarStage } from './wood-ear-session.ts';

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
