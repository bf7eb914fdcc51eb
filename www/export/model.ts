/** What an export is made from, whatever grew it: bodies in flat arrays. */

/** Bodies that belong together: a layer of a field. */
export interface Group {
  name: string;
  /** What a reader of the file may want to know. JSON. */
  extras: Record<string, unknown>;
}

/** What bodies are made of. */
export interface Material {
  name: string;
  /** Linear, 0 … 1. */
  color: readonly [number, number, number];
}

/** z is up; `unit` says what a unit is. Body k owns the vertices and indices between `starts[k]` and `starts[k + 1]`. */
export interface Model {
  /** Metres. */
  unit: number;
  positions: Float32Array;
  /** Unit vectors. */
  normals: Float32Array;
  /** Counter-clockwise from outside; of the whole of `positions`. */
  indices: Uint32Array;
  indexStarts: Uint32Array;
  vertexStarts: Uint32Array;
  /** For each body. */
  groupOf: Uint8Array;
  groups: Group[];
  /** For each body. */
  materialOf: Uint8Array;
  materials: Material[];
  /** Float64Array(3 · bodies): where a body stands on the ground. */
  origins: Float64Array;
  /** What a body is called, before its number: `rock`. */
  noun: string;
  /** The middle of the whole, at which the file has its origin. */
  centre: readonly [number, number, number];
}
