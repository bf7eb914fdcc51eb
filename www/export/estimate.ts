/** What a file of meshes will be, before it is written: counted where that takes no time, and reckoned from a few of the things where it does. */

import { ByteWriter } from './formats/byte-writer.ts';
import { inFile, objHeader, PLY_FACE, PLY_VERTEX, plyHeader, STL_HEADER, STL_TRIANGLE } from './formats/plain-formats.ts';
import { describe, instancesOf } from './gltf/glb.ts';
import { COLOR_BYTES, indexBytesFor, VERTEX_VIEWS } from './gltf/gltf-buffers.ts';
import type { Told } from './gltf/gltf-json.ts';
import { levelName } from './gltf/gltf-parts.ts';
import { isOneThing, thingsOf } from './model.ts';
import type { Images, Model, Thing } from './model.ts';
import type { ResolvedOptions } from './options.ts';
import { HULL_NAMES, MOST_VERTICES } from './shapes/hulls.ts';
import type { Kit } from './shapes/kit.ts';
import { LEAST, SHARE } from './shapes/lods.ts';
import { closed, rimOf } from './shapes/solid.ts';
import { someOf } from './shapes/some.ts';

/** What its report will say. */
export interface Estimate {
  /** Exact, as are objects. */
  triangles: number;
  objects: number;
  /**
   * Of STL, PLY and the binary part of a GLB exact; all of a GLB or an OBJ to 3 %. With levels of detail, hulls or compression, and of points,
   * the file will be no larger than this.
   */
  bytes: number;
}

/** So many things are written to learn how long the text about one is, and so many vertices. */
const [THINGS, VERTICES] = [64, 2048];
/** A simplifier may leave more triangles than it was asked for. */
const LEFT_OVER = 1.25;
/** No point takes more, nor the head of their file; a mesh that is compressed never gets larger by more. */
const [BYTES_A_POINT, BYTES_AROUND] = [200, 4096];
/** What else a GLB has, beside what is in its two parts. */
const GLB_HEADS = 28;
/** Of a vertex: position and normal; tangent and place in the textures; number of its thing. Of an instance: where it is, turn and scale. */
const [PLAIN_BYTES, TEXTURED_BYTES, ID_BYTES, INSTANCE_BYTES] = [24, 24, 4, 40];

/** A file that has not been written yet. */
export interface Planned {
  /** Open below, with everything that is to be written. */
  model: Model;
  /** Any format but those of maps. */
  options: ResolvedOptions;
  told: Told;
  /** Where `mesh` is so. */
  kit?: Kit | undefined;
  /** Where the file has textures. */
  images?: Images | undefined;
}

/** Its things, and how large its bodies are at each level of detail. */
interface Measured extends Planned {
  things: readonly Thing[];
  levels: readonly Sizes[];
}

/** How large bodies are: vertices and triangles of each, of one level of detail. */
interface Sizes {
  vertices: Uint32Array;
  triangles: Uint32Array;
}

/** What a file will be. It takes a small part of the time of writing it, and no memory to speak of. */
export function estimateOf(planned: Planned): Estimate {
  const { model, options, told, kit } = planned;
  const { format, mesh } = options;
  const things = thingsOf(model);
  if (mesh === 'points') return { triangles: 0, objects: things.length, bytes: BYTES_A_POINT * things.length + BYTES_AROUND };
  const levels = levelSizes(model, options);
  const measured: Measured = { ...planned, things, levels };
  const [finest] = levels as [Sizes];
  const triangles = sum(kit ? things.flatMap((thing) => kindBodies(model, thing, kit)) : allBodies(model), finest.triangles);
  const apart = mesh === 'rocks' || mesh === 'kit';
  const objects = apart ? things.length : new Set(model.groupOf).size;
  const vertices = sum(allBodies(model), finest.vertices);
  const bytes = {
    glb: () => glbBytes(measured),
    obj: () => objBytes(measured),
    stl: () => STL_HEADER + STL_TRIANGLE * triangles,
    ply: () => plyHeader(told, vertices, triangles).length + PLY_VERTEX * vertices + PLY_FACE * triangles,
  }[format as 'glb' | 'obj' | 'stl' | 'ply']();
  return { triangles, objects, bytes };
}

