/**
 * What makes of the package's scripts a build with everything in it, for bundlers that leave `new URL('./file', import.meta.url)` as
 * it stands and do not take the file along: esbuild, and Rollup by itself.
 *
 * The bundler puts `inlined(…)` in the place of a wasm file's address, and this `fetch` in the place of the browser's
 * (scripts/build/inline.mjs). The other builds know nothing of it.
 */

/** By address: a script whose default export is the file, deflated, in base64. */
const files = new Map<string, () => Promise<{ default: string }>>();

/** Nobody is ever asked for it: the name cannot exist. */
const NOWHERE = 'https://inlined.invalid/';

export function inlined(name: string, load: () => Promise<{ default: string }>): URL {
  const address = new URL(name, NOWHERE);
  files.set(address.href, load);
  return address;
}

export async function fetch(address: URL | string): Promise<Response> {
  const load = files.get(String(address));
  if (!load) return globalThis.fetch(address);
  const { default: text } = await load();
  const deflated = Uint8Array.from(atob(text), (char) => char.charCodeAt(0));
  const body = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(body, { headers: { 'content-type': 'application/wasm' } });
}
