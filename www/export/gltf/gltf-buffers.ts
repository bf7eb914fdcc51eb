/** The binary part of a glTF file: where everything lies in it, and how it is filled. Metres, y up: our (x, y, z) is its (x, z, −y). */

import type { Mesh, Part } from './gltf-parts.ts';
import type { Kit } from '../shapes/kit.ts';
import { numbersOf } from '../model.ts';
import type { Images, Model } from '../model.ts';
import type { Pace } from '../pace.ts';
import { instancesByKind, placementOf } from '../shapes/placement.ts';

const [ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER] = [34962, 34963];
const [UNSIGNED_SHORT, UNSIGNED_INT] = [5123, 5125];
/** Vertices that a mesh may have whose indices take two bytes: 65535 would restart a strip. */
const SHORT = 65_535;
/** Four parts of 16 bits: in eight, dark linear colours would be steps apart. */
export const COLOR_BYTES = 8;
const WHITE = 65_535;

/** Where the arrays of a part lie: its first vertex and index among all, and how many it has. */
export interface Place {
  vertex: number;
  vertices: number;
  index: number;
  indices: number;
}

export interface Layout {
  /** Of the whole part, bytes. */
  length: number;
  /** For each part, those of the first mesh first. */
  places: Place[];
  /** In the order of `VIEWS`; those that nothing is in are left out. */
  views: Partial<Record<ViewName, View>>;
  /** glTF's number for the type of the indices, and how many bytes each takes. */
  indexType: number;
  indexBytes: number;
}

/** A stretch of the buffer, and its number in the file. */
export interface View {
  index: number;
  offset: number;
  length: number;
  stride?: number;
  target?: number;
}

/** In the order of their textures. */
export const IMAGES = ['color', 'normal', 'surface'] as const;
const VIEWS = [
  'positions',
  'normals',
  'colors',
  'tangents',
  'coordinates',
  'ids',
  'indices',
  'translations',
  'rotations',
  'scales',
  ...IMAGES,
] as const;
export type ViewName = (typeof VIEWS)[number];

/** Those of vertices. */
export const VERTEX_VIEWS = ['positions', 'normals', 'colors', 'tangents', 'coordinates', 'ids'] as const satisfies readonly ViewName[];

/** What is wanted beside positions, normals and indices. */
export interface Wanted {
  /** Whether vertices tell which thing they are of. */
  withIds: boolean;
  /** Whether vertices have the colours of their materials. */
  withColors: boolean;
  /** How many bodies are placed by attributes. */
  instances: number;
  /** Where a material is textured. */
  images: Images | undefined;
}

/** How many bytes an index takes, where no primitive has more vertices than this. */
export function indexBytesFor(most: number): number {
  return most < SHORT ? 2 : 4;
}

/**
 * Where everything is going to lie. Hulls, which have positions alone, come last.
 */
export function layoutOf(meshes: readonly Mesh[], { withIds, withColors, instances, images }: Wanted): Layout {
  const places: Place[] = [];
  const placeOf = new Map<Part, Place>();
  let [vertex, index, most, dressed] = [0, 0, 0, 0];
  for (const { parts } of meshes) {
    for (const part of parts) {
      if (part.sameAs) {
        places.push(placeOf.get(part.sameAs)!);
        continue;
      }
      const { model, material, bodies } = part;
      const { indexStarts, vertexStarts } = model;
      let [vertices, indices] = [0, 0];
      for (const k of bodies) {
        vertices += vertexStarts[k + 1]! - vertexStarts[k]!;
        indices += indexStarts[k + 1]! - indexStarts[k]!;
      }
      const place = { vertex, vertices, index, indices };
      places.push(place);
      placeOf.set(part, place);
      vertex += vertices;
      if (material !== undefined) dressed = vertex;
      index += indices;
      most = Math.max(most, vertices);
    }
  }
  const indexBytes = indexBytesFor(most);
  const { views, length } = laidOut({
    positions: { length: 12 * vertex, stride: 12, target: ARRAY_BUFFER },
    normals: { length: 12 * dressed, stride: 12, target: ARRAY_BUFFER },
    colors: { length: withColors ? COLOR_BYTES * dressed : 0, stride: COLOR_BYTES, target: ARRAY_BUFFER },
    tangents: { length: images ? 16 * dressed : 0, stride: 16, target: ARRAY_BUFFER },
    coordinates: { length: images ? 8 * dressed : 0, stride: 8, target: ARRAY_BUFFER },
    ids: { length: withIds ? 4 * vertex : 0, stride: 4, target: ARRAY_BUFFER },
    indices: { length: indexBytes * index, target: ELEMENT_ARRAY_BUFFER },
    translations: { length: 12 * instances },
    rotations: { length: 16 * instances },
    scales: { length: 12 * instances },
    color: { length: images?.color.length ?? 0 },
    normal: { length: images?.normal.length ?? 0 },
    surface: { length: images?.surface.length ?? 0 },
  });
  return { length, places, views, indexType: indexBytes === 2 ? UNSIGNED_SHORT : UNSIGNED_INT, indexBytes };
}

