/** Made by scripts/build/inline.mjs. */
declare module 'inlined:worker' {
  const script: string;
  export default script;
}

declare module 'inlined:full-worker' {
  const script: string;
  export default script;
}

declare module 'inlined:export-worker' {
  const script: string;
  export default script;
}

declare module 'inlined:wood-ear-file-worker' {
  const script: string;
  export default script;
}

declare module 'inlined:wood-ear-export-worker' {
  const script: string;
  export default script;
}

declare module 'inlined:wood-ear-worker' {
  const script: string;
  export default script;
}
