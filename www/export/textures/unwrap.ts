/**
 * A rock's surface laid flat: the body, which is a disc, becomes a patch of the plane in which no two triangles overlap.
 *
 * The rim becomes a convex outline, and every other vertex a weighted mean of its neighbours: with positive weights no triangle can turn over
 * (Tutte, How to draw a graph, 1963). The weights begin as mean values (Floater, 2003) and are then divided by the stretch around the neighbour,
 * which keeps them positive and makes areas alike (Yoshizawa et al., A fast and simple stretch-minimizing mesh parameterization, 2004).
 */

/** A disc: its first vertices are its rim, counter-clockwise from outside. */
export interface Disc {
  /** x, y, z of each vertex. */
  points: Float64Array;
  /** Counter-clockwise from outside. */
  triangles: Uint32Array;
  rim: number;
}

/** The disc, as large as it is in space, with its lower left corner at (0, 0). */
export interface Patch {
  /** x and y of each vertex; triangles are counter-clockwise. */
  places: Float64Array;
  width: number;
  height: number;
}

/** Steps towards even areas; more change nothing that could be seen. */
const STEPS = 3;
/** Of the outline, whose size is about 1, how exactly a vertex has to be in its place. */
const EXACT = 1e-5;
/** Nothing within it has that far to go. */
const AWAY = 10;
const SWEEPS = 3000;
/** A longer outline would waste the atlas. */
const LONGEST = 2.5;

export function unwrapped(disc: Disc): Patch {
  const places = outline(disc);
  const weights = meanValues(disc);
  settle(disc, weights, places);
  if (isTurned(disc, places)) {
    // A sliver whose weights are beyond all measure: equal ones do as well, and always.
    weights.values.fill(1);
    settle(disc, weights, places);
  }
  let stretch = stretches(disc, places);
  for (let step = 0; step < STEPS; step++) {
    const next = places.slice();
    weights.values.forEach((weight, w) => (weights.values[w] = weight / stretch.around[weights.neighbours[w]!]!));
    settle(disc, weights, next);
    const found = stretches(disc, next);
    if (!(found.whole < stretch.whole) || isTurned(disc, next)) break;
    places.set(next);
    stretch = found;
  }
  return framed(places, Math.sqrt(stretch.area / flatArea(disc, places)));
}

/** The rim on an ellipse as long as the rim is, x along; the other vertices where they are seen from above, within. */
function outline({ points, rim }: Disc): Float64Array {
  const count = points.length / 3;
  const places = new Float64Array(2 * count);
  const [x, y, along, across, cos, sin] = axes(points, rim);
  const ratio = Math.sqrt(Math.min(along / across, LONGEST));
  for (let v = 0; v < count; v++) {
    const [dx, dy] = [points[3 * v]! - x, points[3 * v + 1]! - y];
    const [u, w] = [(cos * dx + sin * dy) / along, (cos * dy - sin * dx) / across];
    const length = Math.sqrt(u * u + w * w);
    // Of the others it is only the first guess.
    const scale = v < rim ? 1 / length : 0.5 / Math.max(1, length);
    places[2 * v] = u * scale;
    places[2 * v + 1] = w * scale;
  }
  if (!turnsOnce(places, rim)) evenly(places, rim);
  for (let v = 0; v < count; v++) {
    places[2 * v]! *= ratio;
    places[2 * v + 1]! /= ratio;
  }
  return places;
}

/** Middle of the rim, seen from above, its extents along its main axis and across, and that axis; each edge counts with its length. */
function axes(points: Float64Array, rim: number): [x: number, y: number, along: number, across: number, cos: number, sin: number] {
  let [sum, x, y] = [0, 0, 0];
  const edges = Array.from({ length: rim }, (_, v) => {
    const [a, b] = [3 * v, 3 * ((v + 1) % rim)];
    const [dx, dy] = [points[b]! - points[a]!, points[b + 1]! - points[a + 1]!];
    const edge = { x: (points[a]! + points[b]!) / 2, y: (points[a + 1]! + points[b + 1]!) / 2, length: Math.sqrt(dx * dx + dy * dy) };
    sum += edge.length;
    x += edge.x * edge.length;
    y += edge.y * edge.length;
    return edge;
  });
  [x, y] = [x / sum, y / sum];
  let [xx, xy, yy] = [0, 0, 0];
  for (const edge of edges) {
    const [dx, dy] = [edge.x - x, edge.y - y];
    xx += (edge.length * dx * dx) / sum;
    xy += (edge.length * dx * dy) / sum;
    yy += (edge.length * dy * dy) / sum;
  }
  const spread = Math.sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
  const cosTwice = spread > 0 ? (xx - yy) / spread : 1;
  const cos = Math.sqrt(Math.max(0, (1 + cosTwice) / 2));
  const sin = Math.sqrt(Math.max(0, (1 - cosTwice) / 2)) * (xy < 0 ? -1 : 1);
  const along = Math.sqrt(Math.max((xx + yy + spread) / 2, 1e-12));
  const across = Math.sqrt(Math.max((xx + yy - spread) / 2, 1e-6 * along * along));
  return [x, y, along, across, cos, sin];
}

