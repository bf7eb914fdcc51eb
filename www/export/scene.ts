/** A model as arrays for a scene graph: the same numbers as in a GLB, metres and y up, without the file around them. */

import { closed } from './shapes/solid.ts';
import { fillMeshes, floatsOf, layoutOf, shortsOf } from './gltf/gltf-buffers.ts';
import type { Place } from './gltf/gltf-buffers.ts';
import { allMeshes } from './gltf/gltf-parts.ts';
import type { Mesh } from './gltf/gltf-parts.ts';
import { toldOf } from './file.ts';
import type { Source } from './file.ts';
import { kitOf } from './shapes/kit.ts';
import type { Kit } from './shapes/kit.ts';
import { levelsOf } from './shapes/lods.ts';
import { isOneThing, numbersOf } from './model.ts';
import type { Material, Model } from './model.ts';
import type { ResolvedOptions } from './options.ts';
import { originOf } from './origin/origin.ts';
import type { Origin } from './origin/origin.ts';
import { Pace } from './pace.ts';
import type { Waiting } from './pace.ts';
import { placementOf, translationOf } from './shapes/placement.ts';
import { checkFits } from './too-large.ts';

/** Plain data, so that it can be made on another thread. */
export interface SceneParts {
  /** As a file would be called. */
  title: string;
  origin: Origin;
  groups: SceneGroup[];
  materials: Material[];
  /** Of all meshes and shapes, one after the other. Three numbers for each vertex. */
  positions: Float32Array;
  normals: Float32Array;
  /** Four numbers for each vertex, linear, 65535 is 1; empty where every mesh has one material, and rocks have colours of their own. */
  colors: Uint16Array;
  /** For each vertex the number of its rock, less 1; empty where there are shapes. */
  ids: Float32Array;
  /** Each mesh and shape begins with 0. */
  indices: Uint16Array | Uint32Array;
  /** What is drawn once. */
  meshes: SceneMesh[];
  /** What is drawn many times, or at several levels of detail; undefined of mesh `one`. */
  bodies?: SceneBodies | undefined;
}

/** What belongs together: the rocks of a layer, or the ground. */
export interface SceneGroup {
  name: string;
  /** As a file has them. */
  extras: Record<string, unknown>;
  hasRocks: boolean;
}

export interface SceneMesh {
  group: number;
  /** One for each material, one after the other. */
  places: Place[];
  /** In `materials`. */
  material: number;
}

/** Rocks that are placed one by one. */
export interface SceneBodies {
  /** How many levels of detail each shape has. */
  levels: number;
  /** The levels of the first shape, the finest first, then those of the next. */
  places: Place[];
  /** For each rock the number of its shape. */
  shapes: Uint32Array;
  /** For each rock sixteen numbers, column by column. */
  matrices: Float32Array;
  /** For each rock its number, from 1 on. */
  numbers: Uint32Array;
  groupOf: Uint8Array;
  materialOf: Uint8Array;
}

/** As long as a hash, before there is one. */
const NO_HASH = '0'.repeat(64);
/** The share of the work that is done when a kit is chosen, and when levels of detail are there. */
const [KIT_SHARE, LEVELS_SHARE] = [0.1, 0.7];

/**
 * @param open the model, open below; `options.solid` closes it.
 * @throws {RockFieldError} `ExportTooLarge`, before anything is allocated.
 * @throws the reason of the signal when it was aborted.
 */
