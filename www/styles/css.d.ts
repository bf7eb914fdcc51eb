/** A style sheet as text, with what it imports (scripts/build/web.mjs). */
declare module '*.css' {
  const css: string;
  export default css;
}
