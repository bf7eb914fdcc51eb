/** The meshes of a glTF file and the buffer that they lie in. Metres, y up: our (x, y, z) is its (x, z, −y). */

import type { Kit } from './kit.ts';
import { thingsOf } from './model.ts';
import type { Model } from './model.ts';
import type { ResolvedOptions } from './options.ts';

const [ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER] = [34962, 34963];
const [UNSIGNED_SHORT, UNSIGNED_INT] = [5123, 5125];
/** Vertices that a mesh may have whose indices take two bytes: 65535 would restart a strip. */
const SHORT = 65_535;

/** What one material covers of a mesh: a primitive of the file. */
export interface Part {
  material: number;
  bodies: readonly number[];
  /** What becomes the origin of the mesh, in units of the model. */
  origin: readonly [number, number, number];
  /** The angle from x to what becomes the mesh's x. */
  turn?: { cos: number; sin: number };
}

export interface Mesh {
  name: string;
  group: number;
  parts: readonly Part[];
}

/** The meshes of the file. `kit` where the form is so. */
export function meshesOf(model: Model, form: ResolvedOptions['mesh'], kit?: Kit): Mesh[] {
  if (form === 'one') return wholes(model);
  return kit ? archetypes(model, kit) : singles(model);
}

function singles(model: Model): Mesh[] {
  return thingsOf(model).map(({ name, group, bodies }) => ({ name, group, parts: partsOf(model, bodies) }));
}

function wholes(model: Model): Mesh[] {
  return model.groups.flatMap(({ name }, group) => {
    const parts = model.materials.flatMap((_, material) => {
      const bodies = [...model.groupOf.keys()].filter((k) => model.groupOf[k] === group && model.materialOf[k] === material);
      return bodies.length > 0 ? [{ material, bodies, origin: model.centre }] : [];
    });
    return parts.length > 0 ? [{ name, group, parts }] : [];
  });
}

/** In their principal frames, so that scaling along the axes stretches the rock, and does not shear it. What is one thing is as it is. */
function archetypes(model: Model, { kinds, frames }: Kit): Mesh[] {
  const counts = new Map<string, number>();
  return Array.from(kinds, (k) => {
    const group = model.groupOf[k]!;
    const { name, noun } = model.groups[group]!;
    if (noun === undefined) {
      const bodies = [...model.groupOf.keys()].filter((other) => model.groupOf[other] === group);
      return { name, group, parts: partsOf(model, bodies) };
    }
    const number = (counts.get(noun) ?? 0) + 1;
    counts.set(noun, number);
    return { name: `${noun}-kind-${number}`, group, parts: partsOf(model, [k], frames[k]!) };
  });
}

function partsOf(model: Model, bodies: readonly number[], turn?: Part['turn']): Part[] {
  return bodies.map((k) => ({ material: model.materialOf[k]!, bodies: [k], origin: originOf(model, k), ...(turn && { turn }) }));
}

function originOf({ origins }: Model, k: number): [number, number, number] {
  return [origins[3 * k]!, origins[3 * k + 1]!, origins[3 * k + 2]!];
}

/** Where the arrays of a part lie in the buffer, and their bounds. */
export interface Place {
  vertex: number;
  vertices: number;
  index: number;
  indices: number;
  min: number[];
  max: number[];
}

export interface Buffers {
  bytes: Uint8Array;
  /** For each part, those of the first mesh first. */
  places: Place[];
  /** In the order of `VIEWS`; those that nothing is in are left out. */
  views: Partial<Record<ViewName, View>>;
  indexType: number;
}

/** A stretch of the buffer, and its number in the file. */
interface View {
  index: number;
  offset: number;
  length: number;
  stride?: number;
  target?: number;
}

const VIEWS = ['positions', 'normals', 'ids', 'indices', 'translations', 'rotations', 'scales'] as const;
type ViewName = (typeof VIEWS)[number];

/**
 * All of the file's binary part, in one allocation. What places `instances` bodies is left empty.
 *
 * @param withIds whether vertices tell which body they are of.
 */
