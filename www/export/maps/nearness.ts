/** How near each pixel of a map is to the nearest rock. */

import type { Grid } from './grid.ts';
import { GROUND } from './relief.ts';
import type { Relief } from './relief.ts';

/** No map is that high. */
const NOWHERE = 65_535;

/**
 * 255 on rocks, from there evenly down to 0 at `radius` and beyond, rounded. The distance is that between the middles of two pixels, exactly
 * (Felzenszwalb & Huttenlocher 2012): along columns first, then along rows as the lower envelope of a parabola for each column.
 *
 * @param radius in units of the model.
 */
export function nearnessOf({ heights }: Pick<Relief, 'heights'>, grid: Grid, radius: number): Uint8Array {
  const { width, height, perX, perY } = grid;
  const rows = rowsToRock(heights, width, height);
  const nearness = new Uint8Array(width * height);
  const envelope = new Envelope(width);
  const [across, along] = [1 / perX, 1 / perY];
  for (let row = 0; row < height; row++) {
    const first = row * width;
    envelope.clear();
    for (let column = 0; column < width; column++) {
      const count = rows[first + column]!;
      if (count !== NOWHERE) envelope.add(column, ((count * along) / across) * ((count * along) / across));
    }
    if (envelope.isEmpty()) continue;
    for (let column = 0, piece = 0; column < width; column++) {
      piece = envelope.pieceAt(column, piece);
      const [dx, dy] = [(column - envelope.columns[piece]!) * across, rows[first + envelope.columns[piece]!]! * along];
      const distance = Math.sqrt(dx * dx + dy * dy);
      if (distance < radius) nearness[first + column] = Math.round(255 * (1 - distance / radius));
    }
  }
  return nearness;
}

/** For each pixel, how many rows the nearest rock in its column is away. */
function rowsToRock(heights: Float32Array, width: number, height: number): Uint16Array {
  const rows = new Uint16Array(width * height);
  for (let at = 0; at < rows.length; at++) {
    if (heights[at] !== GROUND) rows[at] = 0;
    else rows[at] = at < width ? NOWHERE : Math.min(NOWHERE, rows[at - width]! + 1);
  }
  for (let at = rows.length - width - 1; at >= 0; at--) rows[at] = Math.min(rows[at]!, rows[at + width]! + 1);
  return rows;
}

/** The least of many parabolas (u − column)² + lift: which of them it is, from where to where. */
class Envelope {
  readonly columns: Uint16Array;
  readonly #lifts: Float64Array;
  /** Where each begins to be the least. */
  readonly #starts: Float64Array;
  #count = 0;

  constructor(width: number) {
    this.columns = new Uint16Array(width);
    this.#lifts = new Float64Array(width);
    this.#starts = new Float64Array(width);
  }

  clear(): void {
    this.#count = 0;
  }

  isEmpty(): boolean {
    return this.#count === 0;
  }

  /** Columns are added from left to right. */
  add(column: number, lift: number): void {
    let start = -Infinity;
    while (this.#count > 0) {
      const last = this.#count - 1;
      const other = this.columns[last]!;
      start = (lift + column * column - this.#lifts[last]! - other * other) / (2 * (column - other));
      if (start > this.#starts[last]!) break;
      this.#count = last;
      start = -Infinity;
    }
    this.columns[this.#count] = column;
    this.#lifts[this.#count] = lift;
    this.#starts[this.#count] = start;
    this.#count += 1;
  }

  /** The parabola that is the least at `column`, looked for from the one at the column before on. */
  pieceAt(column: number, before: number): number {
    let piece = before;
    while (piece + 1 < this.#count && this.#starts[piece + 1]! <= column) piece += 1;
    return piece;
  }
}
