/** Generators without a worker, for Node, workers and bundlers: what `core.ts` and `core.node.ts` share. */

import { errorInfo, RockFieldError } from '../errors.ts';
import type { Field } from '../field.ts';
import { encodeParams, flatRequest, resolveParams } from '../params-flat.ts';
import type { FieldRequest } from '../params-flat.ts';
import { defaultMaxBytes } from './budget.ts';
import type { FlatRequest, Progress } from './protocol.ts';
import { Session } from './session.ts';
import type { RunOptions } from './session.ts';
import { loadGenerator } from './wasm.ts';
import type { GeneratorGlue, GeneratorModule, WasmSource } from './wasm.ts';

export interface GenerateOptions {
  /** Aborting rejects with the signal's reason; finished stages are kept. */
  signal?: AbortSignal | undefined;
  /** Called every 16 ms or so. */
  onProgress?: ((progress: Progress) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

export interface GeneratorOptions {
  /** The wasm: an address, bytes, a response or a compiled module. Default: the file beside this script. */
  wasm?: WasmSource | Promise<WasmSource> | undefined;
}

/** Keeps the stages of its last run, so that the next one re-runs only from the first stage that changed. */
export interface FieldGenerator {
  /**
   * The field of a request. Calls run one after the other; every one is answered.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  generate(request?: FieldRequest, options?: GenerateOptions): Promise<Field>;
  /** A fresh random seed. */
  freshSeed(): number;
  /** Bytes a request would need at its peak. */
  memoryEstimate(request?: FieldRequest): number;
  /** Frees the cache; calls after it reject. */
  dispose(): void;
}

/** The wasm of a realm: one instance, which all generators share, and which is replaced after a trap. */
export class Realm {
  #glue: GeneratorGlue;
  #source: () => WasmSource | Promise<WasmSource>;
  #module: Promise<GeneratorModule> | undefined;
  #instance = 0;
  #trapped = false;

  constructor(glue: GeneratorGlue, defaultSource: () => WasmSource | Promise<WasmSource>) {
    this.#glue = glue;
    this.#source = defaultSource;
  }

  /** Only the first source counts: there is one instance. */
  load(source?: WasmSource | Promise<WasmSource>): Promise<GeneratorModule> {
    this.#module ??= loadGenerator(this.#glue, source ?? this.#source()).catch((error: unknown) => {
      this.#module = undefined;
      throw error;
    });
    return this.#module;
  }

  /** Instance number `instance` trapped: nobody may call into it any more. */
  trap(instance: number): void {
    if (instance === this.#instance) this.#trapped = true;
  }

  /** Whether objects of instance number `instance` may still be used. */
  isSound(instance: number): boolean {
    return instance === this.#instance && !this.#trapped;
  }

  /** The number of a sound instance: the present one, or a new one after a trap. */
  soundInstance(): number {
    if (!this.#trapped) return this.#instance;
    if (!this.#glue.__wbg_reset_state) {
      throw new RockFieldError({ name: 'Internal', message: 'the generator failed before and cannot be started again here; reload the page or restart the process' });
    }
    this.#glue.__wbg_reset_state();
    this.#trapped = false;
    this.#instance += 1;
    return this.#instance;
  }
}

export async function openGenerator(realm: Realm, { wasm }: GeneratorOptions = {}): Promise<FieldGenerator> {
  return new HeadlessGenerator(realm, await realm.load(wasm));
}

/** One field, no cache kept. */
export async function generateOnce(realm: Realm, request?: FieldRequest, options?: GenerateOptions): Promise<Field> {
  const generator = await openGenerator(realm);
  try {
    return await generator.generate(request, options);
  } finally {
    generator.dispose();
  }
}

class HeadlessGenerator implements FieldGenerator {
  #realm: Realm;
  #module: GeneratorModule;
  #session: Session | undefined;
  #instance = -1;
  /** Settles when the call before is answered. */
  #last: Promise<unknown> = Promise.resolve();
  #disposed = false;

  constructor(realm: Realm, module: GeneratorModule) {
    this.#realm = realm;
    this.#module = module;
  }

  async generate(request: FieldRequest = {}, options: GenerateOptions = {}): Promise<Field> {
    const { signal, onProgress, maxBytes = defaultMaxBytes() } = options;
    // Read now: what the caller does to the object afterwards is no part of the request.
    const flat = flatRequest(resolveParams(request), maxBytes);
    signal?.throwIfAborted();
    const run = this.#last.then(() => this.#runIn(this.#open(), flat, { signal, onProgress }));
    this.#last = run.catch(() => undefined);
    return run;
  }

  freshSeed(): number {
    this.#realm.soundInstance();
    return this.#module.fresh_seed();
  }

  memoryEstimate(request: FieldRequest = {}): number {
    const flat = encodeParams(resolveParams(request));
    this.#realm.soundInstance();
    try {
      return this.#module.memory_estimate(flat);
    } catch (thrown) {
      throw new RockFieldError(errorInfo(thrown), { cause: thrown });
    }
  }

  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    // A run under way keeps its memory until it is answered.
    void this.#last.then(() => {
      if (this.#realm.isSound(this.#instance)) this.#session?.free();
    });
  }

  async #runIn(session: Session, request: FlatRequest, options: RunOptions): Promise<Field> {
    const instance = this.#instance;
    try {
      return await session.run(request, options);
    } finally {
      if (session.broken) this.#realm.trap(instance);
    }
  }

  /** The session, a new one after a trap: of this generator, or of another in the same instance. */
  #open(): Session {
    if (this.#disposed) throw new RockFieldError({ name: 'Internal', message: 'the generator was disposed of' });
    const instance = this.#realm.soundInstance();
    if (!this.#session || instance !== this.#instance) {
      this.#session = new Session(new this.#module.Generator());
      this.#instance = instance;
    }
    return this.#session;
  }
}
