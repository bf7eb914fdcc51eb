/** Fields without a worker: what `entries/core.ts` and `core.node.ts` share. */

import { errorInfo, RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import { Headless } from '../generator/headless.ts';
import type { GeneratorOptions, Realm } from '../generator/headless.ts';
import type { FlatRequest, Progress, StageName } from '../generator/protocol.ts';
import { maskRows } from './mask.ts';
import { resolvePainted } from './painted.ts';
import type { PaintedRequest } from './painted.ts';
import { encodeParams, flatRequest } from './request.ts';
import { fieldSession } from './session.ts';
import type { GeneratorModule } from './session.ts';

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
  protected encode(request: PaintedRequest | undefined, maxBytes: number): FlatRequest {
    const { params, mask } = resolvePainted(request);
    return {
      ...flatRequest(params, maxBytes),
      footprint: (request as HeadlessJob | undefined)?.[FOOTPRINT],
      mask: mask && maskRows(mask, maxBytes),
    };
  }

  protected open(module: GeneratorModule) {
    return fieldSession(new module.Generator());
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

export async function openGenerator(realm: Realm<GeneratorModule>, { wasm }: GeneratorOptions = {}): Promise<FieldGenerator> {
  return new HeadlessFields(realm, await realm.load(wasm));
}

/** One field, no cache kept. */
export async function generateOnce(realm: Realm<GeneratorModule>, request?: PaintedRequest, options?: GenerateOptions): Promise<Field> {
  const generator = await openGenerator(realm);
  try {
    return await generator.generate(request, options);
  } finally {
    generator.dispose();
  }
}
