// A device that has no memory for a still: words instead of a blank picture, and the next one is drawn.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { makeStills } from '../../www/renderer/stills.ts';
import type { Drawing } from '../../www/renderer/stills.ts';

const OUT_OF_MEMORY = 0x0505;

/**
 * A device of each kind that refuses the textures of stills as long as `isFull` says so. One of WebGL2 is busy with what it was given until it was asked
 * a few times, and whoever asks for its errors before has the page wait.
 */
function drawingOn(backend: 'webgpu' | 'webgl', isFull: () => boolean, refuse = (): void => {}): Drawing {
  let scopes = 0;
  let errors: number[] = [];
  let toDo = 3;
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
  const getError = (): number => {
    assert.equal(toDo, 0, 'a page waits for a device that is busy');
    return errors.shift() ?? 0;
  };
  const getSyncParameter = (): number => {
    toDo = Math.max(0, toDo - 1);
    return toDo === 0 ? 1 : 0;
  };
  const gl = { OUT_OF_MEMORY, SIGNALED: 1, SYNC_STATUS: 2, getError };
  const context = { ...gl, fenceSync: () => ({}), flush() {}, isContextLost: () => false, getSyncParameter, deleteSync() {} };
  const canvas = {
    width: 640,
    height: 400,
    dataset: {},
    getContext: (kind: string) => (kind === 'webgpu' ? { getConfiguration: () => ({ device }) } : context),
  };
  // One of somebody else's, from before.
  errors = [OUT_OF_MEMORY];
  const beginStill = (): void => {
    refuse();
    toDo = 3;
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
    await stills.done();
    stills.begin();
    // The screen has its own picture back.
    [drawing.canvas.width, drawing.canvas.height] = [10, 10];
    await assert.rejects(stills.done(), { name: 'NoPicture', message: /no memory .* 640 × 400 pixels/ });
    stills.end();
    full = false;
    await stills.done();
    stills.begin();
    await stills.done();
    stills.end();
  });

  test(`${backend}: after a still that the renderer refuses the next one is drawn`, async () => {
    let isRefused = true;
    const stills = makeStills(
      drawingOn(
        backend,
        () => false,
        () => {
          if (isRefused) throw new Error('too large');
        },
      ),
    );
    await stills.done();
    assert.throws(() => stills.begin(), /too large/);
    stills.end();
    isRefused = false;
    stills.begin();
    await stills.done();
    stills.end();
  });
}