export function buffersOf(model: Model, meshes: readonly Mesh[], withIds: boolean, instances: number): Buffers {
  const { indexStarts, vertexStarts } = model;
  const parts = meshes.flatMap((mesh) => mesh.parts);
  const sizes = parts.map(({ bodies }) => ({
    vertices: bodies.reduce((sum, k) => sum + vertexStarts[k + 1]! - vertexStarts[k]!, 0),
    indices: bodies.reduce((sum, k) => sum + indexStarts[k + 1]! - indexStarts[k]!, 0),
  }));
  const vertices = sizes.reduce((sum, size) => sum + size.vertices, 0);
  const indices = sizes.reduce((sum, size) => sum + size.indices, 0);
  const isShort = sizes.every((size) => size.vertices < SHORT);
  const { views, length } = laidOut({
    positions: { length: 12 * vertices, stride: 12, target: ARRAY_BUFFER },
    normals: { length: 12 * vertices, stride: 12, target: ARRAY_BUFFER },
    ids: { length: withIds ? 4 * vertices : 0, stride: 4, target: ARRAY_BUFFER },
    indices: { length: (isShort ? 2 : 4) * indices, target: ELEMENT_ARRAY_BUFFER },
    translations: { length: 12 * instances },
    rotations: { length: 16 * instances },
    scales: { length: 12 * instances },
  });
  const bytes = new Uint8Array(length);
  const arrays = {
    positions: new Float32Array(bytes.buffer, views.positions?.offset, 3 * vertices),
    normals: new Float32Array(bytes.buffer, views.normals?.offset, 3 * vertices),
    ids: new Float32Array(bytes.buffer, views.ids?.offset, withIds ? vertices : 0),
    indices: isShort
      ? new Uint16Array(bytes.buffer, views.indices?.offset, indices)
      : new Uint32Array(bytes.buffer, views.indices?.offset, indices),
  };
  const places: Place[] = [];
  let [vertex, index] = [0, 0];
  parts.forEach((part, p) => {
    const size = sizes[p]!;
    const span = [3 * vertex, 3 * (vertex + size.vertices)] as const;
    const own = arrays.indices.subarray(index, index + size.indices);
    const bounds = fill(model, part, arrays.positions.subarray(...span), arrays.normals.subarray(...span), own);
    if (withIds) fillIds(model, part, arrays.ids.subarray(vertex, vertex + size.vertices));
    places.push({ vertex, vertices: size.vertices, index, indices: size.indices, ...bounds });
    vertex += size.vertices;
    index += size.indices;
  });
  return { bytes, places, views, indexType: isShort ? UNSIGNED_SHORT : UNSIGNED_INT };
}

/** One after the other, each at a multiple of four bytes. */
function laidOut(wanted: Record<ViewName, Omit<View, 'index' | 'offset'>>): { views: Buffers['views']; length: number } {
  const views: Buffers['views'] = {};
  let [index, end] = [0, 0];
  for (const name of VIEWS) {
    if (wanted[name].length === 0) continue;
    views[name] = { ...wanted[name], index, offset: end };
    index += 1;
    end += Math.ceil(wanted[name].length / 4) * 4;
  }
  return { views, length: end };
}

/** Writes a part's vertices in metres, y up, about its origin, and its indices from 0. */
function fill(
  { positions, normals, indices, indexStarts, vertexStarts, unit }: Model,
  { bodies, origin: [x, y, z], turn: { cos, sin } = { cos: 1, sin: 0 } }: Part,
  toPositions: Float32Array,
  toNormals: Float32Array,
  toIndices: Uint16Array | Uint32Array,
): Pick<Place, 'min' | 'max'> {
  let [v, i] = [0, 0];
  for (const k of bodies) {
    const [first, last] = [vertexStarts[k]!, vertexStarts[k + 1]!];
    const base = v / 3 - first;
    for (let from = 3 * first; from < 3 * last; from += 3, v += 3) {
      const [px, py, pz] = [positions[from]! - x, positions[from + 1]! - y, positions[from + 2]! - z];
      toPositions[v] = unit * (cos * px + sin * py);
      toPositions[v + 1] = unit * pz;
      toPositions[v + 2] = unit * (sin * px - cos * py);
      const [nx, ny] = [normals[from]!, normals[from + 1]!];
      toNormals[v] = cos * nx + sin * ny;
      toNormals[v + 1] = normals[from + 2]!;
      toNormals[v + 2] = sin * nx - cos * ny;
    }
    for (let from = indexStarts[k]!; from < indexStarts[k + 1]!; from++) toIndices[i++] = indices[from]! + base;
  }
  return boundsOf(toPositions);
}

function boundsOf(positions: Float32Array): Pick<Place, 'min' | 'max'> {
  const [min, max] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  for (let v = 0; v < positions.length; v++) {
    const value = positions[v]!;
    const axis = v % 3;
    if (value < min![axis]!) min![axis] = value;
    if (value > max![axis]!) max![axis] = value;
  }
  return { min: min!, max: max! };
}

/** Which body of the model each vertex is of. */
function fillIds({ vertexStarts }: Model, { bodies }: Part, ids: Float32Array): void {
  let v = 0;
  for (const k of bodies) {
    const end = v + vertexStarts[k + 1]! - vertexStarts[k]!;
    ids.fill(k, v, end);
    v = end;
  }
}
