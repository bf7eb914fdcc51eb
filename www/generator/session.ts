/** Drives one `Generator` of the wasm: slices, time per stage, abort, and the buffers as a `Field`. In the worker and in Node. */

import { errorInfo, isCoded, RockFieldError } from '../errors.ts';
import type { Field, FieldLayer, StageTimes } from '../field.ts';
import { STAGES } from './protocol.ts';
import type { FlatRequest, Progress } from './protocol.ts';

/** The class of the same name in pkg/generator.d.ts, as far as it is used. */
export interface RawGenerator {
  start(params: Float64Array, maxBytes: number): void;
  step(): boolean;
  stage(): number;
  progress(): number;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  rock_starts(): Uint32Array;
  vertex_starts(): Uint32Array;
  rock_layer(): Uint8Array;
  layer_sites(k: number): Float32Array;
  layer_cell_starts(k: number): Uint32Array;
  layer_cell_vertices(k: number): Float32Array;
  layer_selected(k: number): Uint32Array;
  /** `[id, radius px, targetSites, sitesSaturated, areaFraction, areaReached, saturated]` */
  layer_summary(k: number): Float64Array;
  /** `[rocks, triangles, coveredFraction, layers]` */
  summary(): Float64Array;
  free(): void;
}

export interface RunOptions {
  signal?: AbortSignal | undefined;
  /** Called between slices. */
  onProgress?: ((progress: Progress) => void) | undefined;
}

/** After this much work the queue is read. A step takes 1–3 ms, on a slow phone 10: a slice stays under 30 ms. */
export const SLICE_MS = 16;

export class Session {
  #generator: RawGenerator;
  #running = false;
  #broken = false;

  constructor(generator: RawGenerator) {
    this.#generator = generator;
  }

  /** The wasm trapped: the instance behind this session, memory included, must not be used again. */
  get broken(): boolean {
    return this.#broken;
  }

  /**
   * One run, from the first stage that is not in the cache. Aborting it keeps the stages it finished.
   *
   * @throws {RockFieldError} for a request that cannot be met (nothing has changed) or, with name `Internal`, after a trap.
   * @throws the signal's reason when it was aborted.
   */
  async run(request: FlatRequest, { signal, onProgress }: RunOptions = {}): Promise<Field> {
    if (this.#broken) throw new RockFieldError({ name: 'Internal', message: 'the generator failed before and was discarded' });
    if (this.#running) throw new RockFieldError({ name: 'Internal', message: 'the session is running already' });
    signal?.throwIfAborted();
    this.#running = true;
    try {
      const begin = performance.now();
      const ms: StageTimes = { sites: 0, cells: 0, selection: 0, shape: 0, mesh: 0, total: 0 };
      this.#guard(() => this.#generator.start(request.params, request.maxBytes));
      while (!this.#guard(() => runSlice(this.#generator, ms))) {
        onProgress?.(this.#guard(() => progressOf(this.#generator)));
        await nextTask();
        signal?.throwIfAborted();
      }
      const field = this.#guard(() => collect(this.#generator, request, ms));
      ms.total = performance.now() - begin;
      return field;
    } finally {
      this.#running = false;
    }
  }

  free(): void {
    // A trapped instance is left to the garbage collector: its memory may be in any state.
    if (!this.#broken) this.#generator.free();
    this.#broken = true;
  }

  /** Everything that reaches into the wasm goes through here: an error without a code of ours is a trap. */
  #guard<T>(call: () => T): T {
    try {
      return call();
    } catch (thrown) {
      if (!isCoded(thrown)) this.#broken = true;
      throw new RockFieldError(errorInfo(thrown), { cause: thrown });
    }
  }
}

/** Steps until the run is finished (true) or the slice is over; adds the time to the stages. */
function runSlice(generator: RawGenerator, ms: StageTimes): boolean {
  const begin = performance.now();
  let before = begin;
  for (;;) {
    const stage = stageOf(generator);
    const done = generator.step();
    const now = performance.now();
    ms[stage] += now - before;
    before = now;
    if (done) return true;
    if (now - begin >= SLICE_MS) return false;
  }
}

function stageOf(generator: RawGenerator): Progress['stage'] {
  return STAGES[generator.stage()] ?? 'mesh';
}

function progressOf(generator: RawGenerator): Progress {
  return { stage: stageOf(generator), fraction: generator.progress() };
}

/** The buffers of a finished run; each is a copy that belongs to JavaScript. */
function collect(generator: RawGenerator, { imageWidth, imageHeight }: FlatRequest, ms: StageTimes): Field {
  const [rocks = 0, triangles = 0, coveredFraction = 0, layerCount = 0] = generator.summary();
  return {
    imageWidth,
    imageHeight,
    layers: Array.from({ length: layerCount }, (_, k) => collectLayer(generator, k)),
    positions: generator.positions(),
    normals: generator.normals(),
    indices: generator.indices(),
    rockStarts: generator.rock_starts(),
    vertexStarts: generator.vertex_starts(),
    rockLayer: generator.rock_layer(),
    stats: { rocks, triangles, coveredFraction, ms },
  };
}

function collectLayer(generator: RawGenerator, k: number): FieldLayer {
  const [id = 0, radius = 0, targetSites = 0, sitesSaturated, areaFraction = 0, areaReached = 0, saturated] = generator.layer_summary(k);
  return {
    id,
    radius,
    targetSites,
    sites: generator.layer_sites(k),
    sitesSaturated: sitesSaturated === 1,
    cellStarts: generator.layer_cell_starts(k),
    cellVertices: generator.layer_cell_vertices(k),
    selected: generator.layer_selected(k),
    areaFraction,
    areaReached,
    saturated: saturated === 1,
  };
}

/** The buffers of a field, each once: a transfer list. */
export function buffersOf(field: Field): ArrayBuffer[] {
  const arrays = [
    field.positions, field.normals, field.indices, field.rockStarts, field.vertexStarts, field.rockLayer,
    ...field.layers.flatMap((layer) => [layer.sites, layer.cellStarts, layer.cellVertices, layer.selected]),
  ];
  return [...new Set(arrays.map((array) => array.buffer as ArrayBuffer))];
}

// Node only: a MessageChannel there keeps the process alive, and setImmediate is cheaper.
declare const setImmediate: ((run: () => void) => void) | undefined;

let channel: MessageChannel | undefined;
/** Whether a message is on its way through the channel. */
let awaited = false;
const waiting: (() => void)[] = [];

/**
 * Lets every message and event that is waiting be handled. `setTimeout` would cost 4 ms each time.
 *
 * Each task resumes one of the runs that wait, in turn, so that the queue is read after every slice however many runs there are.
 */
function nextTask(): Promise<void> {
  return new Promise((resolve) => {
    if (typeof setImmediate === 'function') {
      setImmediate(resolve);
      return;
    }
    waiting.push(resolve);
    wakeNext();
  });
}

function wakeNext(): void {
  if (awaited || waiting.length === 0) return;
  if (!channel) {
    channel = new MessageChannel();
    channel.port1.onmessage = () => {
      awaited = false;
      waiting.shift()?.();
      // Behind the slice that was resumed: what came in during it is read before the next.
      queueMicrotask(wakeNext);
    };
  }
  awaited = true;
  channel.port2.postMessage(null);
}
