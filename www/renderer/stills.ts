/** Stills of a wasm renderer. */

import { RockFieldError } from '../base/errors.ts';
import type { RawRenderer } from './artefact.ts';
import type { SharedDevice } from './device.ts';
import { deviceDone } from './done.ts';
import { watchMemory } from './memory.ts';
import type { Stills, Tile } from './renderer.ts';

/** What a renderer gives to those that draw with it. */
export interface Drawing {
  raw: RawRenderer;
  device: SharedDevice;
  canvas: HTMLCanvasElement;
  /** Calls into wasm unless that is over. */
  guard<T>(call: () => T): T | undefined;
  setTile(tile: Tile): void;
  /** Copies what was just drawn, which has this size, to the canvas. */
  copy(size: readonly [number, number]): void;
}

/** `makeNext` of the wasm takes it. */
const SAMPLE = 2;

export function makeStills({ raw, device, canvas, guard, setTile, copy }: Drawing): Stills {
  const size = (): [number, number] => [canvas.width, canvas.height];
  const target = device.canvas ?? canvas;
  /** Of the still that is begun: its size, and whether there was memory for it. */
  let begun = size();
  let hadMemory: (() => Promise<boolean>) | undefined;
  return {
    begin: (tile, lens = { radius: 0, focus: 1 }) => {
      if (tile) setTile(tile);
      hadMemory = watchMemory(target, device.backend, () => guard(() => raw.beginStill(lens.radius, lens.focus)));
      begun = size();
    },
    make: () => {
      // As with pieces, others can tell that a picture is on its way.
      canvas.dataset['drawing'] = '';
      return guard(() => device.makeNext(raw, SAMPLE)) === true;
    },
    draw: (pixels) => guard(() => raw.drawSample(pixels)) === true,
    done: async () => {
      await deviceDone(target, device.backend);
      if ((await hadMemory?.()) === false) throw tooLarge(begun);
    },
    show: () =>
      guard(() => {
        raw.showStill();
        copy(size());
      }),
    blend: (opacity) => guard(() => raw.refinePicture(opacity) && copy(size())),
    end: () => {
      hadMemory = undefined;
      guard(() => raw.endStill());
      delete canvas.dataset['drawing'];
    },
  };
}

function tooLarge([width, height]: readonly [number, number]): RockFieldError {
  const message = `the graphics device has no memory for the mean of samples of a picture of ${width} × ${height} pixels; a smaller one takes less`;
  return new RockFieldError({ name: 'NoPicture', message });
}
