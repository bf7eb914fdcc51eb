/** Colonies without a worker: what `entries/core.ts` and `core.node.ts` share. */

import type { WoodEarColony } from '../data/colony.ts';
import { flatColony } from './request.ts';
import type { FlatColony, WoodEarRequest } from './request.ts';
import { Headless } from '../generator/headless.ts';
import type { GeneratorOptions, Realm } from '../generator/headless.ts';
import type { Progress } from '../generator/protocol.ts';
import { woodEarSession } from './session.ts';
import type { WoodEarModule, WoodEarStage } from './session.ts';

export interface WoodEarOptions {
  /** Aborting rejects with the signal's reason; finished stages are kept. */
  signal?: AbortSignal | undefined;
  /** Called every 16 ms or so. */
  onProgress?: ((progress: Progress<WoodEarStage>) => void) | undefined;
  /** Given the colony before its collisions, once, where the run goes on after it. */
  onPreview?: ((colony: WoodEarColony) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

/** Keeps the stages of its last run, so that the next one re-runs only from the first stage that changed. */
export interface WoodEarGenerator {
  /**
   * The colony of a request. Calls run one after the other; every one is answered.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  generate(request?: WoodEarRequest, options?: WoodEarOptions): Promise<WoodEarColony>;
  /** A fresh random seed. */
  freshSeed(): number;
  /** Frees the cache; calls after it reject. */
  dispose(): void;
}

class HeadlessWoodEars
  extends Headless<WoodEarModule, WoodEarRequest, FlatColony, WoodEarColony, WoodEarStage>
  implements WoodEarGenerator
{
  protected encode(request: WoodEarRequest | undefined, maxBytes: number): FlatColony {
    return flatColony(request, maxBytes);
  }

  protected open(module: WoodEarModule) {
    return woodEarSession(new module.WoodEarGenerator());
  }
}

export async function openWoodEars(realm: Realm<WoodEarModule>, { wasm }: GeneratorOptions = {}): Promise<WoodEarGenerator> {
  return new HeadlessWoodEars(realm, await realm.load(wasm));
}

/** One colony, no cache kept. */
export async function growOnce(
  realm: Realm<WoodEarModule>,
  request?: WoodEarRequest,
  { wasm, ...options }: WoodEarOptions & GeneratorOptions = {},
): Promise<WoodEarColony> {
  const generator = await openWoodEars(realm, { wasm });
  try {
    return await generator.generate(request, options);
  } finally {
    generator.dispose();
  }
}
