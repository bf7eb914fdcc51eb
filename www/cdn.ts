/**
 * What makes of `rock-field.ts` the classic script `cdn.js`, which also works from another origin.
 *
 * The bundler puts these two in the place of `import.meta.url` and of `Worker` (scripts/web.mjs). The module build knows nothing
 * of them: served from the page's own origin it needs no `blob:` in its Content-Security-Policy.
 */

/** The address of cdn.js, beside which the worker and the wasm lie. Only known while the script runs for the first time; none on a server. */
export const scriptUrl = (globalThis.document?.currentScript as HTMLScriptElement | null | undefined)?.src;

const NativeWorker = globalThis.Worker;

/**
 * `Worker`, from any origin: a browser starts none from a foreign one, but a worker of our own may import foreign modules.
 *
 * A static import, since messages that come before the end of a dynamic one would be lost. A function, since a server has no class to extend.
 */
export function Worker(url: URL, options: WorkerOptions): globalThis.Worker {
  if (url.origin === globalThis.location.origin) return new NativeWorker(url, options);
  const address = URL.createObjectURL(new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' }));
  try {
    return new NativeWorker(address, options);
  } finally {
    // The worker has looked it up by now.
    URL.revokeObjectURL(address);
  }
}
