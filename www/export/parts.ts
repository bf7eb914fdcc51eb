/** A scene in parts that fit together: a grid of files in a ZIP, for programs that take long over one large file, or load what is near. */

import type { Counts } from './gltf/gltf-json.ts';
import { isOneThing, thingsOf } from './model.ts';
import type { Model } from './model.ts';
import { OPTIONS } from './options.ts';

/** A file may be no larger: longer offsets do not fit into GLB, nor such a file into many programs. */
export const MOST_BYTES = 2 ** 31 - 1;
/** A ZIP of parts may be as large as one without 64-bit offsets can be, but for its list of files. */
export const MOST_ZIP = 2 ** 32 - 2 ** 16;
/** With more objects in a file, programs take minutes to open it. */
export const MANY_OBJECTS = 2000;

/** How much smaller a part has to be than what fits before it is offered: none has exactly its share. */
export const SAFE = 0.9;

/** Numbers of parts to choose from: of cells that are as wide as deep in a square field. */
export const PART_NUMBERS: readonly number[] = /* @__PURE__ */ Array.from(
  { length: Math.floor(Math.sqrt(OPTIONS.parts.max)) },
  (_, k) => (k + 1) ** 2,
);

/** The least of these numbers by which a part has no more than `most`, where the largest of `parts` has `value`; undefined if all of them have. */
export function fewestParts(value: number, most: number, parts: number): number | undefined {
  return PART_NUMBERS.find((count) => count > parts && (value * parts) / count <= SAFE * most);
}

/** What is in a cell of the grid. */
export interface Cell {
  /** `x0_y0` in the south-west; x grows eastwards, y northwards. */
  name: string;
  /** In ascending order. */
  bodies: number[];
}

/**
 * Where the things of a model stand, in a grid of so many cells that are as square as can be. Each thing is in one cell, and no cell is empty
 * but that of a model without things.
 */
export function cellsOf(model: Model, count: number): Cell[] {
  const { origins } = model;
  const things = thingsOf(model);
  const [[left, near], [width, depth]] = extentOf(model);
  const columns = columnsOf(count, width, depth);
  const rows = count / columns;
  const cells: Cell[] = Array.from({ length: count }, (_, cell) => ({
    name: `x${cell % columns}_y${Math.floor(cell / columns)}`,
    bodies: [],
  }));
  for (const { bodies } of things) {
    const k = bodies[0]!;
    const x = placeOf(origins[3 * k]! - left, width, columns);
    const y = placeOf(origins[3 * k + 1]! - near, depth, rows);
    cells[columns * y + x]!.bodies.push(...bodies);
  }
  const filled = cells.filter(({ bodies }) => bodies.length > 0);
  for (const { bodies } of filled) bodies.sort((a, b) => a - b);
  return filled.length > 0 ? filled : cells.slice(0, 1);
}

/** In which of so many equal stretches a place is; those outside belong to the outermost. */
function placeOf(at: number, length: number, count: number): number {
  return length > 0 ? Math.min(count - 1, Math.max(0, Math.floor((at * count) / length))) : 0;
}

/** Corner and size of the ground, or of where there are things. */
function extentOf(model: Model): [readonly [number, number], readonly [number, number]] {
  const { ground, groupOf, origins } = model;
  if (ground) return [[0, 0], ground.size];
  const [least, most]: [[number, number], [number, number]] = [
    [Infinity, Infinity],
    [-Infinity, -Infinity],
  ];
  for (let k = 0; k < groupOf.length; k++) {
    if (isOneThing(model, groupOf[k]!)) continue;
    for (const axis of [0, 1] as const) {
      least[axis] = Math.min(least[axis], origins[3 * k + axis]!);
      most[axis] = Math.max(most[axis], origins[3 * k + axis]!);
    }
  }
  return [least, [most[0] - least[0], most[1] - least[1]]];
}

/** The divisor of `count` that makes cells as square as can be; the least of those that are equally good. */
function columnsOf(count: number, width: number, depth: number): number {
  let [best, least] = [1, Infinity];
  for (let columns = 1; columns <= count; columns++) {
    if (count % columns > 0) continue;
    const [along, across] = [width / columns, depth / (count / columns)];
    const lengthwise = along > across ? along / across : across / along;
    if (lengthwise < least) [best, least] = [columns, lengthwise];
  }
  return best;
}

/** What all parts have together. */
export function together(all: readonly Counts[]): Counts {
  const sum = (of: (counts: Counts) => number | undefined): number => all.reduce((total, counts) => total + (of(counts) ?? 0), 0);
  const { levels } = all[0]!;
  return {
    vertices: sum(({ vertices }) => vertices),
    triangles: sum(({ triangles }) => triangles),
    objects: sum(({ objects }) => objects),
    ...(levels && { levels: levels.map((_, level) => sum((counts) => counts.levels?.[level])) }),
    ...(all.some(({ hulls }) => hulls) && {
      hulls: {
        objects: sum(({ hulls }) => hulls?.objects),
        vertices: sum(({ hulls }) => hulls?.vertices),
        triangles: sum(({ hulls }) => hulls?.triangles),
      },
    }),
    nodes: sum(({ nodes }) => nodes),
    meshes: sum(({ meshes }) => meshes),
  };
}
