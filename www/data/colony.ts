/**
 * A colony of wood ears as it crosses every boundary: flat typed arrays, no object graph. Centimetres, z up, x along the log.
 */

/** The log as it is drawn. The same object as in the colony before while nothing of it changed. */
export interface WoodEarLog {
  /** Float32Array(3v), cm. */
  positions: Float32Array;
  normals: Float32Array;
  /** Uint32Array(3t). */
  indices: Uint32Array;
  /** Uint8Array(v): 0 bark, 1 end grain, 2 splinter. */
  kinds: Uint8Array;
  /** Float32Array(2v): place along the axis and distance from it, cm. */
  coords: Float32Array;
  /** Whether a log of your own was closed and inside out; then it has been turned. */
  turned: boolean;
  /** What the coordinates of a log of your own were multiplied by: 1, unless it was shorter than 20 cm or longer than 10 m. */
  scale: number;
}

/** Milliseconds per stage that actually ran. */
export interface WoodEarTimes {
  log: number;
  spawn: number;
  deform: number;
  collide: number;
  mesh: number;
  /** From the request to the buffers in JavaScript. */
  total: number;
}

export interface WoodEarStats {
  individuals: number;
  triangles: number;
  /** Pairs of individuals that cross each other, counted at the end of the run; absent from a preview. */
  crossingPairs?: number;
  sweeps: number;
  rounds: number;
  /** Share of the rim's radius that collisions left: the median, and the tenth percentile. */
  keptMedian: number;
  keptP10: number;
  ms: WoodEarTimes;
}

export interface WoodEarColony {
  /** Float32Array(3v), cm. */
  positions: Float32Array;
  normals: Float32Array;
  /** Uint32Array(3t). */
  indices: Uint32Array;
  /** Uint32Array(n+1): individual k owns `indices[individualStarts[k]] .. indices[individualStarts[k+1]]`. */
  individualStarts: Uint32Array;
  /** Uint32Array(n+1): individual k owns the vertices `vertexStarts[k] .. vertexStarts[k+1]`. */
  vertexStarts: Uint32Array;
  /**
   * Uint32Array(n): the vertex of the grown log's coarse mesh that it stands on. On a log of your own the triangle: `indices[3 * foot]` and the
   * two after it, in what you passed.
   */
  foot: Uint32Array;
  /** Float32Array(n), cm. */
  size: Float32Array;
  /** Uint8Array(n): index of its base. */
  base: Uint8Array;
  log: WoodEarLog;
  /** Float64Array(3b), cm: the bases, moved to the nearest vertex of the log. */
  bases: Float64Array;
  stats: WoodEarStats;
}