function allBodies({ groupOf }: Model): Iterable<number> {
  return groupOf.keys();
}

/** Those that an object of a kit consists of. */
function kindBodies(model: Model, { group, bodies }: Thing, { kinds, kindOf }: Kit): readonly number[] {
  return isOneThing(model, group) ? bodies : [kinds[kindOf[bodies[0]!]!]!];
}

function sum(bodies: Iterable<number>, numbers: Uint32Array): number {
  let total = 0;
  for (const k of bodies) total += numbers[k]!;
  return total;
}

/** How large all bodies are at each level; of coarser ones, how large they are at most. */
function levelSizes(model: Model, { solid, lods }: ResolvedOptions): Sizes[] {
  const { groups, groupOf, vertexStarts, indexStarts } = model;
  const levels = Array.from({ length: lods }, () => ({
    vertices: new Uint32Array(groupOf.length),
    triangles: new Uint32Array(groupOf.length),
  }));
  for (let k = 0; k < groupOf.length; k++) {
    let vertices = vertexStarts[k + 1]! - vertexStarts[k]!;
    let triangles = (indexStarts[k + 1]! - indexStarts[k]!) / 3;
    const { isOpenBelow } = groups[groupOf[k]!]!;
    const rim = isOpenBelow ? rimOf(vertices, triangles) : 0;
    const bottom = solid && rim > 0 ? rim : 0;
    for (const level of levels) {
      level.vertices[k] = vertices + (bottom > 0 ? bottom + 1 : 0);
      level.triangles[k] = triangles + bottom;
      // How many triangles the border of other bodies needs is not known.
      if (!isOpenBelow) continue;
      triangles = Math.min(triangles, Math.ceil(LEFT_OVER * Math.max(SHARE * triangles, rim, LEAST)));
      vertices = Math.min(vertices, Math.ceil((triangles + rim) / 2) + 1);
    }
  }
  return levels;
}

function glbBytes(measured: Measured): number {
  const { model, options, things, levels, kit, images } = measured;
  const { mesh, instancing, vertexColors, hulls, compress } = options;
  const chosen = kit && new Set(kit.kinds);
  const isOne = (k: number): boolean => isOneThing(model, model.groupOf[k]!);
  const written = [...allBodies(model)].filter((k) => !chosen || chosen.has(k) || isOne(k));
  let [vertices, triangles, most] = [0, 0, 0];
  for (const sizes of levels) {
    vertices += sum(written, sizes.vertices);
    triangles += sum(written, sizes.triangles);
    most = Math.max(most, mostOf(model, written, sizes.vertices, mesh === 'one'));
  }
  const indexBytes = indexBytesFor(most);
  const hullCount =
    hulls === 'none' ? 0 : things.filter(({ group, bodies }) => !isOneThing(model, group) && (!chosen || chosen.has(bodies[0]!))).length;
  const binary =
    (PLAIN_BYTES + (vertexColors ? COLOR_BYTES : 0) + (images ? TEXTURED_BYTES : 0) + (mesh === 'one' ? ID_BYTES : 0)) * vertices +
    padded(3 * indexBytes * triangles) +
    (kit && instancing ? INSTANCE_BYTES * instancesOf(model) : 0) +
    Object.values(images ?? {}).reduce((length, { length: own }) => length + padded(own), 0) +
    hullCount * (12 * MOST_VERTICES + 6 * indexBytes * (MOST_VERTICES - 2));
  const json = jsonBytes(measured, vertices);
  return GLB_HEADS + padded(Math.round(json)) + binary + (compress ? BYTES_AROUND : 0);
}

function padded(length: number): number {
  return 4 * Math.ceil(length / 4);
}

/** How many vertices the largest primitive has: a body, or where layers are meshes all of one material in a layer. */
function mostOf({ groupOf, materialOf }: Model, written: readonly number[], vertices: Uint32Array, areMerged: boolean): number {
  const sums = new Map<number, number>();
  let most = 0;
  for (const k of written) {
    const key = 256 * groupOf[k]! + materialOf[k]!;
    const own = vertices[k]! + (areMerged ? (sums.get(key) ?? 0) : 0);
    if (areMerged) sums.set(key, own);
    most = Math.max(most, own);
  }
  return most;
}

