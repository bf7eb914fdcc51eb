/** Brings the generator's wasm up. The glue is given by the module that imports it. */

import type { InitInput } from '../../pkg/generator.js';
import { started, startWasmFile, unavailable } from '../base/wasm-file.ts';

/** A module before its wasm is there. */
export type Glue<Module> = Module & {
  default(options: { module_or_path: InitInput | Promise<InitInput> }): Promise<unknown>;
  /** Behind a flag of the wasm-bindgen CLI: a new instance of the same module. */
  __wbg_reset_state?: () => void;
};

/** Where the wasm comes from: an address, bytes, a response, or a compiled module. */
export type WasmSource = InitInput;

/**
 * Instantiates the wasm; done once per glue, which holds one instance.
 *
 * @throws {RockFieldError} `WasmUnavailable`; the next call tries again.
 */
export async function loadGenerator<Module>(glue: Glue<Module>, source: WasmSource | Promise<WasmSource>): Promise<Module> {
  let given: WasmSource;
  try {
    given = await source;
  } catch (cause) {
    throw unavailable(`the generator's wasm could not be read: ${cause instanceof Error ? cause.message : String(cause)}`, cause);
  }
  const start = (input: InitInput) => glue.default({ module_or_path: input });
  if (typeof given === 'string' || given instanceof URL) await startWasmFile(given, start);
  else await started("the generator's wasm", given, start);
  return glue;
}
