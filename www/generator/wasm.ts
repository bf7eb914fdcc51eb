/** Brings the generator's wasm up, and says in words what is wrong when it cannot be had. The glue is given by who imports it. */

import type { InitInput } from '../../pkg/generator.js';
import { RockFieldError } from '../errors.ts';
import type { RawGenerator } from './field-session.ts';

/** What pkg/generator.js exports, as far as it is used. */
export interface GeneratorModule {
  Generator: new () => RawGenerator;
  fresh_seed(): number;
  memory_estimate(params: Float64Array): number;
}

/** A module before its wasm is there. */
export type Glue<Module> = Module & {
  default(options: { module_or_path: InitInput | Promise<InitInput> }): Promise<unknown>;
  /** Behind a flag of the wasm-bindgen CLI: a new instance of the same module. */
  __wbg_reset_state?: () => void;
};

export type GeneratorGlue = Glue<GeneratorModule>;

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
    throw unavailable(`the generator's wasm could not be read: ${text(cause)}`, cause);
  }
  const input = typeof given === 'string' || given instanceof URL ? await fetchWasm(given) : given;
  try {
    await glue.default({ module_or_path: input });
  } catch (cause) {
    throw unavailable(`the generator's wasm could not be started: ${text(cause)}`, cause);
  }
  return glue;
}

/** The bytes, or the response when it can be compiled while it arrives. */
async function fetchWasm(address: URL | string): Promise<BufferSource | Response> {
  const name = String(address).replace(/[?#].*$/, '').split('/').pop();
  let response: Response;
  try {
    response = await fetch(address);
  } catch (cause) {
    throw unavailable(`${name} could not be fetched (${text(cause)}); check the connection and reload the page`, cause);
  }
  if (!response.ok) throw unavailable(`${name} could not be fetched: the server answered ${response.status}`);
  const type = response.headers.get('Content-Type') ?? '';
  if (type.startsWith('application/wasm')) return response;
  // Any other type cannot be compiled while it arrives. Servers answer an unknown path with a page, so look first.
  const bytes = await response.arrayBuffer();
  const magic = new Uint8Array(bytes, 0, Math.min(4, bytes.byteLength));
  if (String.fromCharCode(...magic) === '\0asm') return bytes;
  throw unavailable(`${name} is no wasm file: the server sent ${type || 'something without a type'} instead`);
}

function unavailable(message: string, cause?: unknown): RockFieldError {
  return new RockFieldError({ name: 'WasmUnavailable', message }, { cause });
}

function text(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}
