/** Rocks closed from below. */

import type { Model } from '../model.ts';

/**
 * How many vertices the rim of a body has. They are its first ones, counter-clockwise from above.
 *
 * A body is a disc: with V vertices, E edges and F triangles V − E + F = 1, and every edge but those of the rim has two triangles, so
 * that 3F = 2E − rim.
 */
export function rimOf(vertices: number, triangles: number): number {
  return 2 * vertices - triangles - 2;
}

/** The model with a bottom under each body that is open below: a fan from the middle of its rim, with vertices of its own, whose normals point down. */
export function closed(model: Model): Model {
  const { positions, normals, indices, indexStarts, vertexStarts, origins } = model;
  const bodies = model.groupOf.length;
  const rims = Uint32Array.from(model.groupOf, (group, k) =>
    model.groups[group]!.isOpenBelow ? rimOf(vertexStarts[k + 1]! - vertexStarts[k]!, (indexStarts[k + 1]! - indexStarts[k]!) / 3) : 0,
  );
  const rimVertices = rims.reduce((sum, rim) => sum + rim, 0);
  const bottoms = rims.filter((rim) => rim > 0).length;
  const solid = {
    positions: new Float32Array(positions.length + 3 * (rimVertices + bottoms)),
    normals: new Float32Array(normals.length + 3 * (rimVertices + bottoms)),
    indices: new Uint32Array(indices.length + 3 * rimVertices),
    indexStarts: new Uint32Array(bodies + 1),
    vertexStarts: new Uint32Array(bodies + 1),
  };
  let [vertex, index] = [0, 0];
  for (let k = 0; k < bodies; k++) {
    const [first, last, rim] = [vertexStarts[k]!, vertexStarts[k + 1]!, rims[k]!];
    solid.vertexStarts[k] = vertex;
    solid.indexStarts[k] = index;
    for (const name of ['positions', 'normals'] as const) solid[name].set(model[name].subarray(3 * first, 3 * last), 3 * vertex);
    for (let i = indexStarts[k]!; i < indexStarts[k + 1]!; i++) solid.indices[index++] = indices[i]! - first + vertex;
    const bottom = vertex + last - first;
    vertex = bottom;
    if (rim === 0) continue;
    solid.positions.set(positions.subarray(3 * first, 3 * (first + rim)), 3 * bottom);
    const middle = bottom + rim;
    let depth = 0;
    for (let v = 0; v < rim; v++) depth += positions[3 * (first + v) + 2]!;
    solid.positions.set([origins[3 * k]!, origins[3 * k + 1]!, depth / rim], 3 * middle);
    for (let v = bottom; v <= middle; v++) solid.normals[3 * v + 2] = -1;
    for (let v = 0; v < rim; v++) {
      solid.indices[index++] = middle;
      solid.indices[index++] = bottom + ((v + 1) % rim);
      solid.indices[index++] = bottom + v;
    }
    vertex = middle + 1;
  }
  solid.vertexStarts[bodies] = vertex;
  solid.indexStarts[bodies] = index;
  return { ...model, ...solid };
}
