// How a wasm file is handed to what starts it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { startWasmFile } from '../../www/base/wasm-file.ts';

/** Whether the file was compiled while it arrived, by the number of the device's cores. */
async function isStreamed(cores: number, heard?: (bytes: number) => void): Promise<boolean> {
  Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: cores }, configurable: true });
  const response = Promise.resolve(
    new Response(new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]), { headers: { 'Content-Type': 'application/wasm' } }),
  );
  return startWasmFile(
    'https://a.test/a.wasm',
    async (source) => {
      const isResponse = source instanceof Response;
      assert.equal((isResponse ? await source.arrayBuffer() : source).byteLength, 8);
      return isResponse;
    },
    { response, stop: new AbortController(), ...(heard && { heard }) },
  );
}

test('on two cores the large file, whose arrival is told, is not compiled while it arrives, so that it does not hold up the small one', async () => {
  const bytes: number[] = [];
  const heard = (count: number) => void bytes.push(count);
  assert.deepEqual(
    [await isStreamed(2, heard), await isStreamed(2), await isStreamed(4, heard), await isStreamed(4)],
    [false, true, true, true],
  );
  assert.deepEqual(bytes, [8, 8], 'its arrival is told either way');
});
