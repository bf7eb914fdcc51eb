/** Made by scripts/inline.mjs. */
declare module 'inlined:worker' {
  const script: string;
  export default script;
}
