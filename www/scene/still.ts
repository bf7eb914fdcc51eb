/** A still that somebody waits for, such as a picture as a file. */

import { RockFieldError } from '../base/errors.ts';
import type { CameraState } from '../base/view.ts';
import type { Lens, SceneRenderer, Tile } from '../renderer/renderer.ts';
import { Samples } from './samples.ts';
import { inTurn } from './turns.ts';

export interface StillPicture {
  renderer: SceneRenderer;
  size: readonly [width: number, height: number];
  /** Where the still is a part of a larger picture; of the same size. */
  tile?: Tile;
  camera: CameraState;
  samples: number;
  lens?: Lens | undefined;
  /** Readies the renderer for the picture. */
  prepare: () => void;
  /** Gives the screen its own picture back, in the same task. */
  restore: () => void;
  /** Whether what is drawn is still the same: a mean of two scenes is none. */
  isSame: () => boolean;
  signal?: AbortSignal | undefined;
  onProgress?: ((fraction: number) => void) | undefined;
}

/**
 * What `take` makes of the canvas when it shows the still; undefined where the device was lost, or the scene changed, before.
 *
 * @throws the signal's reason, and what the renderer refuses.
 */
export function stillPicture<T>(picture: StillPicture, take: () => T): Promise<T | undefined> {
  return inTurn(() => make(picture, take));
}

async function make<T>(picture: StillPicture, take: () => T): Promise<T | undefined> {
  const { renderer, prepare, restore, signal } = picture;
  const stills = await renderer.stills?.();
  if (!stills) throw new RockFieldError({ name: 'NoPicture', message: 'without a GPU there are no samples to be drawn' });
  const onStage = <R>(work: () => R): R => {
    prepare();
    renderer.setCamera(picture.camera);
    renderer.resize(...picture.size);
    try {
      return work();
    } finally {
      restore();
    }
  };
  const isOver = (): boolean => {
    signal?.throwIfAborted();
    return renderer.isLost || !picture.isSame();
  };
  const samples = new Samples({ stills, prepare, isOver });
  try {
    if (!(await samples.ready())) return undefined;
    onStage(() => stills.begin(picture.tile, picture.lens));
    for (let drawn = 1; drawn <= picture.samples; drawn += 1) {
      if (!(await samples.draw())) return undefined;
      picture.onProgress?.(drawn / (picture.samples + 1));
    }
    return onStage(() => {
      stills.show();
      return take();
    });
  } finally {
    stills.end();
  }
}
