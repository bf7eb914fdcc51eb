/** Fields of rocks as files. */

import type { Field } from '../data/field.ts';
import { STONE, STONE_KINDS } from '../data/palette.gen.ts';
import { exportModel } from '../export/file.ts';
import type { ExportedFile, Note, Source } from '../export/file.ts';
import type { Model } from '../export/model.ts';
import { isMap, resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';
import { coloured } from '../export/origin/written-options.ts';
import { GENERATED, Pace } from '../export/pace.ts';
import type { Waiting } from '../export/pace.ts';
import type { Progress, StageName } from '../generator/protocol.ts';
import { sceneOf } from '../export/scene.ts';
import type { SceneParts } from '../export/scene.ts';
import { checkRun } from '../generator/run-checks.ts';
import { cutAtGround } from '../export/shapes/cut.ts';
import { laidOut } from '../export/textures/textured.ts';
import type { Baked, Laid } from '../export/textures/textured.ts';
import type { GenerateOptions } from './headless.ts';
import { fieldHash } from './hash.ts';
import { withGround } from './ground.ts';
import type { GroundRealm } from './ground.ts';
import { linearColor } from './linear.ts';
import { encodeLink } from './link.ts';
import type { Params, PresetName } from './params.ts';
import { resolvePainted } from './painted.ts';
import type { PaintedRequest } from './painted.ts';
import { stoneKinds } from './stone-kinds.ts';
import { ROCKS } from './table.ts';
import { presetColor } from '../table/table.ts';

/** Where a field comes from. */
export interface FieldSource {
  params: Params;
  /** The preset that the parameters began with, if any: the file is named after it. */
  preset?: PresetName | undefined;
}

/**
 * A field as a file. The same field and options give the same bytes everywhere.
 *
 * @param ground what makes the ground, if the options ask for it.
 * @param baked what a renderer has drawn, if `options` asks for textures.
 * @throws {RockFieldError} `ExportTooLarge`, before anything is allocated.
 */
export async function exportField(
  field: Field,
  source: FieldSource,
  options: ResolvedOptions,
  ground: GroundRealm,
  waiting?: Waiting,
  baked?: Baked,
): Promise<ExportedFile> {
  const { model, about, written } = await modelOf(field, source, options, ground, waiting?.signal);
  return exportModel(model, about, written, waiting, baked);
}

/**
 * A field as arrays for a scene graph, of which an export with the same options has the same numbers.
 *
 * @throws {RockFieldError} `ExportTooLarge`, before anything is allocated.
 */
export async function fieldScene(
  field: Field,
  source: FieldSource,
  options: ResolvedOptions,
  ground: GroundRealm,
  waiting?: Waiting,
): Promise<SceneParts> {
  const { model, about } = await modelOf(field, source, options, ground, waiting?.signal);
  return sceneOf(model, about, options, waiting);
}

/** The rocks, with the ground if the options ask for it, and what a file says about them. */
async function modelOf(
  field: Field,
  { params, preset }: FieldSource,
  options: ResolvedOptions,
  ground: GroundRealm,
  signal: AbortSignal | undefined,
): Promise<{ model: Model; about: Source; written: ResolvedOptions }> {
  const { isNatural, options: written } = coloured(options, presetColor(ROCKS, preset ?? '') === 'natural');
  const about = {
    title: `${preset ?? 'rock-field'}-${params.seed}`,
    link: encodeLink({ params, ...(preset !== undefined && { preset }) }),
    hash: () => fieldHash(field),
    hasPatterns: isNatural,
    extrasOf: (rock: number) => rockExtras(field, params, rock),
    notes: showSkirts(params, options) ? [{ code: 'below-ground' } satisfies Note] : [],
  };
  const rocks = await writtenRocks(field, params, options, isNatural, signal);
  return { model: await withGround(rocks, field, params, options, isNatural, ground), about, written };
}

/**
 * Lays the rocks of a field out for textures, which a renderer draws then.
 *
 * @throws {RockFieldError} `ExportTooLarge` where there are too many.
 */
export async function layOutField(
  field: Field,
  params: Params,
  options: ResolvedOptions,
  onProgress?: (fraction: number) => void,
): Promise<Laid> {
  return laidOut(await writtenRocks(field, params, options, true), options, onProgress);
}

/** Whether what lies below the ground can be seen. */
function showSkirts({ layers }: Params, options: ResolvedOptions): boolean {
  const { belowGround, groundMesh, mesh } = options;
  if (belowGround === 'cut' || groundMesh !== 'none' || mesh === 'points' || isMap(options)) return false;
  return layers.some(({ weathering, embedding }) => weathering > 0 || embedding > 0);
}

/** What is said of a body beside its measures: of a rock. The ground comes after all of them, and says itself what it is. */
export function rockExtras({ rockLayer }: Field, { layers }: Params, rock: number): Record<string, unknown> {
  if (rock >= rockLayer.length) return {};
  return { id: rock + 1, layer: layers[rockLayer[rock]!]!.id };
}

/** As of `generate`; progress goes on while the file is written, in the stage `file`. */
export interface ExportRun extends Omit<GenerateOptions, 'onProgress'> {
  /** Called every 16 ms or so. */
  onProgress?: ((progress: Progress<StageName | 'file'>) => void) | undefined;
}

/**
 * Generates and exports in one call: what `entries/export.ts` and `export.node.ts` share.
 *
 * @param tools `generate` of `rock-field/core`; what makes the ground.
 * @throws {RockFieldError} about a parameter, about an option, or `ExportTooLarge`.
 */
export async function exportWith(
  { generate, ground }: { generate: (request?: PaintedRequest, options?: GenerateOptions) => Promise<Field>; ground: GroundRealm },
  request: PaintedRequest | undefined,
  options: ExportOptions | undefined,
  waiting: ExportRun = {},
): Promise<ExportedFile> {
  // All of it is read now: what the caller does to the objects afterwards is no part of the request.
  const { onProgress, ...run } = checkRun(waiting, 'run');
  const resolved = resolveOptions(options);
  const { params, mask } = resolvePainted(request);
  const preset = request?.preset;
  const field = await generate(mask ? { ...params, mask } : params, {
    ...run,
    onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GENERATED * progress.fraction })),
  });
  run.signal?.throwIfAborted();
  return exportField(field, { params, preset }, resolved, ground, {
    signal: run.signal,
    onProgress: onProgress && ((fraction) => onProgress({ stage: 'file', fraction: GENERATED + (1 - GENERATED) * fraction })),
  });
}

