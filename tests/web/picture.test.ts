import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import { takePicture } from '../../www/scene/picture.ts';
import type { CameraState } from '../../www/base/view.ts';
import type { SceneRenderer } from '../../www/renderer/renderer.ts';

const CAMERA: CameraState = { azimuth: 0, elevation: 1, distance: 100, target: [0, 0, 0] };

/** A renderer that refuses with an error as the wasm's are, or in a way of its own. */
function refusing(thrown: unknown): SceneRenderer {
  const renderer: Partial<SceneRenderer> = {
    canvas: { width: 10, height: 10 } as HTMLCanvasElement,
    resize() {},
    setCamera() {},
    render() {
      throw thrown;
    },
  };
  return renderer as SceneRenderer;
}

test('what the renderer refuses is an error of the list, with its name where it has one', async () => {
  const named = (name: string) => Object.assign(new Error(`${name} because`), { name });
  const cases: [unknown, string, string][] = [
    [named('NoSurface'), 'NoSurface', 'NoSurface because'],
    [named('FieldTooLarge'), 'FieldTooLarge', 'FieldTooLarge because'],
    [named('MalformedField'), 'MalformedField', 'MalformedField because'],
    [named('TypeError'), 'RendererFailed', 'the picture could not be made: TypeError because'],
    ['a string', 'RendererFailed', 'the picture could not be made: a string'],
  ];
  for (const [thrown, name, message] of cases) {
    await assert.rejects(
      takePicture(refusing(thrown), [10, 10], CAMERA, {}),
      (error: unknown) => error instanceof RockFieldError && error.name === name && error.message === message,
      name,
    );
  }
});