/** One after the other, each at a multiple of four bytes. */
function laidOut(wanted: Record<ViewName, Omit<View, 'index' | 'offset'>>): Pick<Layout, 'views' | 'length'> {
  const views: Layout['views'] = {};
  let [index, end] = [0, 0];
  for (const name of VIEWS) {
    if (wanted[name].length === 0) continue;
    views[name] = { ...wanted[name], index, offset: end };
    index += 1;
    end += Math.ceil(wanted[name].length / 4) * 4;
  }
  return { views, length: end };
}

/**
 * Writes all meshes to where they lie.
 *
 * @param bytes the binary part, as long as the layout says, at a multiple of four bytes.
 */
export async function fillMeshes(
  model: Model,
  meshes: readonly Mesh[],
  { places, views, indexBytes }: Layout,
  bytes: Uint8Array<ArrayBuffer>,
  pace: Pace,
): Promise<void> {
  const floats = (name: ViewName): Float32Array => floatsOf(bytes, views[name]);
  const [positions, normals, ids] = [floats('positions'), floats('normals'), floats('ids')];
  const { offset = 0, length = 0 } = views.indices ?? {};
  const indices = new (indexBytes === 2 ? Uint16Array : Uint32Array)(bytes.buffer, bytes.byteOffset + offset, length / indexBytes);
  const colors = shortsOf(bytes, views.colors);
  const numbers = ids.length > 0 ? numbersOf(model) : undefined;
  let p = 0;
  for (const { parts } of meshes) {
    for (const part of parts) {
      const { vertex, index } = places[p++]!;
      if (part.sameAs) continue;
      fillPositions(part, positions, 3 * vertex);
      if (part.material !== undefined) fillNormals(part, normals, 3 * vertex);
      if (colors.length > 0 && part.material !== undefined) fillColors(part, part.material, colors, 4 * vertex);
      fillIndices(part, indices, index);
      if (numbers) fillIds(part, numbers, ids, vertex);
      if (pace.isDue()) await pace.rest(p / places.length);
    }
  }
}

/** The instances of a kind lie one after the other, in the order of the kinds. */
export function fillInstances(model: Model, kit: Kit, { views }: Layout, bytes: Uint8Array<ArrayBuffer>): void {
  const floats = (name: ViewName): Float32Array => floatsOf(bytes, views[name]);
  const [translations, rotations, scales] = [floats('translations'), floats('rotations'), floats('scales')];
  instancesByKind(model, kit)
    .flat()
    .forEach((k, at) => {
      const { translation, rotation, scale } = placementOf(model, k, kit);
      translations.set(translation, 3 * at);
      rotations.set(rotation, 4 * at);
      scales.set(scale, 3 * at);
    });
}

export function floatsOf(bytes: Uint8Array<ArrayBuffer>, view: View | undefined): Float32Array {
  return new Float32Array(bytes.buffer, bytes.byteOffset + (view?.offset ?? 0), (view?.length ?? 0) / 4);
}

export function shortsOf(bytes: Uint8Array<ArrayBuffer>, view: View | undefined): Uint16Array {
  return new Uint16Array(bytes.buffer, bytes.byteOffset + (view?.offset ?? 0), (view?.length ?? 0) / 2);
}