/** The rocks of a field as they are written: whole, or what is above the ground. */
export async function writtenRocks(
  field: Field,
  params: Params,
  options: ResolvedOptions,
  isNatural: boolean,
  signal?: AbortSignal,
): Promise<Model> {
  const model = rocksModel(field, params, options.metresPerPixel, isNatural);
  const isCut = options.belowGround === 'cut' && options.mesh !== 'points' && !isMap(options);
  return isCut ? cutAtGround(model, new Pace({ signal })) : model;
}

/**
 * The rocks of a field. A rock stands in the middle of its box, seen from above, on z = 0, whether its rim lies there or, embedded, below.
 *
 * @param field as it was generated; its buffers are used as they are.
 * @param params that it was generated from.
 */
export function rocksModel(field: Field, params: Params, metresPerPixel: number, isNatural: boolean): Model {
  const { positions, normals, indices, rockStarts, vertexStarts, rockLayer, imageWidth, imageHeight } = field;
  return {
    unit: metresPerPixel,
    positions,
    normals,
    indices,
    indexStarts: rockStarts,
    vertexStarts,
    groupOf: rockLayer,
    groups: field.layers.map(({ id, radius }, index) => ({
      name: `layer-${index + 1}`,
      noun: 'rock',
      isOpenBelow: true,
      extras: { layer: id, radius: radius * metresPerPixel, material: params.layers[index]!.material },
    })),
    materialOf: isNatural ? stoneKinds(field, params) : rockLayer,
    materials: isNatural
      ? STONE_KINDS.map(({ name, albedo }) => ({ name, color: albedo }))
      : field.layers.map(({ id }, index) => ({
          name: `layer-${index + 1}`,
          color: linearColor(STONE[id % STONE.length]!),
        })),
    origins: standingPlaces(field),
    centre: [imageWidth / 2, imageHeight / 2, 0],
    ground: { size: [imageWidth, imageHeight], gravel: areSmall(field.layers.map(({ radius }) => radius)) },
  };
}

/** For each radius, whether it is below the geometric mean of the smallest and the largest. */
function areSmall(radii: readonly number[]): boolean[] {
  const limit = Math.min(...radii) * Math.max(...radii);
  return radii.map((radius) => radius * radius < limit);
}

/** For each rock x, y, z: the middle of the box around all of its vertices, seen from above, and 0. */
function standingPlaces({ positions, vertexStarts, rockLayer }: Field): Float64Array {
  const places = new Float64Array(3 * rockLayer.length);
  for (let rock = 0; rock < rockLayer.length; rock++) {
    let left = Infinity;
    let right = -Infinity;
    let near = Infinity;
    let far = -Infinity;
    for (let v = 3 * vertexStarts[rock]!; v < 3 * vertexStarts[rock + 1]!; v += 3) {
      const x = positions[v]!;
      const y = positions[v + 1]!;
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < near) near = y;
      if (y > far) far = y;
    }
    places[3 * rock] = (left + right) / 2;
    places[3 * rock + 1] = (near + far) / 2;
  }
  return places;
}
