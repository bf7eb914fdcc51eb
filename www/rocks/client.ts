/** The page's side of the rocks' generator. */

import type { Field } from '../data/field.ts';
import { flatRequest } from './request.ts';
import type { Params } from './params.ts';
import type { FlatRequest, StageName } from '../generator/protocol.ts';
import { startWorker } from '../generator/start-worker.ts';
import { WorkerClient } from '../generator/worker-client.ts';
import type { ClientOptions } from '../generator/worker-client.ts';
import type { WorkerLike } from '../generator/pool-worker.ts';
import { needsFull } from './needs-full.ts';

/** Parameters, perhaps with what stands among the rocks. */
export type FieldJob = Params & {
  /** Where no rock may grow: six numbers for each triangle, px. */
  footprint?: Float64Array;
};

export class GeneratorClient extends WorkerClient<FieldJob, FlatRequest, Field, StageName> {
  readonly #mask: () => FlatRequest['mask'];

  /** @param mask gives the mask of the runs to come. */
  constructor(options: ClientOptions<FieldJob, Field> = {}, mask: () => FlatRequest['mask'] = () => undefined) {
    super(options, spawnWorker);
    this.#mask = mask;
  }

  protected override encode({ footprint, ...params }: FieldJob, maxBytes: number): FlatRequest {
    return { ...flatRequest(params, maxBytes), footprint, mask: this.#mask() };
  }

  protected override another(request: FlatRequest): (() => WorkerLike) | undefined {
    return needsFull(request) ? spawnFullWorker : undefined;
  }
}

function spawnWorker(): WorkerLike {
  // This literal form is the one that bundlers recognise.
  return startWorker(() => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
}

function spawnFullWorker(): WorkerLike {
  return startWorker(() => new Worker(new URL('./full-worker.js', import.meta.url), { type: 'module' }));
}
