/** Where a log touches the ground, or comes so near to it that no rock fits under it. */

import type { WoodEarLog } from '../data/colony.ts';

/**
 * The triangles of the log that are lower than `clearance` above the ground, from above: six numbers each, px.
 *
 * `place`: the log's origin on the ground in px, and px per cm.
 */
export function footprintOf(
  { positions, indices }: WoodEarLog,
  [x, y, z, scale]: readonly [number, number, number, number],
  clearance: number,
): Float64Array {
  const triangles: number[] = [];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const corners = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    if (corners.every((corner) => z + scale * positions[corner + 2]! > clearance)) continue;
    const [ax, ay, bx, by, cx, cy] = corners.flatMap((corner) => [x + scale * positions[corner]!, y + scale * positions[corner + 1]!]) as [
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    // Those that stand upright cover nothing.
    if ((bx - ax) * (cy - ay) !== (by - ay) * (cx - ax)) triangles.push(ax, ay, bx, by, cx, cy);
  }
  return Float64Array.from(triangles);
}
