/** Tangents as MikkTSpace computes them (Mikkelsen, Simulation of wrinkled surfaces revisited, 2008), since some programs do it anew. */

/**
 * Unit vectors at right angles to the normals that point to where x of the places grows: three numbers for each vertex.
 *
 * @param places x and y of each vertex, y up, in which triangles are counter-clockwise.
 */
export function tangentsOf(points: Float32Array, normals: Float32Array, indices: Uint32Array, places: Float32Array): Float32Array {
  const tangents = new Float32Array(points.length);
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [indices[t]!, indices[t + 1]!, indices[t + 2]!] as const;
    const [a, b, c] = corners;
    const [toB, toC] = [between(points, a, b), between(points, a, c)];
    const [bt, ct] = [places[2 * b + 1]! - places[2 * a + 1]!, places[2 * c + 1]! - places[2 * a + 1]!];
    const along: Vector = [toB[0] * ct - toC[0] * bt, toB[1] * ct - toC[1] * bt, toB[2] * ct - toC[2] * bt];
    for (let corner = 0; corner < 3; corner++) {
      const [own, next, last] = [corners[corner]!, corners[(corner + 1) % 3]!, corners[(corner + 2) % 3]!];
      const normal: Vector = [normals[3 * own]!, normals[3 * own + 1]!, normals[3 * own + 2]!];
      const tangent = flattened(along, normal);
      const angle = angleOf(flattened(between(points, own, next), normal), flattened(between(points, own, last), normal));
      for (let axis = 0; axis < 3; axis++) tangents[3 * own + axis]! += angle * tangent[axis]!;
    }
  }
  for (let v = 0; v < tangents.length; v += 3) {
    const normal: Vector = [normals[v]!, normals[v + 1]!, normals[v + 2]!];
    const tangent = flattened([tangents[v]!, tangents[v + 1]!, tangents[v + 2]!], normal);
    // Where triangles have no area any direction will do.
    const isNone = tangent[0] === 0 && tangent[1] === 0 && tangent[2] === 0;
    tangents.set(isNone ? flattened(normal[0] * normal[0] < 0.5 ? [1, 0, 0] : [0, 1, 0], normal) : tangent, v);
  }
  return tangents;
}

type Vector = [number, number, number];

function between(points: Float32Array, a: number, b: number): Vector {
  return [points[3 * b]! - points[3 * a]!, points[3 * b + 1]! - points[3 * a + 1]!, points[3 * b + 2]! - points[3 * a + 2]!];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The part of it at right angles to the normal, of length 1; (0, 0, 0) where there is none. */
function flattened(vector: Vector, normal: Vector): Vector {
  const along = dot(vector, normal);
  const flat: Vector = [vector[0] - along * normal[0], vector[1] - along * normal[1], vector[2] - along * normal[2]];
  const length = Math.sqrt(dot(flat, flat));
  return length > 0 ? [flat[0] / length, flat[1] / length, flat[2] / length] : [0, 0, 0];
}

/** Between unit vectors, radians; to 0.0001, with nothing that engines round differently (Abramowitz and Stegun, 4.4.45). */
function angleOf(a: Vector, b: Vector): number {
  const cos = Math.min(1, Math.max(-1, dot(a, b)));
  const x = Math.abs(cos);
  const angle = Math.sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.074261 - x * 0.0187293)));
  return cos < 0 ? Math.PI - angle : angle;
}
