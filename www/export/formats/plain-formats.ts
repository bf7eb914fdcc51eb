/** The formats that know little more than triangles: OBJ, STL and PLY. One mesh, or in OBJ an object for each body. */

import { ByteWriter } from './byte-writer.ts';
import type { Written } from '../gltf/glb.ts';
import type { Told } from '../gltf/gltf-json.ts';
import { levelName } from '../gltf/gltf-parts.ts';
import { thingsOf } from '../model.ts';
import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';
import type { Pace } from '../pace.ts';

type Options = Pick<ResolvedOptions, 'mesh' | 'up' | 'scale'>;

type Vertices = Pick<Model, 'positions' | 'normals'>;
type Placed = Vertices & Pick<Model, 'unit' | 'centre'>;

/** Vertex and normal buffers in the file's units and axes, about the middle of the model. */
export function inFile(model: Placed, options: Options): Vertices {
  const turned = emptyLike(model);
  turn(model, options, turned, 0, model.positions.length / 3);
  return turned;
}

async function inFileSlowly(model: Placed, options: Options, pace: Pace): Promise<Vertices> {
  const turned = emptyLike(model);
  await pace.each(model.positions.length / 3, (begin, end) => turn(model, options, turned, begin, end));
  return turned;
}

function emptyLike({ positions, normals }: Vertices): Vertices {
  return { positions: new Float32Array(positions.length), normals: new Float32Array(normals.length) };
}

/** The vertices from `begin` to `end`. */
function turn({ positions, normals, unit, centre }: Placed, { up, scale }: Options, to: Vertices, begin: number, end: number): void {
  const factor = unit * scale;
  // With y up (x, y, z) becomes (x, z, −y).
  const [second, third, sign] = up === 'z' ? ([1, 2, 1] as const) : ([2, 1, -1] as const);
  for (let v = 3 * begin; v < 3 * end; v += 3) {
    to.positions[v] = factor * (positions[v]! - centre[0]);
    to.positions[v + second] = factor * sign * (positions[v + 1]! - centre[1]);
    to.positions[v + third] = factor * (positions[v + 2]! - centre[2]);
    to.normals[v] = normals[v]!;
    to.normals[v + second] = sign * normals[v + 1]!;
    to.normals[v + third] = normals[v + 2]!;
  }
}

/** The share of the work that is done when all vertices are turned. */
const TURNED = 0.15;

const [LINE, SPACE, SLASH, F] = [10, 32, 47, 102];

/**
 * Wavefront OBJ: `v`, `vn` and `f` with a group for each layer, and an object for each body at each level of detail. Its comments say what the
 * file is.
 */
export async function writeObj(levels: readonly Model[], options: Options, told: Told, pace: Pace): Promise<Written> {
  const out = new ByteWriter();
  out.text(objHeader(told));
  let first = 1;
  for (const [level, model] of levels.entries()) {
    const share = pace.within(level / levels.length, (level + 1) / levels.length);
    await writeLevel(out, model, first, (name) => levelName(name, level, levels.length), options, share);
    first += model.positions.length / 3;
  }
  const counts = countsOf(levels[0]!, options.mesh === 'rocks');
  const objects = levels.length * counts.objects;
  return {
    bytes: out.bytes(),
    counts: { ...counts, levels: levels.map(({ indices }) => indices.length / 3), nodes: objects, meshes: objects },
  };
}

export function objHeader({ title, scene }: Told): string {
  const comments = Object.entries(scene).map(([key, value]) => `# ${key}: ${String(value)}\n`);
  return `# ${title}, by rock-field\n${comments.join('')}`;
}

/** `begin` is the number of its first vertex. */
async function writeLevel(
  out: ByteWriter,
  model: Model,
  begin: number,
  nameOf: (object: string) => string,
  options: Options,
  pace: Pace,
): Promise<void> {
  const { positions, normals } = await inFileSlowly(model, options, pace.within(0, TURNED));
  await writeTriples(out, 'v', positions, pace.within(TURNED, 0.4));
  await writeTriples(out, 'vn', normals, pace.within(0.4, 0.7));
  const objects = new Map(thingsOf(model).map(({ name, bodies: [first] }) => [first!, name]));
  let [next, group, material] = [0, -1, -1];
  /** Writes what stands before the triangles of the next body. */
  const beginBody = (): void => {
    const k = next++;
    const isOther = model.groupOf[k] !== group;
    group = model.groupOf[k]!;
    const { name } = model.groups[group]!;
    const object = options.mesh === 'rocks' ? objects.get(k) : isOther && name;
    if (object) out.text(`o ${nameOf(object)}\n`);
    if (isOther) out.text(`g ${name}\n`);
    if (isOther || model.materialOf[k] !== material) {
      material = model.materialOf[k]!;
      out.text(`usemtl ${model.materials[material]!.name}\n`);
    }
  };
  await pace.within(0.7, 1).each(model.indices.length / 3, (from, to) => {
    for (let i = 3 * from; i < 3 * to; i += 3) {
      while (next < model.groupOf.length && model.indexStarts[next]! <= i) beginBody();
      writeFace(out, model.indices, i, begin);
    }
  });
  while (next < model.groupOf.length) beginBody();
}

/** The triangle whose corners stand at `i`, of vertices that are numbered from `begin` on. */
function writeFace(out: ByteWriter, indices: Uint32Array, i: number, begin: number): void {
  out.codes(F);
  for (let corner = 0; corner < 3; corner++) {
    const vertex = indices[i + corner]! + begin;
    out.codes(SPACE);
    out.whole(vertex);
    out.codes(SLASH, SLASH);
    out.whole(vertex);
  }
  out.codes(LINE);
}

