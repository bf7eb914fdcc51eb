/** Fields without a worker: what `entries/core.ts` and `core.node.ts` share. */

import { errorInfo, RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import { Headless } from '../generator/headless.ts';
import type { GeneratorOptions, Realm, Source } from '../generator/headless.ts';
import type { WasmSource } from '../generator/wasm.ts';
import type { FlatRequest, Progress, StageName } from '../generator/protocol.ts';
import { maskRows } from './mask.ts';
import { resolvePainted } from './painted.ts';
import type { PaintedRequest } from './painted.ts';
import { encodeParams, flatRequest } from './request.ts';
import { sessionOfEither } from './full-session.ts';
import type { FullModule } from './full-session.ts';
import { needsFull } from './needs-full.ts';
import type { GeneratorModule } from './session.ts';

export interface FieldGeneratorOptions extends GeneratorOptions {
  /** The wasm `generator-full_bg.wasm`, which is asked for with the first mask or stroke. Default: the file beside this script. */
  fullWasm?: WasmSource | Promise<WasmSource> | undefined;
}

/** The two artefacts. */
export interface FieldRealms {
  plain: Realm<GeneratorModule>;
  full: Realm<FullModule>;
}

export interface GenerateOptions {
  /** Aborting rejects with the signal's reason; finished stages are kept. */
  signal?: AbortSignal | undefined;
  /** Called every 16 ms or so. */
  onProgress?: ((progress: Progress) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

/** Keeps the stages of its last run, so that the next one re-runs only from the first stage that changed. */
export interface FieldGenerator {
  /**
   * The field of a request. Calls run one after the other; every one is answered.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  generate(request?: PaintedRequest, options?: GenerateOptions): Promise<Field>;
  /** A fresh random seed. */
  freshSeed(): number;
  /** Bytes a request is expected to need at its peak. Where little ground is shared by layers of large rocks, only the run itself can tell, and says so in time. */
  memoryEstimate(request?: PaintedRequest): number;
  /** Frees the cache; calls after it reject. */
  dispose(): void;
}

/** Where no rock may grow, as in a `FieldJob`. A symbol, so that no request from outside has one. */
export const FOOTPRINT = Symbol('footprint');

/** What another generator asks for, whose things lie among the rocks. */
export type HeadlessJob = PaintedRequest & { [FOOTPRINT]?: Float64Array | undefined };

class HeadlessFields extends Headless<GeneratorModule, PaintedRequest, FlatRequest, Field, StageName> implements FieldGenerator {
  #full: Source<GeneratorModule>;

  constructor(realm: Realm<GeneratorModule>, module: GeneratorModule, full: Source<GeneratorModule>) {
    super(realm, module);
    this.#full = full;
  }

  protected encode(request: PaintedRequest | undefined, maxBytes: number): FlatRequest {
    return flatOf(request, maxBytes);
  }

  protected open(module: GeneratorModule) {
    return sessionOfEither(new module.Generator());
  }

  protected override another(request: FlatRequest): Source<GeneratorModule> | undefined {
    return needsFull(request) ? this.#full : undefined;
  }

  memoryEstimate(request: PaintedRequest = {}): number {
    const flat = encodeParams(resolvePainted(request).params);
    const module = this.sound();
    try {
      return module.memory_estimate(flat);
    } catch (thrown) {
      throw new RockFieldError(errorInfo(thrown), { cause: thrown });
    }
  }
}

function flatOf(request: PaintedRequest | undefined, maxBytes: number): FlatRequest {
  const { params, mask } = resolvePainted(request);
  return {
    ...flatRequest(params, maxBytes),
    footprint: (request as HeadlessJob | undefined)?.[FOOTPRINT],
    mask: mask && maskRows(mask, maxBytes),
  };
}

export async function openGenerator({ plain, full }: FieldRealms, options: FieldGeneratorOptions = {}): Promise<FieldGenerator> {
  return new HeadlessFields(plain, await plain.load(options.wasm), { realm: full, wasm: options.fullWasm });
}

/** One field, no cache kept. */
export async function generateOnce({ plain, full }: FieldRealms, request?: PaintedRequest, options?: GenerateOptions): Promise<Field> {
  const realm: Realm<GeneratorModule> = needsFull(flatOf(request, Infinity)) ? full : plain;
  const generator = new HeadlessFields(realm, await realm.load(), { realm: full });
  try {
    return await generator.generate(request, options);
  } finally {
    generator.dispose();
  }
}
