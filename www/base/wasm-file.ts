/** Fetches and starts a wasm file, says in words what is wrong with it, how much of it has arrived, and when no more does. */

import { RockFieldError } from './errors.ts';

/** A connection that brings no byte for so long is dead; a slow one always brings some. */
export const STALL_MS = 10_000;

/** A file that is on its way already. */
interface Underway {
  response: Promise<Response>;
  /** Ends the request. */
  stop: AbortController;
  /** Called with the number of bytes so far. */
  heard?: (bytes: number) => void;
}

function begun(address: URL | string): Underway {
  const stop = new AbortController();
  return { response: fetch(address, { signal: stop.signal }), stop };
}

/**
 * Fetches the file and hands it to `start`, as the response where it can be compiled while it arrives.
 *
 * @param underway the request, where it was made before this code was loaded.
 * @throws {RockFieldError} `WasmUnavailable`, with the engine's own error as `cause`.
 */
export async function startWasmFile<T>(
  address: URL | string,
  start: (source: Response | ArrayBuffer) => Promise<T>,
  underway: Underway = begun(address),
): Promise<T> {
  const { stop, heard } = underway;
  const name =
    String(address)
      .replace(/[?#].*$/, '')
      .split('/')
      .pop() ?? '';
  let timer: ReturnType<typeof setTimeout> | undefined;
  let bytes = 0;
  /** The connection broke or fell silent: whatever fails then is not the file's fault. */
  let broken = false;
  const alive = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => stop.abort(), STALL_MS);
  };
  const counted = (body: ReadableStream<Uint8Array<ArrayBuffer>>): ReadableStream<Uint8Array<ArrayBuffer>> => {
    const reader = body.getReader();
    return new ReadableStream({
      async pull(controller) {
        try {
          const { done, value } = await reader.read();
          if (done) return controller.close();
          alive();
          bytes += value.byteLength;
          heard?.(bytes);
          controller.enqueue(value);
        } catch (error) {
          broken = true;
          controller.error(error);
        }
      },
      cancel: (reason) => reader.cancel(reason),
    });
  };

  alive();
  try {
    const response = await underway.response.catch((error: unknown) => {
      broken = true;
      throw error;
    });
    if (!response.ok) throw unavailable(`${name} could not be fetched: the server answered ${response.status}`);
    const type = response.headers.get('Content-Type') ?? '';
    const whole = new Response(response.body && counted(response.body), { headers: { 'Content-Type': type } });
    // Any other type cannot be compiled while it arrives. Servers answer an unknown path with a page, so look first.
    if (type.startsWith('application/wasm') && !(heard && isNarrow())) return await started(name, whole, start);
    const file = await whole.arrayBuffer();
    const magic = new Uint8Array(file, 0, Math.min(4, file.byteLength));
    if (String.fromCharCode(...magic) !== '\0asm')
      throw unavailable(`${name} is not a wasm file: the server sent ${type || 'something without a type'} instead`);
    return await started(name, file, start);
  } catch (cause) {
    if (!broken) throw cause;
    throw unavailable(
      stop.signal.aborted
        ? `${name} stopped arriving after ${bytes} bytes; check the connection`
        : `${name} could not be fetched; check the connection`,
      cause,
    );
  } finally {
    clearTimeout(timer);
  }
}

/** What `start` makes of a file, or an error in our words: engines say it each in its own way, with offsets that help nobody. */
export async function started<S, T>(name: string, source: S, start: (source: S) => Promise<T>): Promise<T> {
  try {
    return await start(source);
  } catch (cause) {
    const isForbidden = cause instanceof Error && /content security policy|unsafe-eval/i.test(cause.message);
    throw unavailable(
      isForbidden
        ? `${name} may not be compiled: a Content-Security-Policy must allow 'wasm-unsafe-eval'`
        : `${name} could not be started: the file is damaged, or this browser is too old for it`,
      cause,
    );
  }
}

/**
 * Whether a file that is compiled while it arrives holds up all others: Firefox compiles one at a time on two cores, and what grows the rocks
 * would wait for the whole renderer.
 */
function isNarrow(): boolean {
  return navigator.hardwareConcurrency <= 2;
}

export function unavailable(message: string, cause?: unknown): RockFieldError {
  return new RockFieldError({ name: 'WasmUnavailable', message }, { cause });
}