/** What is known of a JSON part. Its digits are those of numbers that get longer the more there is in the file. */
interface JsonFacts {
  length: number;
  nodes: number;
  meshes: number;
  accessors: number;
  /** Bytes of vertices' positions. */
  stretch: number;
}

const COUNTED = ['length', 'nodes', 'meshes', 'accessors'] as const;

/**
 * The JSON part is written of some of the things twice: of what there is one of, and one of each kind; and of others too, evenly chosen among
 * all. What has been added is what all others add.
 */
function jsonBytes(measured: Measured, vertices: number): number {
  const { model, options, things, kit } = measured;
  const written = (chosen: readonly Thing[]): JsonFacts => jsonOf(measured, chosen);
  if (options.mesh === 'one') return written(things).length;
  const kinds = new Set(kit?.kinds);
  const seen = new Set<number>();
  const isFirst = ({ group, bodies: [k] }: Thing): boolean => {
    const key = 256 * group + model.materialOf[k!]!;
    return !seen.has(key) && !!seen.add(key);
  };
  const [base, others]: [Thing[], Thing[]] = [[], []];
  for (const thing of things) (isOneThing(model, thing.group) || kinds.has(thing.bodies[0]!) || isFirst(thing) ? base : others).push(thing);
  const few = evenly(others.length, THINGS).map((k) => others[k]!);
  const one = written(base);
  if (few.length === 0) return one.length;
  const two = written(inOrder([...base, ...few]));
  const whole: JsonFacts = { ...two, stretch: 12 * vertices };
  const [first, second] = [one, two].map((facts): JsonFacts => ({ ...facts, length: facts.length - digitsOf(facts) })) as [
    JsonFacts,
    JsonFacts,
  ];
  for (const key of COUNTED) whole[key] = first[key] + ((second[key] - first[key]) * others.length) / few.length;
  return whole.length + digitsOf(whole);
}

function inOrder(things: readonly Thing[]): Thing[] {
  return things.toSorted(({ bodies: [one] }, { bodies: [other] }) => one! - other!);
}

function digitsOf({ nodes, meshes, accessors, stretch }: JsonFacts): number {
  // An accessor has an offset, and is named by a primitive; a node names its mesh, and is named by the one above it.
  return accessors * (meanDigits(stretch) + meanDigits(accessors)) + nodes * (meanDigits(meshes) + meanDigits(nodes));
}

/** How many digits the numbers from 0 to below `end` have, in the mean. */
function meanDigits(end: number): number {
  let mean = 1;
  for (let power = 10; power < end; power *= 10) mean += (end - power) / end;
  return mean;
}

/** The JSON part of a file of some of the things, whose coarser levels and hulls are taken to be as they are. */
function jsonOf({ model, options, told, kit, images }: Planned, things: readonly Thing[]): JsonFacts {
  const { solid, lods, hulls } = options;
  const bodies = things.flatMap((thing) => thing.bodies).sort((a, b) => a - b);
  const isWhole = bodies.length === model.groupOf.length;
  const open = isWhole ? model : someOf(model, bodies);
  const some = {
    ...(solid && !isWhole ? closed(open) : open),
    ...(images && { textures: { side: 1, vertices: new Float32Array(0), images } }),
  };
  const shapes = {
    levels: Array.from({ length: lods }, () => some),
    hulls: hulls === 'none' ? undefined : some,
    hullName: hulls === 'none' ? (object: string) => object : HULL_NAMES[hulls],
  };
  const { json, steps, layout, meshes } = describe(
    shapes,
    options,
    { ...told, body: (out, k) => told.body(out, bodies[k]!) },
    kit && kitOfSome(kit, bodies),
  );
  for (const _ of steps);
  const length = json.pieces().reduce((total, piece) => total + piece.length, 0);
  const { views } = layout;
  const perPrimitive = 1 + VERTEX_VIEWS.filter((name) => views[name]).length;
  return {
    length,
    nodes: json.counts.nodes,
    meshes: meshes.all.length,
    accessors: perPrimitive * layout.places.length,
    stretch: views.positions?.length ?? 0,
  };
}

