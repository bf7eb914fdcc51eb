/** Stills of a wasm renderer. */

import type { RawRenderer } from './artefact.ts';
import type { SharedDevice } from './device.ts';
import { deviceDone } from './done.ts';
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
  return {
    begin: (tile, lens = { radius: 0, focus: 1 }) => {
      if (tile) setTile(tile);
      guard(() => raw.beginStill(lens.radius, lens.focus));
      canvas.dataset['drawing'] = '';
    },
    make: () => guard(() => raw.makeNext(SAMPLE)) === true,
    draw: (pixels) => guard(() => raw.drawSample(pixels)) === true,
    done: () => deviceDone(device.canvas ?? canvas, device.backend),
    show: () =>
      guard(() => {
        raw.showStill();
        copy(size());
      }),
    blend: (opacity) => guard(() => raw.refinePicture(opacity) && copy(size())),
    end: () => {
      guard(() => raw.endStill());
      delete canvas.dataset['drawing'];
    },
  };
}