export async function sceneOf(open: Model, source: Source, options: ResolvedOptions, waiting?: Waiting): Promise<SceneParts> {
  const { mesh: form, kinds, solid, lods } = options;
  const pace = new Pace(waiting);
  const kit = form === 'kit' ? await kitOf(open, kinds, pace.within(0, KIT_SHARE)) : undefined;
  checkFits({ model: open, options, told: toldOf(open, source, NO_HASH), kit });
  const hash = await source.hash();
  const chosen = kit && new Set(kit.kinds);
  const isPlaced = (k: number): boolean => !isOneThing(open, open.groupOf[k]!) && (!chosen || chosen.has(k));
  const levels = await levelsOf(solid ? closed(open) : open, open, lods, isPlaced, pace.within(KIT_SHARE, LEVELS_SHARE));
  const model = levels[0]!;
  const { own, all } = allMeshes({ levels, hullName: (name) => name }, form, kit);
  const isOne = form === 'one';
  // Of what is drawn once only the finest level is there.
  const drawn = all.filter(({ group }, m) => m < own.length || !isOneThing(model, group));
  const layout = layoutOf(drawn, { withIds: isOne, withColors: isOne, instances: 0, images: undefined });
  const bytes = new Uint8Array(layout.length);
  await fillMeshes(model, drawn, layout, bytes, pace.within(LEVELS_SHARE, 1));
  const { views, places, indexBytes } = layout;
  const { offset = 0, length = 0 } = views.indices ?? {};
  const placesOf = placesByMesh(drawn, places);
  const once = drawn.filter(({ group }, m) => m < own.length && (isOne || isOneThing(model, group)));
  return {
    title: source.title,
    origin: originOf({ link: source.link, hash, metresPerPixel: model.unit }),
    groups: model.groups.map(({ name, extras }, group) => ({ name, extras, hasRocks: !isOneThing(model, group) })),
    materials: model.materials,
    positions: floatsOf(bytes, views.positions),
    normals: floatsOf(bytes, views.normals),
    colors: shortsOf(bytes, views.colors),
    ids: floatsOf(bytes, views.ids),
    indices: new (indexBytes === 2 ? Uint16Array : Uint32Array)(bytes.buffer, offset, length / indexBytes),
    meshes: once.map((mesh) => ({ group: mesh.group, places: placesOf.get(mesh)!, material: mesh.parts[0]!.material! })),
    ...(!isOne && { bodies: bodiesOf(model, drawn, own.length, lods, placesOf, kit) }),
  };
}

/** What may be handed over to another thread. */
export function buffersOf({ positions, bodies }: SceneParts): ArrayBuffer[] {
  const own = bodies ? [bodies.shapes, bodies.matrices, bodies.numbers] : [];
  return [...new Set([positions, ...own].map(({ buffer }) => buffer as ArrayBuffer))];
}

function placesByMesh(meshes: readonly Mesh[], places: readonly Place[]): Map<Mesh, Place[]> {
  let end = 0;
  return new Map(
    meshes.map((mesh) => {
      end += mesh.parts.length;
      return [mesh, places.slice(end - mesh.parts.length, end)];
    }),
  );
}

/** @param count how many meshes the finest level has, which come first. */
function bodiesOf(
  model: Model,
  meshes: readonly Mesh[],
  count: number,
  levels: number,
  placesOf: ReadonlyMap<Mesh, Place[]>,
  kit: Kit | undefined,
): SceneBodies {
  const isPlaced = (group: number): boolean => !isOneThing(model, group);
  const finest = meshes.slice(0, count);
  const coarser = meshes.slice(count);
  const placed = finest.filter(({ group }) => isPlaced(group));
  const places = placed.flatMap((mesh, shape) =>
    Array.from({ length: levels }, (_, level) => {
      const own = level === 0 ? mesh : coarser[(level - 1) * placed.length + shape]!;
      return placesOf.get(own)![0]!;
    }),
  );
  // Which shape a body is, of those that have one.
  const shapes = new Map(placed.map(({ parts }, shape) => [parts[0]!.bodies[0]!, shape]));
  const shapeOf = (k: number): number => shapes.get(kit ? kit.kinds[kit.kindOf[k]!]! : k)!;
  // Those of a shape follow each other: WebGPURenderer draws such a row at once.
  const bodies = [...model.groupOf.keys()].filter((k) => isPlaced(model.groupOf[k]!)).sort((a, b) => shapeOf(a) - shapeOf(b) || a - b);
  const numbers = numbersOf(model);
  const matrices = new Float32Array(16 * bodies.length);
  bodies.forEach((k, at) => {
    writeMatrix(matrices, 16 * at, model, k, kit);
  });
  return {
    levels,
    places,
    shapes: Uint32Array.from(bodies, shapeOf),
    matrices,
    numbers: Uint32Array.from(bodies, (k) => numbers[k]!),
    groupOf: Uint8Array.from(bodies, (k) => model.groupOf[k]!),
    materialOf: Uint8Array.from(bodies, (k) => model.materialOf[k]!),
  };
}

/** Where a body stands. The parts of a kit are turned about the vertical axis and stretched. */
function writeMatrix(to: Float32Array, at: number, model: Model, k: number, kit: Kit | undefined): void {
  const { translation, rotation, scale } = kit
    ? placementOf(model, k, kit)
    : { translation: translationOf(model, k), rotation: [0, 0, 0, 1] as const, scale: [1, 1, 1] as const };
  const [, y, , w] = rotation;
  const [cos, sin] = [1 - 2 * y * y, 2 * y * w];
  to.set([cos * scale[0], 0, 0 - sin * scale[0], 0, 0, scale[1], 0, 0, sin * scale[2], 0, cos * scale[2], 0, ...translation, 1], at);
}