/** @param bodies with all of the kinds' own. */
function kitOfSome({ kinds, kindOf, frames }: Kit, bodies: readonly number[]): Kit {
  const places = new Map(bodies.map((k, at) => [k, at]));
  return {
    kinds: kinds.map((k) => places.get(k)!),
    kindOf: Uint32Array.from(bodies, (k) => kindOf[k]!),
    frames: bodies.map((k) => frames[k]!),
  };
}

/** A coordinate on the ground is 0, and a normal that points down has three numbers of four letters. */
const DOWN_LETTERS = 4;
/** Of a vertex, its normal and a triangle of an OBJ, what is no number. */
const [VERTEX_LETTERS, FACE_LETTERS, FACE_NUMBERS] = [11, 11, 6];

function objBytes({ model, options, told, things, levels }: Measured): number {
  const { groupOf, groups, materialOf, materials, vertexStarts } = model;
  const [own, normal] = lettersOf(model, options, evenly(model.positions.length / 3, VERTICES));
  // What closes rocks from below has the places of their rims.
  const [onRim] = options.solid ? lettersOf(model, options, onRims(model)) : [0];
  let bytes = new TextEncoder().encode(objHeader(told)).length;
  let first = 1;
  const objects = new Map(options.mesh === 'rocks' ? things.map(({ name, bodies: [k] }) => [k!, name]) : []);
  levels.forEach(({ vertices, triangles }, level) => {
    const suffix = levelName('', level, levels.length).length;
    let [group, material] = [-1, -1];
    for (let k = 0; k < groupOf.length; k++) {
      const isOther = groupOf[k] !== group;
      group = groupOf[k]!;
      const object = options.mesh === 'rocks' ? objects.get(k) : isOther ? groups[group]!.name : undefined;
      if (object !== undefined) bytes += 3 + object.length + suffix;
      if (isOther) bytes += 3 + groups[group]!.name.length;
      if (isOther || materialOf[k] !== material) {
        material = materialOf[k]!;
        bytes += 8 + materials[material]!.name.length;
      }
      const added = Math.max(0, vertices[k]! - (vertexStarts[k + 1]! - vertexStarts[k]!));
      bytes += (vertices[k]! - added) * (VERTEX_LETTERS + own + normal) + added * (VERTEX_LETTERS + onRim + DOWN_LETTERS);
      bytes += triangles[k]! * (FACE_LETTERS + FACE_NUMBERS * String(first + (vertices[k]! >> 1)).length);
      first += vertices[k]!;
    }
  });
  return Math.round(bytes);
}

/** Some of the vertices on which rocks stand. */
function onRims({ groupOf, groups, vertexStarts, indexStarts }: Model): number[] {
  const rocks = [...groupOf.keys()].filter((k) => groups[groupOf[k]!]!.isOpenBelow);
  return evenly(rocks.length, THINGS).flatMap((at) => {
    const [first, end] = [vertexStarts[rocks[at]!]!, vertexStarts[rocks[at]! + 1]!];
    const rim = rimOf(end - first, (indexStarts[rocks[at]! + 1]! - indexStarts[rocks[at]!]!) / 3);
    return evenly(rim, VERTICES / THINGS).map((v) => first + v);
  });
}

/** The numbers from 0 to below `count`, or so many of them. */
function evenly(count: number, most: number): number[] {
  const some = Math.min(count, most);
  return Array.from({ length: some }, (_, k) => Math.floor(((k + 0.5) * count) / some));
}

/** How many letters the numbers of a vertex have in the mean, and those of its normal. */
function lettersOf({ positions, normals, unit, centre }: Model, options: ResolvedOptions, vertices: readonly number[]): [number, number] {
  if (vertices.length === 0) return [0, 0];
  const some = (list: Float32Array): Float32Array => Float32Array.from(vertices.flatMap((v) => [...list.subarray(3 * v, 3 * v + 3)]));
  const inUnits = inFile({ positions: some(positions), normals: some(normals), unit, centre }, options);
  return [inUnits.positions, inUnits.normals].map((list) => {
    const out = new ByteWriter();
    for (const value of list) out.decimal(value);
    return out.length / vertices.length;
  }) as [number, number];
}
