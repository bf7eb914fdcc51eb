// How many pixels a picture on a page has.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MAX_PIXELS } from '../../www/renderer/limits.ts';
import { StageSize } from '../../www/scene/stage-size.ts';

function sizeOf(width: number, height: number, devicePixelRatio: number): StageSize {
  class ResizeObserver {
    observe(): void {}
    disconnect(): void {}
  }
  const stage = { clientWidth: width, clientHeight: height, ownerDocument: { defaultView: { ResizeObserver, devicePixelRatio } } };
  const size = new StageSize(stage as unknown as HTMLElement, () => {}, new AbortController().signal);
  size.measure();
  return size;
}

test('whatever the device pixel ratio is, a picture has no more pixels than a device draws, in the shape of its stage', () => {
  for (const [width, height, ratio] of [
    [1440, 900, 4],
    [360, 640, 4],
    [7680, 4320, 1],
    [100_000, 3, 8],
    [0.3, 0.2, 0.5],
  ] as const) {
    const { pixels } = sizeOf(width, height, ratio);
    const [across, down] = pixels;
    assert(across >= 1 && down >= 1 && across * down <= MAX_PIXELS, pixels.join(' × '));
    const wanted = width * ratio * height * ratio;
    if (wanted > MAX_PIXELS && height > 100) {
      assert(across * down > 0.99 * MAX_PIXELS, 'it could have more');
      assert(Math.abs(across / down - width / height) < 0.01);
    }
  }
  assert.deepEqual(sizeOf(360, 640, 3).pixels, [1080, 1920]);
});
