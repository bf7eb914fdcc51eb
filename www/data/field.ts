/**
 * The field as it crosses every boundary: flat typed arrays, no object graph.
 *
 * Plane x right, y up, in pixels; z up; the origin at the image's corner. Layers stand in input order.
 */

/** One layer: its sites, its Voronoi diagram clipped to the image, and the cells granted to rocks. */
export interface FieldLayer {
  id: number;
  /** Disc radius in px. */
  radius: number;
  /** N_p of Eq. 1. */
  targetSites: number;
  /** Float32Array(2n): site i at `sites[2*i], sites[2*i+1]`, px. */
  sites: Float32Array;
  /** No free pixel was left before `targetSites` was reached. */
  sitesSaturated: boolean;
  /** Uint32Array(n+1): cell i owns the vertices `cellStarts[i] .. cellStarts[i+1]`. */
  cellStarts: Uint32Array;
  /** Float32Array(2m): counter-clockwise, px. */
  cellVertices: Float32Array;
  /** Site indices in the order granted. */
  selected: Uint32Array;
  /** A_s asked for. */
  areaFraction: number;
  /** Share of the image's pixels that the selected cells own. */
  areaReached: number;
  /** The cells ended before the threshold was reached. */
  saturated: boolean;
}

/** Milliseconds per stage that actually ran; a stage taken from the cache counts 0. */
export interface StageTimes {
  sites: number;
  cells: number;
  selection: number;
  shape: number;
  mesh: number;
  /** From the request to the buffers in JavaScript. */
  total: number;
}

export interface FieldStats {
  rocks: number;
  triangles: number;
  /** Share of the image's pixels owned by a selected cell. */
  coveredFraction: number;
  ms: StageTimes;
}

export interface Field {
  imageWidth: number;
  imageHeight: number;
  layers: FieldLayer[];
  /** Float32Array(3v), px, z up: rocks in layer order, within a layer in `selected` order; a rock's n rim vertices (2, 4, 8, 16 or 32 times as many where it is cut finer), then the others. */
  positions: Float32Array;
  /** Float32Array(3v), unit, area-weighted over adjacent faces; of a weathered rock's buried faces at the rim, for the rim alone. */
  normals: Float32Array;
  /** Uint32Array(3t), counter-clockwise seen from above before displacement. */
  indices: Uint32Array;
  /** Uint32Array(rocks+1): rock k owns `indices[rockStarts[k]] .. indices[rockStarts[k+1]]`. */
  rockStarts: Uint32Array;
  /** Uint32Array(rocks+1): rock k owns the vertices `vertexStarts[k] .. vertexStarts[k+1]`. */
  vertexStarts: Uint32Array;
  /** Uint8Array(rocks): index into `layers`. */
  rockLayer: Uint8Array;
  stats: FieldStats;
}
