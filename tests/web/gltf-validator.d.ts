/** The part of Khronos' validator that the tests use; the package has no types. */
declare module 'gltf-validator' {
  interface Issue {
    code: string;
    message: string;
    /** 0 error, 1 warning, 2 information, 3 hint. */
    severity: number;
  }
  const validator: {
    validateBytes(bytes: Uint8Array): Promise<{ issues: { numErrors: number; numWarnings: number; messages: Issue[] } }>;
  };
  export default validator;
}
