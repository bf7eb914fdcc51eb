/** The one error class of the package, and its flat form for the way between worker and page. */

import type { ErrorName } from './error-list.ts';
import type { Words } from './language.ts';

export type { ErrorName };

/**
 * What went wrong, as plain data: `structuredClone` keeps neither the name nor the properties of an Error.
 */
export interface ErrorInfo {
  /** Machine-readable code, stable across versions: one of a closed list. */
  name: ErrorName;
  /** For people, in English. */
  message: string;
  /** The parameter at fault, where there is one. */
  key?: string | undefined;
  /** Index of the layer (of wood ears: of the base) at fault, in input order. */
  layer?: number | undefined;
  value?: unknown;
  min?: number | undefined;
  max?: number | undefined;
  /** The message in each language of the page, of errors that say more than name, value and bounds. */
  words?: Words | undefined;
}

/** Names of the errors of a file that cannot be had, whatever the parameters are. */
export const UNAVAILABLE = /^(Wasm|Worker|Script)Unavailable$/;

export class RockFieldError extends Error {
  override readonly name: ErrorName;
  readonly key: string | undefined;
  readonly layer: number | undefined;
  readonly value: unknown;
  readonly min: number | undefined;
  readonly max: number | undefined;
  readonly words: Words | undefined;

  constructor(info: ErrorInfo, options?: ErrorOptions) {
    super(info.message, options);
    this.name = info.name;
    this.key = info.key;
    this.layer = info.layer;
    this.value = info.value;
    this.min = info.min;
    this.max = info.max;
    this.words = info.words;
  }
}

/** The flat form of anything that was thrown; what has no code of ours is `Internal`. */
export function errorInfo(thrown: unknown): ErrorInfo {
  if (isCoded(thrown)) {
    const { name, message, key, layer, value, min, max, words } = thrown;
    return { name, message, key, layer, value, min, max, words };
  }
  const text = thrown instanceof Error ? `${thrown.name}: ${thrown.message}` : typeof thrown;
  return { name: 'Internal', message: `the generator failed (${text}); please report this with its link` };
}

/** Whether `thrown` names a parameter: ours, or an Error made by the wasm bindings. After one of these nothing has changed. */
export function isCoded(thrown: unknown): thrown is Error & ErrorInfo {
  return thrown instanceof RockFieldError || (thrown instanceof Error && typeof (thrown as Error & ErrorInfo).key === 'string');
}

/** A script that is fetched when it is wanted cannot be had; `cause` is what the browser threw. */
export function scriptUnavailable(cause: unknown): RockFieldError {
  const reason = cause instanceof Error ? cause.message : String(cause);
  return new RockFieldError(
    { name: 'ScriptUnavailable', message: `a script could not be fetched (${reason}); reload the page` },
    { cause },
  );
}

/** What needs a cycle of the element was asked for out of one. */
export function notConnected(): RockFieldError {
  return new RockFieldError({ name: 'NotConnected', message: 'put the element into the document first' });
}

/** Whether the same may succeed at another time: what failed was no parameter, but a file or a worker. */
export function isPassing({ name }: ErrorInfo): boolean {
  return UNAVAILABLE.test(name) || name === 'WorkerLost' || name === 'Internal';
}

export function abortError(message: string): DOMException {
  return new DOMException(message, 'AbortError');
}

export function isAbort(thrown: unknown): boolean {
  return thrown instanceof DOMException && thrown.name === 'AbortError';
}
