/** What is seen of a model from straight above: a depth buffer. */

import type { Model } from '../model.ts';
import type { Turn } from '../pace.ts';
import type { Grid } from './grid.ts';

/** Triangles of so many columns or fewer are tried at all of them. */
const NARROW = 4;
/** Edges that rise less than this cross a row where nobody can tell exactly enough. */
const FLAT = 1e-6;

/** What bare ground is in `heights`: lower than the rim of a rock, which lies on 0 and is part of the rock. */
export const GROUND = -1;

/** After so many indices others may have their turn. */
const STRETCH = 3 << 13;

export interface Relief {
  /** For each pixel, the height of the highest surface on or above the ground, in units of the model; `GROUND` where there is none. */
  heights: Float32Array;
  /** For each pixel, the triangle that it shows, counted from 1; 0 is the ground. Empty where nobody asks for it. */
  triangles: Uint32Array;
}

/**
 * Draws all triangles as far as they are not below the ground, from either side. A pixel shows what lies in its middle.
 *
 * A middle that lies exactly on an edge belongs to the triangle on its right or below, so that neighbours leave no gap and share no pixel: the
 * rule of graphics devices. Of surfaces at the same height the first counts. Only + − × ÷: the same everywhere.
 */
export async function reliefOf(
  { positions, indices }: Pick<Model, 'positions' | 'indices'>,
  grid: Grid,
  withTriangles: boolean,
  turn?: Turn,
): Promise<Relief> {
  const pixels = grid.width * grid.height;
  const relief = { heights: new Float32Array(pixels).fill(GROUND), triangles: new Uint32Array(withTriangles ? pixels : 0) };
  const corners = new Corners(positions, grid);
  for (let first = 0; first < indices.length; first += STRETCH) {
    await turn?.(first / indices.length);
    draw(relief, grid.width, corners, indices, first, Math.min(indices.length, first + STRETCH));
  }
  return relief;
}

/** Draws the triangles whose indices stand from `first` to `end`. */
function draw({ heights, triangles }: Relief, width: number, corners: Corners, indices: Uint32Array, first: number, end: number): void {
  const withTriangles = triangles.length > 0;
  for (let i = first; i < end; i += 3) {
    if (!corners.take(indices[i]!, indices[i + 1]!, indices[i + 2]!)) continue;
    const { x, y, dx, dy, least, z, lastRow } = corners;
    const isWide = corners.lastColumn - corners.firstColumn > NARROW;
    for (let row = corners.firstRow; row <= lastRow; row++) {
      // The edges' functions are these less `dy` times the column's distance from `x`.
      const r0 = dx[0]! * (row + 0.5 - y[0]!);
      const r1 = dx[1]! * (row + 0.5 - y[1]!);
      const r2 = dx[2]! * (row + 0.5 - y[2]!);
      let firstColumn = corners.firstColumn;
      let lastColumn = corners.lastColumn;
      if (isWide) {
        // Where about the edges cross the row, with a pixel to spare: what is in is told below.
        for (let k = 0; k < 3; k++) {
          if (Math.abs(dy[k]!) < FLAT) continue;
          const crossing = x[k]! + (k === 0 ? r0 : k === 1 ? r1 : r2) / dy[k]! - 0.5;
          if (dy[k]! < 0) firstColumn = Math.max(firstColumn, Math.floor(crossing));
          else lastColumn = Math.min(lastColumn, Math.ceil(crossing));
        }
      }
      let isInside = false;
      for (let column = firstColumn, at = row * width + firstColumn; column <= lastColumn; column++, at++) {
        const w0 = r0 - dy[0]! * (column + 0.5 - x[0]!);
        const w1 = r1 - dy[1]! * (column + 0.5 - x[1]!);
        const w2 = r2 - dy[2]! * (column + 0.5 - x[2]!);
        if (w0 < least[0]! || w1 < least[1]! || w2 < least[2]!) {
          if (isInside) break;
          continue;
        }
        isInside = true;
        const above = Math.fround((w0 * z[0]! + w1 * z[1]! + w2 * z[2]!) / (w0 + w1 + w2));
        if (above < 0 || above <= heights[at]!) continue;
        heights[at] = above;
        if (withTriangles) triangles[at] = i / 3 + 1;
      }
    }
  }
}

/**
 * A triangle on the grid, kept in one place for all of them. Edge k lies opposite corner k; at a point (u, v) its function is
 * `dx[k] · (v − y[k]) − dy[k] · (u − x[k])`, which is the corner's weight there.
 *
 * The triangles on both sides of an edge reckon it from the same end, so that they agree to the last digit on which side a point is.
 */
class Corners {
  readonly x = new Float64Array(3);
  readonly y = new Float64Array(3);
  readonly dx = new Float64Array(3);
  readonly dy = new Float64Array(3);
  /** What the function must reach for a point that is in. */
  readonly least = new Float64Array(3);
  readonly z = new Float64Array(3);
  /** The pixels whose middles are in the box around it. */
  firstColumn = 0;
  lastColumn = 0;
  firstRow = 0;
  lastRow = 0;
  readonly #positions: Float32Array;
  readonly #grid: Grid;

  constructor(positions: Float32Array, grid: Grid) {
    this.#positions = positions;
    this.#grid = grid;
  }

  /** Takes over the triangle between three vertices. False if no pixel can show it. */
  take(a: number, b: number, c: number): boolean {
    const p = this.#positions;
    const { width, height, perX, perY, left, top, depth } = this.#grid;
    const az = p[3 * a + 2]!;
    const bz = p[3 * b + 2]!;
    const cz = p[3 * c + 2]!;
    if (az < 0 && bz < 0 && cz < 0) return false;
    const ax = p[3 * a]! * perX + left;
    const bx = p[3 * b]! * perX + left;
    const cx = p[3 * c]! * perX + left;
    this.firstColumn = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
    this.lastColumn = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
    if (this.firstColumn > this.lastColumn) return false;
    const ay = (depth - p[3 * a + 1]!) * perY + top;
    const by = (depth - p[3 * b + 1]!) * perY + top;
    const cy = (depth - p[3 * c + 1]!) * perY + top;
    this.firstRow = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
    this.lastRow = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
    if (this.firstRow > this.lastRow) return false;
    const twiceArea = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (twiceArea === 0) return false;
    // Always the same way round.
    const way = twiceArea > 0 ? 1 : -1;
    this.#edge(0, way, bx, by, cx, cy, az);
    this.#edge(1, way, cx, cy, ax, ay, bz);
    this.#edge(2, way, ax, ay, bx, by, cz);
    return true;
  }

  #edge(k: number, way: number, fromX: number, fromY: number, toX: number, toY: number, opposite: number): void {
    const isForth = fromX < toX || (fromX === toX && fromY < toY);
    const dx = way * (toX - fromX);
    const dy = way * (toY - fromY);
    this.x[k] = isForth ? fromX : toX;
    this.y[k] = isForth ? fromY : toY;
    this.dx[k] = dx;
    this.dy[k] = dy;
    this.z[k] = opposite;
    const isLeftOrTop = dy < 0 || (dy === 0 && dx > 0);
    this.least[k] = isLeftOrTop ? 0 : Number.MIN_VALUE;
  }
}

/** For each triangle of a model its body. */
export function bodiesOf({ indices, indexStarts }: Pick<Model, 'indices' | 'indexStarts'>): Uint32Array {
  const bodies = new Uint32Array(indices.length / 3);
  for (let k = 0; k + 1 < indexStarts.length; k++) bodies.fill(k, indexStarts[k]! / 3, indexStarts[k + 1]! / 3);
  return bodies;
}
