/** A still, drawn sample by sample: each in a task of its own, so that the page goes on. */

import { RockFieldError } from '../base/errors.ts';
import type { CameraState } from '../base/view.ts';
import type { Lens, SceneRenderer, Tile } from '../renderer/renderer.ts';

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
export async function stillPicture<T>(picture: StillPicture, take: () => T): Promise<T | undefined> {
  const { renderer, samples, prepare, restore, signal } = picture;
  const { stills } = renderer;
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
  onStage(() => stills.begin(picture.tile, picture.lens));
  try {
    for (let drawn = 0; drawn < samples; drawn += 1) {
      prepare();
      await stills.add();
      signal?.throwIfAborted();
      if (renderer.isLost || !picture.isSame()) return undefined;
      picture.onProgress?.((drawn + 1) / (samples + 1));
    }
    return onStage(() => {
      stills.show();
      return take();
    });
  } finally {
    stills.end();
  }
}