/** A line for each three numbers. */
async function writeTriples(out: ByteWriter, name: string, list: Float32Array, pace: Pace): Promise<void> {
  const first = [...name].map((letter) => letter.charCodeAt(0));
  await pace.each(list.length / 3, (begin, end) => {
    for (let v = 3 * begin; v < 3 * end; v += 3) {
      out.codes(...first);
      for (let axis = 0; axis < 3; axis++) {
        out.codes(SPACE);
        out.decimal(list[v + axis]!);
      }
      out.codes(LINE);
    }
  });
}

/** With the number of triangles; and each of them. */
export const [STL_HEADER, STL_TRIANGLE] = [84, 50];
/** Where that number is. */
const STL_COUNT = 80;

/** Binary STL. Its header does not begin with “solid”, by which readers know the other kind. */
export async function writeStl(model: Model, options: Options, told: Told, pace: Pace): Promise<Written> {
  const { positions } = await inFileSlowly(model, options, pace.within(0, TURNED));
  const { indices } = model;
  const triangles = indices.length / 3;
  const bytes = new Uint8Array(STL_HEADER + STL_TRIANGLE * triangles);
  bytes.set(new TextEncoder().encode(`rock-field: ${told.title}`).subarray(0, STL_COUNT));
  const view = new DataView(bytes.buffer);
  view.setUint32(STL_COUNT, triangles, true);
  await pace.within(TURNED, 1).each(triangles, (begin, end) => {
    for (let t = begin, at = STL_HEADER + STL_TRIANGLE * begin; t < end; t++, at += STL_TRIANGLE) {
      const [a, b, c] = [3 * indices[3 * t]!, 3 * indices[3 * t + 1]!, 3 * indices[3 * t + 2]!];
      normalOf(positions, a, b, c).forEach((value, k) => view.setFloat32(at + 4 * k, value, true));
      for (let axis = 0; axis < 3; axis++) {
        view.setFloat32(at + 12 + 4 * axis, positions[a + axis]!, true);
        view.setFloat32(at + 24 + 4 * axis, positions[b + axis]!, true);
        view.setFloat32(at + 36 + 4 * axis, positions[c + axis]!, true);
      }
    }
  });
  return { bytes, counts: countsOf(model, false) };
}

/** Of the triangle whose corners begin at these places; (0, 0, 0), as the format has it, where it has no area. */
function normalOf(p: Float32Array, a: number, b: number, c: number): [number, number, number] {
  const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
  const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
  const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const length = Math.sqrt(x * x + y * y + z * z);
  return length > 0 ? [x / length, y / length, z / length] : [0, 0, 0];
}

export const [PLY_VERTEX, PLY_FACE] = [27, 13];

export function plyHeader({ title, scene }: Told, vertices: number, faces: number): Uint8Array<ArrayBuffer> {
  const comments = [title, ...Object.entries(scene).map(([key, value]) => `${key}: ${String(value)}`)];
  return new TextEncoder().encode(
    [
      'ply',
      'format binary_little_endian 1.0',
      ...comments.map((comment) => `comment ${comment}`),
      `element vertex ${vertices}`,
      ...['x', 'y', 'z', 'nx', 'ny', 'nz'].map((name) => `property float ${name}`),
      ...['red', 'green', 'blue'].map((name) => `property uchar ${name}`),
      `element face ${faces}`,
      'property list uchar int vertex_indices',
      'end_header\n',
    ].join('\n'),
  );
}

/** Binary little-endian PLY, whose vertices have normals and the colour of their rock. */
export async function writePly(model: Model, options: Options, told: Told, pace: Pace): Promise<Written> {
  const { positions, normals } = await inFileSlowly(model, options, pace.within(0, TURNED));
  const { indices, vertexStarts } = model;
  const [vertices, faces] = [positions.length / 3, indices.length / 3];
  const header = plyHeader(told, vertices, faces);
  const bytes = new Uint8Array(header.length + PLY_VERTEX * vertices + PLY_FACE * faces);
  bytes.set(header);
  const view = new DataView(bytes.buffer);
  const colors = model.materials.map(({ color }) => color.map(encoded));
  let k = 0;
  await pace.within(TURNED, 0.6).each(vertices, (begin, end) => {
    for (let v = begin, at = header.length + PLY_VERTEX * begin; v < end; v++, at += PLY_VERTEX) {
      while (vertexStarts[k + 1]! <= v) k += 1;
      for (let axis = 0; axis < 3; axis++) {
        view.setFloat32(at + 4 * axis, positions[3 * v + axis]!, true);
        view.setFloat32(at + 12 + 4 * axis, normals[3 * v + axis]!, true);
        bytes[at + 24 + axis] = colors[model.materialOf[k]!]![axis]!;
      }
    }
  });
  const firstFace = header.length + PLY_VERTEX * vertices;
  await pace.within(0.6, 1).each(faces, (begin, end) => {
    for (let face = begin, at = firstFace + PLY_FACE * begin; face < end; face++, at += PLY_FACE) {
      bytes[at] = 3;
      for (let corner = 0; corner < 3; corner++) view.setInt32(at + 1 + 4 * corner, indices[3 * face + corner]!, true);
    }
  });
  return { bytes, counts: countsOf(model, false) };
}

/** A linear part of a colour as a byte of sRGB. */
function encoded(linear: number): number {
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
}

function countsOf({ positions, indices, groupOf, groups }: Model, isApart: boolean): Written['counts'] {
  const objects = isApart ? thingsOf({ groups, groupOf }).length : groups.filter((_, group) => groupOf.includes(group)).length;
  const triangles = indices.length / 3;
  return { vertices: positions.length / 3, triangles, objects, nodes: objects, meshes: objects };
}
