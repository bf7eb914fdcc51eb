/** Rocks as points: where each is, how it is turned and stretched, and which kind of the kit it is. For whatever scatters meshes on points. */

import { ByteWriter } from './byte-writer.ts';
import type { Written } from '../gltf/glb.ts';
import type { Told } from '../gltf/gltf-json.ts';
import { kitOf } from '../shapes/kit.ts';
import type { Frame, Kit } from '../shapes/kit.ts';
import { isOneThing } from '../model.ts';
import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';
import type { Pace } from '../pace.ts';
import { placementOf } from '../shapes/placement.ts';

type Vector = readonly [number, number, number];
const COMMA = 44;
/** The share of the work that is done when it is known where all points are. */
const FOUND = 0.6;

type Options = Pick<ResolvedOptions, 'kinds' | 'axes'>;
type Axes = ResolvedOptions['axes'];

/** What happens to glTF's right-handed metres with y up where a program's importer turns a kit into its own axes and units. */
const SPACES: Record<Axes, { unit: number; place: (v: Vector) => Vector; axis: (v: Vector) => Vector; extents: (v: Vector) => Vector }> = {
  gltf: { unit: 1, place: (v) => v, axis: (v) => v, extents: (v) => v },
  blender: { unit: 1, place: ([x, y, z]) => [x, -z, y], axis: ([x, y, z]) => [x, -z, y], extents: ([x, y, z]) => [x, z, y] },
  // Both are left-handed: an axis that is mirrored is that of the opposite turn.
  unreal: { unit: 100, place: ([x, y, z]) => [x, z, y], axis: ([x, y, z]) => [-x, -z, -y], extents: ([x, y, z]) => [x, z, y] },
  unity: { unit: 1, place: ([x, y, z]) => [-x, y, z], axis: ([x, y, z]) => [x, -y, -z], extents: (v) => v },
};

interface Point {
  id: number;
  place: Vector;
  /** x, y, z, w. */
  rotation: readonly [number, number, number, number];
  scale: Vector;
  /** As `rock-kind-1` of the kit. */
  kind: number;
  layer: number;
  /** Along, up, across, of the box around it in its own axes; in units of the file. */
  size: Vector;
  material: string;
}

const REALS = ['x', 'y', 'z', 'qx', 'qy', 'qz', 'qw', 'sx', 'sy', 'sz', 'length', 'width', 'height'] as const;
const WHOLES = ['kind', 'layer'] as const;

function realsOf({ place, rotation, scale, size: [length, height, width] }: Point): number[] {
  return [...place, ...rotation, ...scale, length, width, height];
}

/** A line for each rock under a line of names. */
export async function writeCsv(model: Model, options: Options, pace: Pace): Promise<Written> {
  const out = new ByteWriter();
  const points = await pointsOf(model, options, pace.within(0, FOUND));
  out.text(`${['id', ...REALS, ...WHOLES, 'material'].join()}\r\n`);
  await pace.within(FOUND, 1).each(points.length, (begin, end) => {
    for (const point of points.slice(begin, end)) {
      out.whole(point.id);
      for (const value of realsOf(point)) {
        out.codes(COMMA);
        out.decimal(value);
      }
      for (const name of WHOLES) {
        out.codes(COMMA);
        out.whole(point[name]);
      }
      out.text(`,${point.material}\r\n`);
    }
  });
  return { bytes: out.bytes(), counts: countsOf(points) };
}

/** Binary little-endian PLY of vertices alone. */
export async function writePlyPoints(model: Model, options: Options, told: Told, pace: Pace): Promise<Written> {
  const points = await pointsOf(model, options, pace.within(0, FOUND));
  const comments = [
    told.title,
    ...Object.entries(told.scene).map(([key, value]) => `${key}: ${typeof value === 'object' ? JSON.stringify(value) : String(value)}`),
    `axes: ${options.axes}`,
  ];
  const header = new TextEncoder().encode(
    [
      'ply',
      'format binary_little_endian 1.0',
      ...comments.map((comment) => `comment ${comment}`),
      `element vertex ${points.length}`,
      ...REALS.map((name) => `property float ${name}`),
      ...['id', ...WHOLES].map((name) => `property int ${name}`),
      'end_header\n',
    ].join('\n'),
  );
  const size = 4 * (REALS.length + 1 + WHOLES.length);
  const bytes = new Uint8Array(header.length + size * points.length);
  bytes.set(header);
  const view = new DataView(bytes.buffer, header.length);
  await pace.within(FOUND, 1).each(points.length, (begin, end) => {
    for (let p = begin; p < end; p++) {
      const { id, kind, layer } = points[p]!;
      realsOf(points[p]!).forEach((value, k) => view.setFloat32(size * p + 4 * k, value, true));
      [id, kind, layer].forEach((value, k) => view.setInt32(size * p + 4 * (REALS.length + k), value, true));
    }
  });
  return { bytes, counts: countsOf(points) };
}

function countsOf({ length }: readonly Point[]): Written['counts'] {
  return { vertices: length, triangles: 0, objects: length, nodes: length, meshes: 0 };
}

/** Of what is one thing, and so is no instance of anything, there is no point. */
async function pointsOf(model: Model, { kinds, axes }: Options, pace: Pace): Promise<Point[]> {
  const kit = await kitOf(model, kinds, pace.within(0, 0.5));
  const points: Point[] = [];
  await pace.within(0.5, 1).each(model.groupOf.length, (begin, end) => {
    for (let k = begin; k < end; k++) if (!isOneThing(model, model.groupOf[k]!)) points.push(pointOf(model, k, kit, axes));
  });
  return points;
}

function pointOf(model: Model, k: number, kit: Kit, axes: Axes): Point {
  const { unit, place, axis, extents } = SPACES[axes];
  const { translation, rotation, scale } = placementOf(model, k, kit);
  const group = model.groupOf[k]!;
  const { layer } = model.groups[group]!.extras;
  const [x, y, z, w] = rotation;
  return {
    id: k + 1,
    place: place(translation).map((part) => unit * part) as unknown as Vector,
    rotation: [...axis([x, y, z]), w],
    scale: extents(scale),
    kind: kit.kindOf[k]! + 1,
    layer: typeof layer === 'number' ? layer : group,
    size: sizeOf(model, k, kit.frames[k]!).map((part) => unit * part) as unknown as Vector,
    material: model.materials[model.materialOf[k]!]!.name,
  };
}

/** In metres: along the principal axis, upwards from the ground, and across. */
function sizeOf({ positions, vertexStarts, origins, unit }: Model, k: number, { cos, sin }: Frame): Vector {
  let [left, right, near, far, height] = [Infinity, -Infinity, Infinity, -Infinity, 0];
  for (let v = 3 * vertexStarts[k]!; v < 3 * vertexStarts[k + 1]!; v += 3) {
    const [x, y] = [positions[v]!, positions[v + 1]!];
    const [along, across] = [cos * x + sin * y, cos * y - sin * x];
    left = Math.min(left, along);
    right = Math.max(right, along);
    near = Math.min(near, across);
    far = Math.max(far, across);
    height = Math.max(height, positions[v + 2]! - origins[3 * k + 2]!);
  }
  return [unit * (right - left), unit * height, unit * (far - near)];
}
