/** A generator without a worker, for Node, workers and bundlers, whatever it generates. */

import { RockFieldError, scriptUnavailable } from '../base/errors.ts';
import { checkRun } from './run-checks.ts';
import type { HeadlessOptions } from './run-checks.ts';
import type { RunOptions } from './session.ts';
import { loadGenerator } from './wasm.ts';
import type { Glue, WasmSource } from './wasm.ts';

export interface GeneratorOptions {
  /** The wasm: an address, bytes, a response or a compiled module. Default: the file beside this script. */
  wasm?: WasmSource | Promise<WasmSource> | undefined;
}

/** The wasm of a realm: one instance, which all generators share, and which is replaced after a trap. */
export class Realm<Module> {
  #glue: Glue<Module> | undefined;
  #loadGlue: () => Glue<Module> | Promise<Glue<Module>>;
  #source: () => WasmSource | Promise<WasmSource>;
  #module: Promise<Module> | undefined;
  #instance = 0;
  #trapped = false;

  /** @param glue the module, or what imports it when it is first needed. */
  constructor(glue: Glue<Module> | (() => Promise<Glue<Module>>), defaultSource: () => WasmSource | Promise<WasmSource>) {
    this.#loadGlue = typeof glue === 'function' ? (glue as () => Promise<Glue<Module>>) : () => glue;
    this.#source = defaultSource;
  }

  /** Only the first source counts: there is one instance. */
  load(source?: WasmSource | Promise<WasmSource>): Promise<Module> {
    this.#module ??= this.#load(source).catch((error: unknown) => {
      this.#module = undefined;
      throw error;
    });
    return this.#module;
  }

  async #load(source: WasmSource | Promise<WasmSource> | undefined): Promise<Module> {
    try {
      this.#glue = await this.#loadGlue();
    } catch (cause) {
      throw scriptUnavailable(cause);
    }
    return loadGenerator<Module>(this.#glue, source ?? this.#source());
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
    if (!this.#glue?.__wbg_reset_state) {
      throw new RockFieldError({
        name: 'Internal',
        message: 'the generator failed before and cannot be started again here; reload the page or restart the process',
      });
    }
    this.#glue.__wbg_reset_state();
    this.#trapped = false;
    this.#instance += 1;
    return this.#instance;
  }
}

/** A realm, and where its wasm comes from if it is not there yet. */
export interface Source<Module> {
  realm: Realm<Module>;
  wasm?: WasmSource | Promise<WasmSource> | undefined;
}

/** A session, as far as it is used here. */
interface Runs<Flat, Result, Stage extends string> {
  readonly broken: boolean;
  run(request: Flat, options: RunOptions<Result, Stage>): Promise<Result>;
  free(): void;
}

/** What every generator without a worker does, whatever it generates. */
export abstract class Headless<Module extends { fresh_seed(): number }, Request, Flat, Result, Stage extends string> {
  /** Those of the wasm that is used. */
  #realm: Realm<Module>;
  #module: Module;
  #session: Runs<Flat, Result, Stage> | undefined;
  #instance = -1;
  /** Settles when the call before is answered. */
  #last: Promise<unknown> = Promise.resolve();
  #disposed = false;

  constructor(realm: Realm<Module>, module: Module) {
    this.#realm = realm;
    this.#module = module;
  }

  /** Copies all of the request. */
  protected abstract encode(request: Request | undefined, maxBytes: number): Flat;
  protected abstract open(module: Module): Runs<Flat, Result, Stage>;

  /** The wasm that alone can do this request; undefined where any can. It then does all that follow. */
  protected another(_request: Flat): Source<Module> | undefined {
    return undefined;
  }

  async generate(request?: Request, options: HeadlessOptions<Result, Stage> = {}): Promise<Result> {
    const { signal, onProgress, onPreview, maxBytes } = checkRun(options, 'options');
    // Read now: what the caller does to the object afterwards is no part of the request.
    const flat = this.encode(request, maxBytes);
    signal?.throwIfAborted();
    const run = this.#last.then(async () => this.#runIn(await this.#openFor(flat, signal), flat, { signal, onProgress, onPreview }));
    this.#last = run.catch(() => undefined);
    return run;
  }

  freshSeed(): number {
    return this.sound().fresh_seed();
  }

  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    // A run under way keeps its memory until it is answered.
    void this.#last.then(() => this.#free());
  }

  /** The module, with an instance that did not trap. */
  protected sound(): Module {
    this.#realm.soundInstance();
    return this.#module;
  }

  async #runIn(session: Runs<Flat, Result, Stage>, request: Flat, options: RunOptions<Result, Stage>): Promise<Result> {
    const instance = this.#instance;
    try {
      return await session.run(request, options);
    } finally {
      if (session.broken) this.#realm.trap(instance);
    }
  }

  /** The session of the wasm that can do the request. Until another one is there, everything stays as it is. */
  async #openFor(flat: Flat, signal: AbortSignal | undefined): Promise<Runs<Flat, Result, Stage>> {
    const { realm, wasm } = this.another(flat) ?? { realm: this.#realm };
    if (realm !== this.#realm) {
      const module = await unlessAborted(realm.load(wasm), signal);
      this.#free();
      this.#session = undefined;
      [this.#realm, this.#module] = [realm, module];
    }
    return this.#open();
  }

  #free(): void {
    if (this.#realm.isSound(this.#instance)) this.#session?.free();
  }

  /** The session, a new one after a trap: of this generator, or of another in the same instance. */
  #open(): Runs<Flat, Result, Stage> {
    if (this.#disposed) throw new RockFieldError({ name: 'Internal', message: 'the generator was disposed of' });
    const instance = this.#realm.soundInstance();
    if (!this.#session || instance !== this.#instance) {
      this.#session = this.open(this.#module);
      this.#instance = instance;
    }
    return this.#session;
  }
}

/** Rejects with the signal's reason as soon as it is aborted. */
function unlessAborted<T>(promise: Promise<T>, signal: AbortSignal | undefined): Promise<T> {
  return new Promise((resolve, reject) => {
    signal?.addEventListener('abort', () => reject(signal.reason), { once: true });
    promise.then(resolve, reject);
  });
}