/** Writes a part's vertices in metres, y up, about its origin. */
function fillPositions(part: Part, to: Float32Array, begin: number): void {
  const { positions, vertexStarts, unit } = part.model;
  const [x, y, z] = part.origin;
  const { cos, sin } = part.turn ?? { cos: 1, sin: 0 };
  let v = begin;
  for (const k of part.bodies) {
    const end = 3 * vertexStarts[k + 1]!;
    for (let from = 3 * vertexStarts[k]!; from < end; from += 3, v += 3) {
      const px = positions[from]! - x;
      const py = positions[from + 1]! - y;
      to[v] = unit * (cos * px + sin * py);
      to[v + 1] = unit * (positions[from + 2]! - z);
      to[v + 2] = unit * (sin * px - cos * py);
    }
  }
}

function fillNormals(part: Part, to: Float32Array, begin: number): void {
  const { normals, vertexStarts } = part.model;
  const { cos, sin } = part.turn ?? { cos: 1, sin: 0 };
  let v = begin;
  for (const k of part.bodies) {
    const end = 3 * vertexStarts[k + 1]!;
    for (let from = 3 * vertexStarts[k]!; from < end; from += 3, v += 3) {
      const nx = normals[from]!;
      const ny = normals[from + 1]!;
      to[v] = cos * nx + sin * ny;
      to[v + 1] = normals[from + 2]!;
      to[v + 2] = sin * nx - cos * ny;
    }
  }
}

/** The linear colour of the material, for each vertex. */
function fillColors({ model: { materials, vertexStarts }, bodies }: Part, material: number, to: Uint16Array, begin: number): void {
  const [red, green, blue] = materials[material]!.color.map((part) => Math.round(WHITE * part));
  let v = begin;
  for (const k of bodies) {
    for (let count = vertexStarts[k + 1]! - vertexStarts[k]!; count > 0; count--) {
      to[v++] = red!;
      to[v++] = green!;
      to[v++] = blue!;
      to[v++] = WHITE;
    }
  }
}

/** Writes a part's indices, which begin with 0. */
function fillIndices({ model: { indices, indexStarts, vertexStarts }, bodies }: Part, to: Uint16Array | Uint32Array, begin: number): void {
  let [i, vertex] = [begin, 0];
  for (const k of bodies) {
    const base = vertex - vertexStarts[k]!;
    const end = indexStarts[k + 1]!;
    for (let from = indexStarts[k]!; from < end; from++) to[i++] = indices[from]! + base;
    vertex += vertexStarts[k + 1]! - vertexStarts[k]!;
  }
}

/** Which thing each vertex is of, from 0 on among those with the same noun. */
function fillIds({ model: { vertexStarts }, bodies }: Part, numbers: Uint32Array, ids: Float32Array, begin: number): void {
  let v = begin;
  for (const k of bodies) {
    const end = v + vertexStarts[k + 1]! - vertexStarts[k]!;
    ids.fill(numbers[k]! - 1, v, end);
    v = end;
  }
}

/** Where the least x, y and z of a part are put, and then the most. */
export const BOUNDS = 6;

/**
 * The box around a part, as it is in the file.
 *
 * It comes before the vertices in the file, so that it is computed by itself: in the same way, since glTF wants it to the last digit.
 *
 * @param to of `BOUNDS` numbers.
 */
export function boundsOf(part: Part, to: Float32Array): Float32Array {
  const { positions, vertexStarts, unit } = part.model;
  const [x, y, z] = part.origin;
  const { cos, sin } = part.turn ?? { cos: 1, sin: 0 };
  to.fill(Infinity, 0, 3);
  to.fill(-Infinity, 3);
  for (const k of part.bodies) {
    const end = 3 * vertexStarts[k + 1]!;
    for (let v = 3 * vertexStarts[k]!; v < end; v += 3) {
      const px = positions[v]! - x;
      const py = positions[v + 1]! - y;
      const east = unit * (cos * px + sin * py);
      const up = unit * (positions[v + 2]! - z);
      const south = unit * (sin * px - cos * py);
      if (east < to[0]!) to[0] = east;
      if (up < to[1]!) to[1] = up;
      if (south < to[2]!) to[2] = south;
      if (east > to[3]!) to[3] = east;
      if (up > to[4]!) to[4] = up;
      if (south > to[5]!) to[5] = south;
    }
  }
  return to;
}
