/** A few rocks of each group that stand for all of them: each rock becomes an instance of the one that is nearest to it in shape. */

import { isOneThing } from '../model.ts';
import type { Model } from '../model.ts';
import { Pace } from '../pace.ts';

/** How a body lies: its principal axis on the ground as a direction, and its extents along that axis, across it and upwards. */
export interface Frame {
  /** Of the angle from x to the principal axis, counter-clockwise from above; −90° … 90°. */
  cos: number;
  sin: number;
  /** Standard deviations of its vertices along and across, and its height, all in units of the model. */
  extents: readonly [number, number, number];
}

export interface Kit {
  /** The bodies whose meshes are written, each once, in order. */
  kinds: Uint32Array;
  /** For each body, the place in `kinds` of the one that stands for it. */
  kindOf: Uint32Array;
  /** For each body. */
  frames: Frame[];
}

/** Passes of Lloyd's algorithm; the shares of the kinds hardly change after that. */
const PASSES = 4;

/** Chooses `count` kinds of each group that is not one thing, at least one of each material, and of the others in proportion. Only + − × ÷ √, so that all engines choose the same. */
export async function kitOf(model: Model, count: number, pace: Pace = new Pace()): Promise<Kit> {
  const bodies = model.groupOf.length;
  const frames: Frame[] = [];
  await pace.within(0, 0.5).each(bodies, (begin, end) => {
    for (let k = begin; k < end; k++) frames.push(frameOf(model, k));
  });
  // Shape without size: an instance is scaled.
  const shapes = frames.map(({ extents: [along, across, height] }) => [across / along, height / along] as const);
  const kinds: number[] = [];
  const kindOf = new Uint32Array(bodies);
  let done = 0;
  for (let group = 0; group < model.groups.length; group++) {
    const members = [...model.groupOf.keys()].filter((k) => model.groupOf[k] === group);
    if (isOneThing(model, group)) {
      for (const k of members) kindOf[k] = kinds.length;
      kinds.push(...members.slice(0, 1));
      continue;
    }
    for (let material = 0; material < model.materials.length; material++) {
      const alike = members.filter((k) => model.materialOf[k] === material);
      if (alike.length === 0) continue;
      const own = pace.within(0.5 + done / bodies / 2, 0.5 + (done + alike.length) / bodies / 2);
      done += alike.length;
      const wanted = Math.max(1, Math.floor((count * alike.length) / members.length));
      const chosen = await mediansOf(alike, shapes, wanted, own.within(0, 0.8));
      const first = kinds.length;
      kinds.push(...chosen);
      await own.within(0.8, 1).each(alike.length, (begin, end) => {
        for (let m = begin; m < end; m++) {
          const k = alike[m]!;
          kindOf[k] = first + nearest(shapes[k]!, chosen, (kind) => shapes[kind]!);
        }
      });
    }
  }
  return { kinds: Uint32Array.from(kinds), kindOf, frames };
}

type Shape = readonly [number, number];

/** The members nearest to the middles of `count` clusters, in ascending order. */
async function mediansOf(members: readonly number[], shapes: readonly Shape[], count: number, pace: Pace): Promise<number[]> {
  if (members.length <= count) return [...members];
  let middles = (await farthestFirst(members, shapes, count, pace.within(0, 1 / (PASSES + 1)))).map((k) => shapes[k]!);
  for (let pass = 1; pass <= PASSES; pass++) {
    const sums = middles.map(() => [0, 0, 0] as [number, number, number]);
    await pace.within(pass / (PASSES + 1), (pass + 1) / (PASSES + 1)).each(members.length, (begin, end) => {
      for (let m = begin; m < end; m++) {
        const shape = shapes[members[m]!]!;
        const sum = sums[nearest(shape, middles)]!;
        sum[0] += shape[0];
        sum[1] += shape[1];
        sum[2] += 1;
      }
    });
    middles = middles.map((middle, c) => (sums[c]![2] > 0 ? [sums[c]![0] / sums[c]![2], sums[c]![1] / sums[c]![2]] : middle));
  }
  const closest = middles.map((middle) => members[nearest(middle, members, (k) => shapes[k]!)]!);
  return [...new Set(closest)].sort((a, b) => a - b);
}

/** Gonzalez' choice: each is the one farthest from all before. */
async function farthestFirst(members: readonly number[], shapes: readonly Shape[], count: number, pace: Pace): Promise<number[]> {
  const chosen = [members[0]!];
  const apart = members.map(() => Infinity);
  while (chosen.length < count) {
    const last = shapes[chosen.at(-1)!]!;
    let far = 0;
    for (let m = 0; m < members.length; m++) {
      apart[m] = Math.min(apart[m]!, distance(shapes[members[m]!]!, last));
      if (apart[m]! > apart[far]!) far = m;
    }
    chosen.push(members[far]!);
    if (pace.isDue()) await pace.rest(chosen.length / count);
  }
  return chosen;
}

function nearest(shape: Shape, among: readonly Shape[]): number;
function nearest<T>(shape: Shape, among: readonly T[], shapeOf: (one: T) => Shape): number;
function nearest<T>(shape: Shape, among: readonly T[], shapeOf = (one: T) => one as unknown as Shape): number {
  let best = 0;
  let least = Infinity;
  for (let c = 0; c < among.length; c++) {
    const far = distance(shape, shapeOf(among[c]!));
    if (far < least) [best, least] = [c, far];
  }
  return best;
}

function distance(a: Shape, b: Shape): number {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

/** From the second moments of the body's vertices about its origin. */
function frameOf({ positions, vertexStarts, origins }: Model, k: number): Frame {
  const [first, last] = [vertexStarts[k]!, vertexStarts[k + 1]!];
  const [x, y, z] = [origins[3 * k]!, origins[3 * k + 1]!, origins[3 * k + 2]!];
  let [xx, xy, yy, height] = [0, 0, 0, 0];
  for (let v = 3 * first; v < 3 * last; v += 3) {
    const [dx, dy] = [positions[v]! - x, positions[v + 1]! - y];
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    height = Math.max(height, positions[v + 2]! - z);
  }
  const spread = Math.sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
  const cosTwice = spread > 0 ? (xx - yy) / spread : 1;
  const cos = Math.sqrt(Math.max(0, (1 + cosTwice) / 2));
  const sin = Math.sqrt(Math.max(0, (1 - cosTwice) / 2)) * (xy < 0 ? -1 : 1);
  const count = last - first;
  const along = Math.sqrt((xx + yy + spread) / 2 / count);
  const across = Math.sqrt(Math.max(0, (xx + yy - spread) / 2 / count));
  // Of a body without extent there is nothing to scale.
  return { cos, sin, extents: [along || 1, across || 1, height || 1] };
}
