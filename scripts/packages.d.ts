// What these packages export, where their own types say something else.

/** Its types describe its plugins alone. The parser is the package's own, of TypeScript 5. */
declare module '@custom-elements-manifest/analyzer' {
  type TypeScript = typeof import('../node_modules/@custom-elements-manifest/analyzer/node_modules/typescript/lib/typescript.js');
  export const ts: TypeScript;
  export function create(options: {
    modules: ReturnType<TypeScript['createSourceFile']>[];
    plugins: object[];
    context: { dev: boolean };
  }): import('custom-elements-manifest/schema').Package;
}

/** Its types have `Function` at modules, where it is not. */
declare module 'binaryen' {
  interface Module {
    getNumFunctions(): number;
    getFunctionByIndex(index: number): number;
    unreachable(): number;
    emitBinary(): Uint8Array;
    dispose(): void;
  }
  const binaryen: {
    readBinary(bytes: Uint8Array): Module;
    getFunctionInfo(pointer: number): { name: string; base: string };
    Function: { setBody(pointer: number, body: number): void };
  };
  export default binaryen;
}

/** It has no types of its own. */
declare module 'spdx-expression-parse' {
  type Expression = { license: string; exception?: string } | { left: Expression; conjunction: 'and' | 'or'; right: Expression };
  export default function parse(expression: string): Expression;
}