/** Whether the rim goes round the middle once, always the same way, as it does where the rim is star-shaped. */
function turnsOnce(places: Float64Array, rim: number): boolean {
  let quarters = 0;
  for (let v = 0; v < rim; v++) {
    const [a, b] = [2 * v, 2 * ((v + 1) % rim)];
    const [ax, ay, bx, by] = [places[a]!, places[a + 1]!, places[b]!, places[b + 1]!];
    if (!(ax * by - ay * bx > 1e-6)) return false;
    // Each time round, the upper half is entered once.
    if (ay < 0 && by >= 0) quarters += 1;
  }
  return quarters === 1;
}

/** Puts the rim on the circle, evenly along the sides of a square. */
function evenly(places: Float64Array, rim: number): void {
  for (let v = 0; v < rim; v++) {
    const side = (4 * v) / rim;
    const along = 2 * (side - Math.floor(side)) - 1;
    const [x, y] = [
      [1, along],
      [-along, 1],
      [-1, -along],
      [along, -1],
    ][Math.floor(side)]!;
    const length = Math.sqrt(x! * x! + y! * y!);
    places[2 * v] = x! / length;
    places[2 * v + 1] = y! / length;
  }
}

/** For each vertex its neighbours, one for every triangle that it shares with them, and how much each counts. */
interface Weights {
  starts: Uint32Array;
  neighbours: Uint32Array;
  values: Float64Array;
}

function meanValues({ points, triangles }: Disc): Weights {
  const count = points.length / 3;
  const starts = new Uint32Array(count + 1);
  for (const vertex of triangles) starts[vertex + 1]! += 2;
  for (let v = 0; v < count; v++) starts[v + 1]! += starts[v]!;
  const ends = starts.slice();
  const neighbours = new Uint32Array(starts[count]!);
  const values = new Float64Array(starts[count]!);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const own = triangles[t + corner]!;
      const [b, c] = [triangles[t + ((corner + 1) % 3)]!, triangles[t + ((corner + 2) % 3)]!];
      const [toB, toC, half] = cornerOf(points, own, b, c);
      for (const [neighbour, length] of [
        [b, toB],
        [c, toC],
      ] as const) {
        const at = ends[own]!;
        ends[own] = at + 1;
        neighbours[at] = neighbour;
        values[at] = half / length;
      }
    }
  }
  return { starts, neighbours, values };
}

/** Lengths of the edges at a corner, and the tangent of half its angle; none is 0, nor is the last beyond all measure. */
function cornerOf(points: Float64Array, own: number, b: number, c: number): [toB: number, toC: number, half: number] {
  const at = (vertex: number, axis: number): number => points[3 * vertex + axis]! - points[3 * own + axis]!;
  let [bb, cc, bc] = [0, 0, 0];
  for (let axis = 0; axis < 3; axis++) {
    bb += at(b, axis) * at(b, axis);
    cc += at(c, axis) * at(c, axis);
    bc += at(b, axis) * at(c, axis);
  }
  const [toB, toC] = [Math.max(Math.sqrt(bb), 1e-6), Math.max(Math.sqrt(cc), 1e-6)];
  const cos = Math.min(1, Math.max(-1, bc / (toB * toC)));
  return [toB, toC, Math.min(1e3, Math.max(1e-3, Math.sqrt((1 - cos) / Math.max(1 + cos, 1e-9))))];
}

