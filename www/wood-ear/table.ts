/** The wood ears' generator, as the parts that all generators share know it: a colony on a log that lies on a ground of rocks. */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import { RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import type { WoodEarStage } from './session.ts';
import type { PresetName } from '../rocks/params.ts';
import { lazily } from '../base/lazy.ts';
import type { LogMesh } from './log-mesh.ts';
import { presetParams } from '../rocks/request.ts';
import type { Kind, Table } from '../table/table.ts';
import { encodeLink } from '../rocks/link.ts';
import { BASE_ROWS, COLONY_ROWS, LOG_ROWS, logName, resolveColony, woodEarPreset } from './request.ts';
import type { WoodEarBase, WoodEarParams, WoodEarPresetName, WoodEarRequest } from './request.ts';
import { MAX_BASES, WOOD_EAR_PRESETS } from './params.gen.ts';

/** Where the log's origin is on the ground, px, and px per cm. */
export type Place = readonly [x: number, y: number, z: number, scale: number];

export interface WoodEarScene {
  colony: WoodEarColony;
  /** The rocks around the log; without a ground there are none. */
  ground: Field;
  place: Place;
  /** Of the layout of an individual's vertices. */
  rings: number;
  meridians: number;
}

export interface WoodEarSceneParams extends WoodEarParams {
  /** What the log lies on: a link to a field of rocks, of which the size is the log's; empty for bare soil. */
  ground: string;
  /** A log of one's own, in place of the one that `log` describes. */
  mesh: LogMesh | null;
}

export type WoodEarSceneRequest = WoodEarRequest & { ground?: string | undefined; mesh?: LogMesh | null | undefined };

export interface WoodEars extends Kind {
  params: WoodEarSceneParams;
  item: WoodEarBase;
  preset: WoodEarPresetName;
  result: WoodEarScene;
  stage: WoodEarStage;
}

/** What logs lie on where they are found; with this seed no boulder stands in the light of a log. */
const FOUND_ON = groundOf('forest-floor', 9);
/** The longest link there can be, and some. */
const MAX_GROUND_LENGTH = 16_384;

/** A ground as it is found. */
export function groundOf(preset: PresetName, seed = 0): string {
  return encodeLink({ params: { ...presetParams(preset), seed }, preset });
}

function scenePreset(name: string): WoodEarSceneParams {
  const params = woodEarPreset(name);
  const isNatural = WOOD_EAR_PRESETS.some((preset) => preset.name === name && 'natural' in preset);
  return { ...params, ground: isNatural ? FOUND_ON : '', mesh: null };
}

function resolve({ ground, mesh, ...request }: WoodEarSceneRequest): WoodEarSceneParams {
  if (ground !== undefined && (typeof ground !== 'string' || ground.length > MAX_GROUND_LENGTH)) {
    throw new RockFieldError({
      name: 'WrongType',
      key: 'ground',
      value: ground,
      message: 'ground must be a link to a field of rocks, or empty',
    });
  }
  const resolved = resolveColony(request);
  return {
    ...resolved.params,
    ground: ground ?? scenePreset(request.preset ?? WOOD_EAR_PRESETS[0].name).ground,
    mesh: mesh ? flatMesh(mesh) : resolved.mesh,
  };
}

/** The same object where it is flat already and in cm: what was made of it is not made again. */
const flat = new WeakSet<LogMesh>();

function flatMesh(mesh: LogMesh): LogMesh | null {
  const isFlat = mesh.positions instanceof Float32Array && mesh.indices instanceof Uint32Array;
  if (isFlat && flat.has(mesh)) return mesh;
  const { positions, indices } = mesh;
  const made = resolveColony({ log: { positions, indices } }).mesh;
  const kept = isFlat && made?.scale === 1 ? mesh : made;
  if (kept) flat.add(kept);
  return kept;
}

const isOfLog = (key: string): boolean => /^log[A-Z]/.test(key);

export const WOOD_EARS: Table<WoodEars> = {
  rows: [...COLONY_ROWS.filter(({ stage }) => stage !== 'look'), ...LOG_ROWS, ...COLONY_ROWS.filter(({ stage }) => stage === 'look')],
  itemRows: BASE_ROWS,
  itemCount: { min: 1, max: MAX_BASES },
  presets: WOOD_EAR_PRESETS,
  views: ['3d', 'wireframe'],
  colors: ['plain', 'natural'],
  presetParams: scenePreset,
  items: ({ bases }) => bases,
  withItems: (params, bases) => ({ ...params, bases: [...bases] }),
  newItem: (index, { bases }) => ({
    position: [...(bases[index - 1] ?? bases[0] ?? { position: [0, 0, 0] as const }).position],
    range: null,
  }),
  boundsOf: (row) => row,
  unitOf: ({ unit }) => unit.px,
  read: (owner, { key, scope }) => {
    if (scope === 'base') {
      const base = owner as WoodEarBase;
      return key === 'range' ? base.range : base.position['xyz'.indexOf(key)];
    }
    const params = owner as unknown as Record<string, unknown>;
    return isOfLog(key) ? (params['log'] as Record<string, unknown>)[logName(key)] : params[key];
  },
  written: (owner, { key, scope }, value) => {
    if (isOfLog(key)) return { ...owner, log: { ...(owner as unknown as WoodEarParams).log, [logName(key)]: value } };
    if (scope === 'field' || key === 'range') return { ...owner, [key]: value };
    return { ...owner, position: (owner as WoodEarBase).position.map((old, k) => (k === 'xyz'.indexOf(key) ? value : old)) };
  },
  resolve,
  docs: async () => (await lazily(() => import('./param-docs.gen.ts'))).WOOD_EAR_DOCS,
  pictured: (params) => params,
  sameBesides: (one, other) => one.ground === other.ground && one.mesh === other.mesh,
};

/** What the generator is asked for. */
export function colonyRequest({ ground: _, mesh, ...params }: WoodEarSceneParams): WoodEarRequest {
  return mesh ? { ...params, log: { positions: mesh.positions, indices: mesh.indices, spacing: params.log.spacing } } : params;
}

/** Room round the log, as a share of its length and in cm. */
const MARGIN = { share: 0.5, cm: 120 };
/** A log of one's own has sunk so far into the soil, cm; one that is made lies on it as it is. */
const SUNK = 2;

/** Side of the square of ground, px. One cm is one px. */
export function groundSide({ log, mesh }: WoodEarSceneParams): number {
  const length = mesh ? extent(mesh.positions, 0) : log.length;
  return Math.ceil(length * (1 + 2 * MARGIN.share) + 2 * MARGIN.cm);
}

function extent(positions: Float32Array, axis: number): number {
  const [low, high] = bounds(positions, axis);
  return high - low;
}

function bounds(positions: Float32Array, axis: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (let i = axis; i < positions.length; i += 3) {
    const value = positions[i] ?? 0;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

export function placeOf(log: WoodEarLog, params: WoodEarSceneParams): Place {
  const middle = groundSide(params) / 2;
  return [middle, middle, params.mesh ? -bounds(log.positions, 2)[0] - SUNK : 0, 1];
}
