// A device that has no memory for a still: words instead of a blank picture, and the next one is drawn.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { makeStills } from '../../www/renderer/stills.ts';
import type { Drawing } from '../../www/renderer/stills.ts';

const OUT_OF_MEMORY = 0x0505;

/** A device of each kind that refuses the textures of stills as long as `isFull` says so. */
function drawingOn(backend: 'webgpu' | 'webgl', isFull: () => boolean): Drawing {
  let scopes = 0;
  let errors: number[] = [];
  const device = {
    lost: new Promise(() => {}),
    queue: { onSubmittedWorkDone: async () => {} },
    pushErrorScope: () => (scopes += 1),
    popErrorScope: async () => {
      scopes -= 1;
      assert.equal(scopes, 0, 'scopes are closed in the task that opened them');
      return isFull() ? {} : null;
    },
  };
  const gl = { OUT_OF_MEMORY, SIGNALED: 1, SYNC_STATUS: 2, getError: () => errors.shift() ?? 0 };
  const context = { ...gl, fenceSync: () => ({}), flush() {}, isContextLost: () => false, getSyncParameter: () => 1, deleteSync() {} };
  const canvas = {
    width: 640,
    height: 400,
    dataset: {},
    getContext: (kind: string) => (kind === 'webgpu' ? { getConfiguration: () => ({ device }) } : context),
  };
  // One of somebody else's, from before.
  errors = [OUT_OF_MEMORY];
  const beginStill = (): void => {
    if (isFull()) errors.push(OUT_OF_MEMORY);
  };
  return {
    raw: { beginStill, endStill() {} },
    device: { backend, canvas },
    canvas,
    guard: (call: () => unknown) => call(),
    setTile() {},
    copy() {},
  } as unknown as Drawing;
}

for (const backend of ['webgpu', 'webgl'] as const) {
  test(`${backend}: where there is no memory for a still it is refused in words, and the next one is drawn`, async () => {
    let full = true;
    const drawing = drawingOn(backend, () => full);
    const stills = makeStills(drawing);
    stills.begin();
    // The screen has its own picture back.
    [drawing.canvas.width, drawing.canvas.height] = [10, 10];
    await assert.rejects(stills.done(), { name: 'NoPicture', message: /no memory .* 640 × 400 pixels/ });
    stills.end();
    full = false;
    stills.begin();
    await stills.done();
    stills.end();
  });
}
