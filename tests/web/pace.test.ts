// What is known of a graphics device before anything was drawn: its name, and what the last visit found out.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { isSoftware, paceOf, rememberPace } from '../../www/renderer/pace.ts';

test('software GPUs are known by their names', () => {
  for (const name of [
    'webgl ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)',
    'webgpu google swiftshader',
    'llvmpipe (LLVM 15.0.6, 256 bits)',
    'Microsoft Basic Render Driver',
    'intel fallback',
  ])
    assert(isSoftware(name), name);
  for (const name of ['', 'nvidia ampere', 'ANGLE (Intel, Mesa Intel(R) UHD Graphics 620 (KBL GT2), OpenGL 4.6)', 'apple metal-3'])
    assert(!isSoftware(name), name);
});

test('a device begins as the last visit left it; what storage holds is not trusted, and may not be had', () => {
  const fresh = { level: 'medium', isCut: false, pixels: 0 };
  const stored = new Map<string, string>();
  const storage = {
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, value: string) => void stored.set(key, value),
  };
  assert.deepEqual(paceOf('gpu'), fresh, 'without storage');
  rememberPace('gpu', { level: 'low', isCut: true, pixels: 50_000 });
  Object.defineProperty(globalThis, 'localStorage', { value: storage, configurable: true });
  try {
    rememberPace('gpu', { level: 'low', isCut: true, pixels: 50_000 });
    assert.deepEqual(paceOf('gpu'), { level: 'low', isCut: true, pixels: 50_000 });
    assert.deepEqual(paceOf('another'), fresh);
    const [key] = stored.keys();
    for (const value of [
      '',
      '{',
      'null',
      '7',
      '{"level":"best"}',
      '{"level":"low","isCut":true,"pixels":-1}',
      '{"level":"low","isCut":1,"pixels":1}',
    ]) {
      stored.set(key!, value);
      assert.deepEqual(paceOf('gpu'), fresh, value);
    }
  } finally {
    Reflect.deleteProperty(globalThis, 'localStorage');
  }
});
