/** What is seen of a model from straight above: a depth buffer. */

import type { Model } from '../model.ts';
import type { Turn } from '../pace.ts';
import type { Grid } from './grid.ts';

/** What bare ground is in `heights`: lower than the rim of a rock, which lies on 0 and is part of the rock. */
export const GROUND = -1;

/** Nearer than this to the middle of a pixel, in pixels, an edge is looked at without rounding. */
const CLOSE = 1e-6;
/** After so many indices others may have their turn. */
const STRETCH = 3 << 13;

type Surface = Pick<Model, 'positions' | 'indices'>;

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
export async function reliefOf(model: Surface, grid: Grid, withTriangles: boolean, turn?: Turn): Promise<Relief> {
  const pixels = grid.width * grid.height;
  const relief = { heights: new Float32Array(pixels).fill(GROUND), triangles: new Uint32Array(withTriangles ? pixels : 0) };
  const end = model.indices.length;
  for (let first = 0; first < end; first += STRETCH) {
    await turn?.(first / end);
    draw(relief, grid, model, first, Math.min(end, first + STRETCH));
  }
  return relief;
}

/** Draws the triangles whose indices stand from `first` to `end`, each row by row, between the edges that cross the row. */
function draw({ heights, triangles }: Relief, grid: Grid, { positions: p, indices }: Surface, first: number, end: number): void {
  const { width, height, perX, perY, depth } = grid;
  const withTriangles = triangles.length > 0;
  // Columns and rows are counted from the middle of the first pixel.
  const [left, top] = [grid.left - 0.5, grid.top - 0.5];
  for (let i = first; i < end; i += 3) {
    // The corners from the far side to the near one: a, b, c.
    let a = 3 * indices[i]!;
    let b = 3 * indices[i + 1]!;
    let c = 3 * indices[i + 2]!;
    if (p[a + 1]! < p[b + 1]!) [a, b] = [b, a];
    if (p[a + 1]! < p[c + 1]!) [a, c] = [c, a];
    if (p[b + 1]! < p[c + 1]!) [b, c] = [c, b];
    const ay = (depth - p[a + 1]!) * perY + top;
    const by = (depth - p[b + 1]!) * perY + top;
    const cy = (depth - p[c + 1]!) * perY + top;
    const firstRow = Math.max(0, Math.ceil(ay));
    const lastRow = Math.min(height - 1, Math.ceil(cy) - 1);
    const az = p[a + 2]!;
    const bz = p[b + 2]!;
    const cz = p[c + 2]!;
    if (firstRow > lastRow || (az < 0 && bz < 0 && cz < 0)) continue;
    const ax = p[a]! * perX + left;
    const bx = p[b]! * perX + left;
    const cx = p[c]! * perX + left;
    const twiceArea = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (twiceArea === 0) continue;
    const perColumn = ((bz - az) * (cy - ay) - (cz - az) * (by - ay)) / twiceArea;
    const perRow = ((cz - az) * (bx - ax) - (bz - az) * (cx - ax)) / twiceArea;
    // No rounding takes a height out of these.
    const lowest = Math.min(az, bz, cz);
    const highest = Math.max(az, bz, cz);
    const ac = (cx - ax) / (cy - ay);
    const ab = (bx - ax) / (by - ay);
    const bc = (cx - bx) / (cy - by);
    const number = i / 3 + 1;
    for (let row = firstRow; row <= lastRow; row++) {
      const long = columnAt(row, ax, ay, cx, cy, ac);
      const short = row < by ? columnAt(row, ax, ay, bx, by, ab) : columnAt(row, bx, by, cx, cy, bc);
      const firstColumn = Math.max(0, Math.min(long, short));
      const lastColumn = Math.min(width, Math.max(long, short)) - 1;
      const begin = az + perRow * (row - ay) - perColumn * ax;
      for (let column = firstColumn, at = row * width + firstColumn; column <= lastColumn; column++, at++) {
        const above = Math.fround(Math.min(highest, Math.max(lowest, begin + perColumn * column)));
        if (above < 0 || above <= heights[at]!) continue;
        heights[at] = above;
        if (withTriangles) triangles[at] = number;
      }
    }
  }
}

/**
 * The first column of a row whose middle is on an edge or right of it. The triangles on both sides of the edge ask the same, since it always goes
 * from its farther end to the nearer one, and so they agree.
 */
function columnAt(row: number, fromX: number, fromY: number, toX: number, toY: number, slope: number): number {
  const crossing = fromX + slope * (row - fromY);
  const next = Math.ceil(crossing);
  const away = next - crossing;
  if (away > CLOSE && away < 1 - CLOSE) return next;
  const near = away < 0.5 ? next : next - 1;
  return (toX - fromX) * (row - fromY) <= (near - fromX) * (toY - fromY) ? near : near + 1;
}

/** For each triangle of a model its body. */
export function bodiesOf({ indices, indexStarts }: Pick<Model, 'indices' | 'indexStarts'>): Uint32Array {
  const bodies = new Uint32Array(indices.length / 3);
  for (let k = 0; k + 1 < indexStarts.length; k++) bodies.fill(k, indexStarts[k]! / 3, indexStarts[k + 1]! / 3);
  return bodies;
}
