/** How high somebody stands who walks over rocks. */

import type { Field } from '../../data/field.ts';

/** What a foot covers to each side, and what it steps over without being raised, as shares of the height of the eye. */
const FOOT = 0.15;
const STEP = 0.12;
/** Most cells along a side: of a field that is much larger than who walks there, they are coarser. */
const MOST_CELLS = 256;
/** Half the width of the blur that makes a slope of a step, cells; and how often it is made: a slope without kinks. */
const BLUR = 2;
const BLURS = 2;

/**
 * A grid of heights that lie nowhere below the rocks, but for stones that are stepped over: the highest point within a foot's reach, made so
 * smooth that a boulder is climbed like a hill. Whoever's eye is above it is in no rock.
 */
export class Footing {
  readonly #cell: number;
  readonly #columns: number;
  readonly #rows: number;
  #heights: Float32Array;

  /** Round the field lies so much ground as there is slope. `eye`: height of the eye, px. */
  constructor({ imageWidth, imageHeight, positions, indices }: Field, eye: number) {
    const foot = FOOT * eye;
    this.#cell = Math.max(foot / 2, Math.max(imageWidth, imageHeight) / MOST_CELLS);
    const edge = 2 * this.#edge;
    this.#columns = Math.ceil(imageWidth / this.#cell) + edge;
    this.#rows = Math.ceil(imageHeight / this.#cell) + edge;
    this.#heights = new Float32Array(this.#columns * this.#rows);
    this.#raise(positions, indices);
    for (const [at, height] of this.#heights.entries()) if (height < STEP * eye) this.#heights[at] = 0;
    const reach = Math.ceil(foot / this.#cell) + BLUR * BLURS;
    this.#spread((line) => highest(line, reach));
    for (let k = 0; k < BLURS; k += 1) this.#spread((line) => mean(line, BLUR));
  }

  /** px above the ground, at a place of the field or beside it. */
  at(x: number, y: number): number {
    const [u, v] = [x / this.#cell + this.#edge - 0.5, y / this.#cell + this.#edge - 0.5];
    const [column, row] = [Math.floor(u), Math.floor(v)];
    const height = (i: number, j: number): number =>
      i >= 0 && j >= 0 && i < this.#columns && j < this.#rows ? this.#heights[j * this.#columns + i]! : 0;
    const along = (j: number): number => height(column, j) + (u - column) * (height(column + 1, j) - height(column, j));
    return along(row) + (v - row) * (along(row + 1) - along(row));
  }

  /** Cells round the field. */
  get #edge(): number {
    return 2 * BLUR * BLURS + 2;
  }

  /** To the top of each triangle, in every cell of its box. */
  #raise(positions: Float32Array, indices: Uint32Array): void {
    const cell = (value: number, count: number): number => Math.min(count - 1, Math.max(0, Math.floor(value / this.#cell) + this.#edge));
    for (let k = 0; k + 2 < indices.length; k += 3) {
      const a = 3 * indices[k]!;
      const b = 3 * indices[k + 1]!;
      const c = 3 * indices[k + 2]!;
      const top = Math.max(positions[a + 2]!, positions[b + 2]!, positions[c + 2]!);
      const left = cell(Math.min(positions[a]!, positions[b]!, positions[c]!), this.#columns);
      const right = cell(Math.max(positions[a]!, positions[b]!, positions[c]!), this.#columns);
      const low = cell(Math.min(positions[a + 1]!, positions[b + 1]!, positions[c + 1]!), this.#rows);
      const high = cell(Math.max(positions[a + 1]!, positions[b + 1]!, positions[c + 1]!), this.#rows);
      for (let row = low; row <= high; row += 1) {
        for (let at = row * this.#columns + left; at <= row * this.#columns + right; at += 1)
          if (top > this.#heights[at]!) this.#heights[at] = top;
      }
    }
  }

  /** Of all rows, and then of all columns, what `of` makes of them. */
  #spread(of: (line: Float32Array) => Float32Array): void {
    for (const isRow of [true, false]) {
      const [lines, length] = isRow ? [this.#rows, this.#columns] : [this.#columns, this.#rows];
      for (let k = 0; k < lines; k += 1) {
        const place = (i: number): number => (isRow ? k * length + i : i * lines + k);
        const line = of(Float32Array.from({ length }, (_, i) => this.#heights[place(i)]!));
        for (let i = 0; i < length; i += 1) this.#heights[place(i)] = line[i]!;
      }
    }
  }
}

function highest(line: Float32Array, reach: number): Float32Array {
  return line.map((_, i) => Math.max(...line.subarray(Math.max(0, i - reach), i + reach + 1)));
}

function mean(line: Float32Array, reach: number): Float32Array {
  return line.map((_, i) => {
    let sum = 0;
    for (let k = i - reach; k <= i + reach; k += 1) sum += line[Math.min(line.length - 1, Math.max(0, k))]!;
    return sum / (2 * reach + 1);
  });
}
