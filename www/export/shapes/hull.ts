/** Convex hulls of few vertices. Only + − × ÷ √, so that all engines find the same. */

type Point = readonly [number, number, number];

export interface Hull {
  /** Which of the points are its corners. */
  corners: number[];
  /** Three places in `corners` for each triangle, counter-clockwise from outside. */
  triangles: number[];
}

interface Face {
  /** Numbers of points. */
  corners: [number, number, number];
  normal: Point;
  offset: number;
}

/** Points nearer than this to a face are on it, as a share of the extent of all. */
const THIN = 1e-6;

/**
 * The hull of points, or of those among them that stand out most: beginning with a tetrahedron, the point that is farthest outside becomes
 * a corner, until there are `most` or none is farther out than `margin`.
 *
 * @param points x, y, z of each.
 * @param margin as a share of their extent.
 * @returns undefined where all points are in a plane.
 */
export function hullOf(points: ArrayLike<number>, most: number, margin: number): Hull | undefined {
  const builder = new Builder(points);
  const simplex = builder.simplex();
  if (!simplex) return undefined;
  builder.begin(simplex);
  const nearest = Math.max(margin, THIN) * builder.extent;
  for (let corners = 4; corners < most; corners++) {
    const point = builder.farthest();
    if (point === undefined || builder.heights[point]! <= nearest) break;
    builder.grow(point);
  }
  return builder.hull();
}

/** Over which a point is that may turn out to be inside. */
const HIDDEN: Face = { corners: [0, 0, 0], normal: [0, 0, 0], offset: 0 };

class Builder {
  #points: ArrayLike<number>;
  #count: number;
  #faces: Face[] = [];
  /** For each point how far it stands out, at least, and over which face; those inside have height 0. */
  readonly heights: Float64Array;
  #over: (Face | undefined)[];
  readonly extent: number;

  constructor(points: ArrayLike<number>) {
    this.#points = points;
    this.#count = points.length / 3;
    this.heights = new Float64Array(this.#count);
    this.#over = Array.from({ length: this.#count });
    let extent = 0;
    for (let axis = 0; axis < 3; axis++) {
      let [least, greatest] = [Infinity, -Infinity];
      for (let k = axis; k < points.length; k += 3) {
        least = Math.min(least, points[k]!);
        greatest = Math.max(greatest, points[k]!);
      }
      extent = Math.max(extent, greatest - least);
    }
    this.extent = extent;
  }

  #at(k: number): Point {
    const p = this.#points;
    return [p[3 * k]!, p[3 * k + 1]!, p[3 * k + 2]!];
  }

  /** The point for which this is greatest. */
  #most(measure: (point: Point) => number): number {
    let [best, most] = [0, -Infinity];
    for (let k = 0; k < this.#count; k++) {
      const value = measure(this.#at(k));
      if (value > most) [best, most] = [k, value];
    }
    return best;
  }

  /** Four points far apart, the fourth behind the triangle of the others; undefined where there are none. */
  simplex(): [number, number, number, number] | undefined {
    if (this.#count < 4) return undefined;
    const thin = THIN * this.extent;
    const a = this.#most(([x]) => -x);
    const pa = this.#at(a);
    const b = this.#most((p) => squared(minus(p, pa)));
    const along = minus(this.#at(b), pa);
    const c = this.#most((p) => squared(cross(along, minus(p, pa))));
    const across = cross(along, minus(this.#at(c), pa));
    const length = Math.sqrt(squared(across));
    if (!(length > thin * Math.sqrt(squared(along)))) return undefined;
    const d = this.#most((p) => Math.abs(dot(across, minus(p, pa))));
    const height = dot(across, minus(this.#at(d), pa)) / length;
    if (!(Math.abs(height) > thin)) return undefined;
    return height < 0 ? [a, b, c, d] : [a, c, b, d];
  }

  begin([a, b, c, d]: [number, number, number, number]): void {
    this.#add([
      [a, b, c],
      [a, d, b],
      [b, d, c],
      [c, d, a],
    ]);
  }

  /** The point that stands out farthest; undefined where none does. */
  farthest(): number | undefined {
    let best: number | undefined;
    for (let k = 0; k < this.#count; k++) if (this.#over[k] && (best === undefined || this.heights[k]! > this.heights[best]!)) best = k;
    return best;
  }

  /** Makes a point that stands out a corner: the faces that it sees give way to a cone from their rim to it. */
  grow(eye: number): void {
    const point = this.#at(eye);
    const thin = THIN * this.extent;
    const seen = new Set([this.#over[eye]!]);
    const faceAt = new Map<number, Face>();
    for (const face of this.#faces) for (const [from, to] of edgesOf(face.corners)) faceAt.set(from * this.#count + to, face);
    const beyond = (from: number, to: number): Face => faceAt.get(to * this.#count + from)!;
    // Only those that hang together, so that there is one rim, whatever rounding says of faces far away.
    for (const face of seen) {
      for (const [from, to] of edgesOf(face.corners)) if (heightOver(beyond(from, to), point) > thin) seen.add(beyond(from, to));
    }
    const rim = [...seen].flatMap(({ corners }) => edgesOf(corners).filter(([from, to]) => !seen.has(beyond(from, to))));
    this.#faces = this.#faces.filter((face) => !seen.has(face));
    for (let k = 0; k < this.#count; k++) {
      if (this.#over[k] && seen.has(this.#over[k]!)) {
        [this.#over[k], this.heights[k]] = [undefined, 0];
        if (k !== eye) for (const face of this.#faces) this.#raise(k, face);
        // Over no face that is left: it may be over one of those that come.
        this.#over[k] ??= HIDDEN;
      }
    }
    this.#over[eye] = undefined;
    this.#add(rim.map(([from, to]) => [from, to, eye]));
  }

  #raise(k: number, face: Face): void {
    const points = this.#points;
    const [x, y, z] = face.normal;
    const height = x * points[3 * k]! + y * points[3 * k + 1]! + z * points[3 * k + 2]! - face.offset;
    if (height > THIN * this.extent && height > this.heights[k]!) [this.heights[k], this.#over[k]] = [height, face];
  }

  #add(triangles: [number, number, number][]): void {
    const isFirst = this.#faces.length === 0;
    for (const corners of triangles) {
      const [a, b, c] = corners.map((k) => this.#at(k)) as [Point, Point, Point];
      const [x, y, z] = cross(minus(b, a), minus(c, a));
      const length = Math.sqrt(x * x + y * y + z * z) || 1;
      const normal: Point = [x / length, y / length, z / length];
      const face = { corners, normal, offset: dot(normal, a) };
      this.#faces.push(face);
      for (let k = 0; k < this.#count; k++) if (isFirst || this.#over[k]) this.#raise(k, face);
    }
    for (let k = 0; k < this.#count; k++) if (this.#over[k] === HIDDEN) this.#over[k] = undefined;
  }

  hull(): Hull {
    const places = new Map<number, number>();
    const triangles = this.#faces.flatMap(({ corners }) =>
      corners.map((k) => {
        if (!places.has(k)) places.set(k, places.size);
        return places.get(k)!;
      }),
    );
    return { corners: [...places.keys()], triangles };
  }
}

function edgesOf([a, b, c]: Face['corners']): [number, number][] {
  return [
    [a, b],
    [b, c],
    [c, a],
  ];
}

function heightOver({ normal, offset }: Face, point: Point): number {
  return dot(normal, point) - offset;
}

function minus(a: Point, b: Point): Point {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a: Point, b: Point): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function squared(a: Point): number {
  return dot(a, a);
}

function cross([ux, uy, uz]: Point, [vx, vy, vz]: Point): Point {
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}