/** Moves every vertex within the rim to the mean of its neighbours (successive over-relaxation). */
function settle({ points, rim }: Disc, { starts, neighbours, values }: Weights, places: Float64Array): void {
  const count = points.length / 3;
  const begun = places.slice();
  // The best for a grid of so many vertices. The weights are not symmetric, so that it may lead away; the mean itself never does.
  let beyond = 2 / (1 + 3 / (2 + Math.sqrt(count - rim)));
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    let moved = 0;
    for (let v = rim; v < count; v++) {
      let [sum, x, y] = [0, 0, 0];
      for (let w = starts[v]!; w < starts[v + 1]!; w++) {
        const weight = values[w]!;
        sum += weight;
        x += weight * places[2 * neighbours[w]!]!;
        y += weight * places[2 * neighbours[w]! + 1]!;
      }
      const [dx, dy] = [beyond * (x / sum - places[2 * v]!), beyond * (y / sum - places[2 * v + 1]!)];
      places[2 * v]! += dx;
      places[2 * v + 1]! += dy;
      moved = Math.max(moved, Math.abs(dx), Math.abs(dy));
    }
    if (moved < EXACT) return;
    if (beyond > 1 && (!(moved < AWAY) || sweep === SWEEPS / 2)) {
      beyond = 1;
      places.set(begun);
    }
  }
}

/** How much longer the disc is in space than in the plane (Sander et al., Texture mapping progressive meshes, 2001): the whole of it, and around each vertex. */
function stretches({ points, triangles }: Disc, places: Float64Array): { whole: number; around: Float64Array; area: number } {
  const around = new Float64Array(points.length / 3);
  const areas = new Float64Array(points.length / 3);
  let [area, flat, sum] = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!];
    const twice = twiceFlat(places, a, b, c);
    const [bs, bt] = [places[2 * b]! - places[2 * a]!, places[2 * b + 1]! - places[2 * a + 1]!];
    const [cs, ct] = [places[2 * c]! - places[2 * a]!, places[2 * c + 1]! - places[2 * a + 1]!];
    let [squares, bb, bc, cc] = [0, 0, 0, 0];
    for (let axis = 0; axis < 3; axis++) {
      const [toB, toC] = [points[3 * b + axis]! - points[3 * a + axis]!, points[3 * c + axis]! - points[3 * a + axis]!];
      const [alongS, alongT] = [(toB * ct - toC * bt) / twice, (toC * bs - toB * cs) / twice];
      squares += alongS * alongS + alongT * alongT;
      bb += toB * toB;
      bc += toB * toC;
      cc += toC * toC;
    }
    const own = Math.sqrt(Math.max(0, bb * cc - bc * bc)) / 2;
    area += own;
    flat += twice / 2;
    const share = (own * squares) / 2;
    sum += share;
    for (const vertex of [a, b, c]) {
      around[vertex]! += share;
      areas[vertex]! += own;
    }
  }
  for (let v = 0; v < around.length; v++) around[v] = areas[v]! > 0 ? Math.sqrt(around[v]! / areas[v]!) : 1;
  // 1 where nothing is stretched, whatever the outline's size.
  return { whole: Math.sqrt((sum / area) * (flat / area)), around, area };
}

function twiceFlat(places: Float64Array, a: number, b: number, c: number): number {
  const [ax, ay] = [places[2 * a]!, places[2 * a + 1]!];
  return (places[2 * b]! - ax) * (places[2 * c + 1]! - ay) - (places[2 * c]! - ax) * (places[2 * b + 1]! - ay);
}

function isTurned({ triangles }: Disc, places: Float64Array): boolean {
  for (let t = 0; t < triangles.length; t += 3) {
    if (!(twiceFlat(places, triangles[t]!, triangles[t + 1]!, triangles[t + 2]!) > 0)) return true;
  }
  return false;
}

function flatArea({ triangles }: Disc, places: Float64Array): number {
  let twice = 0;
  for (let t = 0; t < triangles.length; t += 3) twice += twiceFlat(places, triangles[t]!, triangles[t + 1]!, triangles[t + 2]!);
  return twice / 2;
}

/** So many times as large, with the lower left corner at (0, 0). */
function framed(places: Float64Array, scale: number): Patch {
  let [left, low, right, high] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let v = 0; v < places.length; v += 2) {
    left = Math.min(left, places[v]!);
    right = Math.max(right, places[v]!);
    low = Math.min(low, places[v + 1]!);
    high = Math.max(high, places[v + 1]!);
  }
  for (let v = 0; v < places.length; v += 2) {
    places[v] = scale * (places[v]! - left);
    places[v + 1] = scale * (places[v + 1]! - low);
  }
  return { places, width: scale * (right - left), height: scale * (high - low) };
}
