/** Some bodies of a model as a model. */

import { numbersOf } from '../model.ts';
import type { Model } from '../model.ts';

/**
 * The model of these bodies alone, with the same middle. Its things have the numbers that they have in the whole, and so the same names.
 *
 * @param bodies in ascending order; all of those of a thing.
 */
export function someOf(model: Model, bodies: readonly number[]): Model {
  const { positions, normals, indices, vertexStarts, indexStarts, origins } = model;
  const [newVertices, newIndices] = [startsOf(vertexStarts, bodies), startsOf(indexStarts, bodies)];
  const some = {
    positions: new Float32Array(3 * newVertices.at(-1)!),
    normals: new Float32Array(3 * newVertices.at(-1)!),
    indices: new Uint32Array(newIndices.at(-1)!),
    origins: new Float64Array(3 * bodies.length),
  };
  bodies.forEach((k, at) => {
    const [first, last, vertex] = [vertexStarts[k]!, vertexStarts[k + 1]!, newVertices[at]!];
    some.positions.set(positions.subarray(3 * first, 3 * last), 3 * vertex);
    some.normals.set(normals.subarray(3 * first, 3 * last), 3 * vertex);
    some.origins.set(origins.subarray(3 * k, 3 * k + 3), 3 * at);
    let index = newIndices[at]!;
    for (let i = indexStarts[k]!; i < indexStarts[k + 1]!; i++) some.indices[index++] = indices[i]! - first + vertex;
  });
  const numbers = numbersOf(model);
  const of = (list: Uint8Array): Uint8Array => Uint8Array.from(bodies, (k) => list[k]!);
  return {
    ...model,
    ...some,
    vertexStarts: newVertices,
    indexStarts: newIndices,
    groupOf: of(model.groupOf),
    materialOf: of(model.materialOf),
    numbers: Uint32Array.from(bodies, (k) => numbers[k]!),
  };
}

function startsOf(starts: Uint32Array, bodies: readonly number[]): Uint32Array {
  const own = new Uint32Array(bodies.length + 1);
  bodies.forEach((k, at) => (own[at + 1] = own[at]! + starts[k + 1]! - starts[k]!));
  return own;
}
