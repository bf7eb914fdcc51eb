/** The maps as numbers: what each pixel of them says. */

import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';
import type { Turn } from '../pace.ts';
import type { Grid } from './grid.ts';
import { nearnessOf } from './nearness.ts';
import { bodiesOf, GROUND, reliefOf } from './relief.ts';
import type { Relief } from './relief.ts';

/** Samples of 8 or 16 bits, row by row from the far side on, `channels` of them for each pixel. */
export interface Raster {
  width: number;
  height: number;
  channels: 1 | 3 | 4;
  samples: Uint8Array | Uint16Array;
}

/** A model with the ground that its maps show. */
export type Mapped = Model & { ground: NonNullable<Model['ground']> };

type Choices = Pick<ResolvedOptions, 'contact' | 'green'>;

/** All maps of a model on a grid. Each is made when it is asked for; what several of them need is kept. */
export class Rasters {
  readonly grid: Grid;
  readonly relief: Relief;
  readonly #model: Mapped;
  readonly #choices: Choices;
  #near: Uint8Array | undefined;
  #bodies: Uint32Array | undefined;

  private constructor(model: Mapped, grid: Grid, choices: Choices, relief: Relief) {
    this.grid = grid;
    this.relief = relief;
    this.#model = model;
    this.#choices = choices;
  }

  /** @param withTriangles whether `normal`, `id` or `splat` will be asked for. */
  static async of(model: Mapped, grid: Grid, choices: Choices, withTriangles: boolean, turn?: Turn): Promise<Rasters> {
    return new Rasters(model, grid, choices, await reliefOf(model, grid, withTriangles, turn));
  }

  /** The height that is white, in units of the model: that of the highest vertex, which no size of the map changes. 0 of bare ground. */
  get highest(): number {
    const { positions } = this.#model;
    let highest = 0;
    for (let z = 2; z < positions.length; z += 3) highest = Math.max(highest, positions[z]!);
    return highest;
  }

  /** 0 is the ground, 65535 the highest vertex. */
  height(): Raster {
    const { heights } = this.relief;
    const samples = new Uint16Array(heights.length);
    const scale = 65_535 / (this.highest || 1);
    for (let at = 0; at < samples.length; at++) samples[at] = Math.round(Math.max(0, heights[at]!) * scale);
    return this.#raster(1, samples);
  }

  /** x to the right, y up in the picture or down, and z towards the viewer, each from −1 as 0 to 1 as 255. */
  normal(): Raster {
    const { triangles } = this.relief;
    const samples = new Uint8Array(3 * triangles.length);
    const shade = normalsOf(this.#model, this.grid);
    const sign = this.#choices.green === 'up' ? 1 : -1;
    for (let at = 0; at < triangles.length; at++) {
      const [x, y, z] = triangles[at] === 0 ? UP : shade(triangles[at]! - 1, at);
      samples[3 * at] = byteOf(x);
      samples[3 * at + 1] = byteOf(sign * y);
      samples[3 * at + 2] = byteOf(z);
    }
    return this.#raster(3, samples);
  }

  /** The number of the body, counted from 1, as red + 256 · green + 65536 · blue; 0 is the ground. No model has 2²⁴ bodies. */
  id(): Raster {
    const { triangles } = this.relief;
    const samples = new Uint8Array(3 * triangles.length);
    for (let at = 0; at < triangles.length; at++) {
      const id = this.idAt(at);
      samples[3 * at] = id & 255;
      samples[3 * at + 1] = (id >> 8) & 255;
      samples[3 * at + 2] = id >> 16;
    }
    return this.#raster(3, samples);
  }

  /** The number of the body at a pixel, counted from 1; 0 is the ground. */
  readonly idAt = (at: number): number => {
    const triangle = this.relief.triangles[at]!;
    if (triangle === 0) return 0;
    this.#bodies ??= bodiesOf(this.#model);
    return this.#bodies[triangle - 1]! + 1;
  };

  /** The height at a pixel in metres. */
  readonly metresAt = (at: number): number => this.#model.unit * Math.max(0, this.relief.heights[at]!);

  /** 255 where there is a body, 0 elsewhere. */
  cover(): Raster {
    return this.#raster(
      1,
      Uint8Array.from(this.relief.heights, (height) => (height === GROUND ? 0 : 255)),
    );
  }

  /** 255 on bodies, from there evenly down to 0 at the distance of the option `contact`. */
  contact(): Raster {
    this.#near ??= nearnessOf(this.relief, this.grid, this.#choices.contact / this.#model.unit);
    return this.#raster(1, this.#near);
  }

  /** Rock, gravel, the foot of both, and open ground, in this order. They sum to 255. */
  splat(): Raster {
    const { triangles } = this.relief;
    const { gravel } = this.#model.ground;
    const { groupOf } = this.#model;
    const { samples: near } = this.contact();
    const samples = new Uint8Array(4 * triangles.length);
    for (let at = 0; at < triangles.length; at++) {
      if (triangles[at] === 0) {
        samples[4 * at + 2] = near[at]!;
        samples[4 * at + 3] = 255 - near[at]!;
      } else samples[4 * at + (gravel[groupOf[this.idAt(at) - 1]!]! ? 1 : 0)] = 255;
    }
    return this.#raster(4, samples);
  }

  #raster(channels: Raster['channels'], samples: Raster['samples']): Raster {
    return { width: this.grid.width, height: this.grid.height, channels, samples };
  }
}

type Vector = [number, number, number];

const UP: Readonly<Vector> = [0, 0, 1];

function byteOf(part: number): number {
  return Math.round(127.5 + 127.5 * part);
}

/** What gives the unit normal of a triangle at a pixel: that of its vertices, as meshes are shaded. It never points down. */
function normalsOf({ positions, normals, indices }: Mapped, { width, perX, perY, left, top, depth }: Grid) {
  const normal: Vector = [0, 0, 1];
  return (triangle: number, at: number): Readonly<Vector> => {
    const column = at % width;
    const x = (column + 0.5 - left) / perX;
    const y = depth - ((at - column) / width + 0.5 - top) / perY;
    const [a, b, c] = [3 * indices[3 * triangle]!, 3 * indices[3 * triangle + 1]!, 3 * indices[3 * triangle + 2]!];
    const [ax, ay] = [positions[a]! - x, positions[a + 1]! - y];
    const [bx, by] = [positions[b]! - x, positions[b + 1]! - y];
    const [cx, cy] = [positions[c]! - x, positions[c + 1]! - y];
    const [wa, wb, wc] = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    // A triangle that is seen from below goes the other way round.
    const way = wa + wb + wc < 0 ? -1 : 1;
    for (let axis = 0; axis < 3; axis++) {
      normal[axis] = way * (wa * normals[a + axis]! + wb * normals[b + axis]! + wc * normals[c + axis]!);
    }
    normal[2] = Math.max(0, normal[2]);
    const length = Math.sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (length === 0) return UP;
    for (let axis = 0; axis < 3; axis++) normal[axis]! /= length;
    return normal;
  };
}
