/** The one thing of Node that www/ uses (core.node.ts); @types/node would declare its globals for the page too. */
declare module 'node:fs/promises' {
  export function readFile(path: URL): Promise<Uint8Array<ArrayBuffer>>;
}
