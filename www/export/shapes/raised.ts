/** What a simplifier leaves flat is raised again. */

/** More than any vertex of a body has as its number. */
const MANY = 2 ** 26;

/**
 * Turns edges until every triangle reaches a vertex that is not on the rim. A triangle with three corners on the rim lies on the ground,
 * and the body above it is gone.
 *
 * There are as many triangles as before, over the same rim. One vertex inside becomes the tip of a pyramid.
 *
 * @param indices of one body, which is a disc; changed in place.
 * @param rim how many vertices its rim has. They are its first ones.
 * @param positions x, y, z of its vertices.
 */
export function raise(indices: Uint32Array, rim: number, positions: Float32Array): void {
  let flat: number[] = [];
  for (let i = 0; i < indices.length; i += 3) if (isFlat(indices, rim, i)) flat.push(i);
  if (flat.length === 0) return;
  const corners = new Map<number, number>();
  const enter = (triangle: number): void => {
    for (let i = triangle; i < triangle + 3; i++) corners.set(edgeAt(indices, i), i);
  };
  for (let i = 0; i < indices.length; i += 3) enter(i);
  // A triangle in the middle of others that are flat has its turn when one beside it has been raised.
  for (let before = Infinity; flat.length < before; ) {
    before = flat.length;
    flat = flat.filter((triangle) => {
      const found = bestTurn(indices, rim, positions, corners, triangle);
      if (!found) return true;
      const { a, b, c, d, other } = found;
      corners.delete(a * MANY + b);
      corners.delete(b * MANY + a);
      indices.set([a, d, c], triangle);
      indices.set([d, b, c], other);
      enter(triangle);
      enter(other);
      return false;
    });
  }
}

/** The edge from a to b of the flat triangle a, b, c gives way to one from c to the vertex d beyond it. */
interface Turn {
  a: number;
  b: number;
  c: number;
  d: number;
  /** Where the triangle beyond the edge begins. */
  other: number;
}

/** The turn after which the smaller of the two triangles is the largest, seen from above: it folds nothing over if that can be helped. */
function bestTurn(
  indices: Uint32Array,
  rim: number,
  positions: Float32Array,
  corners: ReadonlyMap<number, number>,
  triangle: number,
): Turn | undefined {
  let best: Turn | undefined;
  let most = -Infinity;
  for (let i = triangle; i < triangle + 3; i++) {
    const [a, b, c] = [indices[i]!, indices[after(i)]!, indices[after(after(i))]!];
    const beyond = corners.get(b * MANY + a);
    if (beyond === undefined) continue;
    const d = indices[after(after(beyond))]!;
    if (d < rim || corners.has(c * MANY + d) || corners.has(d * MANY + c)) continue;
    const smaller = Math.min(areaOf(positions, a, d, c), areaOf(positions, d, b, c));
    if (smaller <= most) continue;
    most = smaller;
    best = { a, b, c, d, other: beyond - (beyond % 3) };
  }
  return best;
}

function isFlat(indices: Uint32Array, rim: number, i: number): boolean {
  return indices[i]! < rim && indices[i + 1]! < rim && indices[i + 2]! < rim;
}

/** The next corner of the same triangle. */
function after(i: number): number {
  return i % 3 === 2 ? i - 2 : i + 1;
}

function edgeAt(indices: Uint32Array, i: number): number {
  return indices[i]! * MANY + indices[after(i)]!;
}

/** Twice the area of a triangle seen from above, negative if it faces down. */
function areaOf(positions: Float32Array, a: number, b: number, c: number): number {
  const x = positions[3 * a]!;
  const y = positions[3 * a + 1]!;
  return (positions[3 * b]! - x) * (positions[3 * c + 1]! - y) - (positions[3 * c]! - x) * (positions[3 * b + 1]! - y);
}
