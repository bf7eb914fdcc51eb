/** Two models as one. */

import type { Model } from '../model.ts';

/** The bodies of `first`, then those of `second` moved by `shift`. Unit and middle are the first one's. */
export function joined(first: Model, second: Model, shift: readonly [number, number, number]): Model {
  const vertices = first.positions.length / 3;
  const moved = <List extends Float32Array | Float64Array>(list: List): List => {
    const copy = list.slice() as List;
    for (let k = 0; k < copy.length; k++) copy[k] = copy[k]! + shift[k % 3]!;
    return copy;
  };
  return {
    ...first,
    positions: both(Float32Array, first.positions, moved(second.positions)),
    normals: both(Float32Array, first.normals, second.normals),
    indices: both(Uint32Array, first.indices, plus(second.indices, vertices)),
    indexStarts: both(Uint32Array, first.indexStarts, plus(second.indexStarts.subarray(1), first.indices.length)),
    vertexStarts: both(Uint32Array, first.vertexStarts, plus(second.vertexStarts.subarray(1), vertices)),
    groupOf: both(Uint8Array, first.groupOf, plus(second.groupOf, first.groups.length)),
    groups: [...first.groups, ...second.groups],
    materialOf: both(Uint8Array, first.materialOf, plus(second.materialOf, first.materials.length)),
    materials: [...first.materials, ...second.materials],
    origins: both(Float64Array, first.origins, moved(second.origins)),
  };
}

type List = Float32Array | Float64Array | Uint32Array | Uint8Array;

function plus<L extends Uint32Array | Uint8Array>(list: L, amount: number): L {
  return list.map((value) => value + amount) as L;
}

function both<L extends List>(Kind: new (length: number) => L, one: L, other: L): L {
  const all = new Kind(one.length + other.length);
  all.set(one);
  all.set(other, one.length);
  return all;
}
