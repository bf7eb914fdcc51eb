/** Which points of the ground the pixels of a map stand for. */

import type { ResolvedOptions } from '../options.ts';

/**
 * Pixel (column, row) of a map stands for the point x = (column + 0.5 − `left`) / `perX`, y = depth − (row + 0.5 − `top`) / `perY` of the
 * model: rows run from the far side (the largest y) to the near one, as pictures do.
 */
export interface Grid {
  width: number;
  height: number;
  /** Pixels in a unit of the model, along x and y. */
  perX: number;
  perY: number;
  left: number;
  top: number;
  /** The model's extent along y. */
  depth: number;
}

type Choices = Pick<ResolvedOptions, 'side' | 'square' | 'samples'>;

/** @param ground the model's extents along x and y, from its origin on. */
export function gridOf([across, depth]: readonly [number, number], { side, square, samples }: Choices): Grid {
  const longer = Math.max(across, depth);
  const pixels = side || longer;
  const [width, height] = [across, depth].map((extent) => (square ? pixels : Math.max(1, Math.round((pixels * extent) / longer)))) as [
    number,
    number,
  ];
  // Corners lie half a pixel inside the picture; one pixel has no two of them.
  const inset = (count: number): 0 | 0.5 => (samples === 'corners' && count > 1 ? 0.5 : 0);
  const [left, top] = [inset(width), inset(height)];
  return { width, height, perX: (width - 2 * left) / across, perY: (height - 2 * top) / depth, left, top, depth };
}
