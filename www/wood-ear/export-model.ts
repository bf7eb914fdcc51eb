/** A colony and its log as bodies: each ear is a thing of two parts, its inner side and the rest, and the log one of its kinds of wood. */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import { WOOD } from '../data/palette.gen.ts';
import { crossesItself, isClosed } from '../export/shapes/crossings.ts';
import type { Note } from '../export/file.ts';
import { sizeOf } from '../export/shapes/measures.ts';
import type { Group, Model } from '../export/model.ts';
import type { ResolvedOptions } from '../export/options.ts';
import type { Pace } from '../export/pace.ts';
import { compact, earsOf, partsOf, thickened } from './ear-parts.ts';
import type { Ears, Part } from './ear-parts.ts';
import { fleshOf, woodMaterials } from './materials.ts';
import { placesOnLog } from './feet.ts';
import type { WoodEarSceneParams } from './table.ts';

/** How thick sheets become that shall be solid, cm: as wet wood ears are. */
const SHEET = 0.15;

export interface ColonyModel {
  /** Of which a unit is a cm; z up, about the log's own origin. */
  model: Model;
  /** What is said of the thing whose first body this is. */
  extras: (body: number) => Record<string, unknown>;
  notes: Note[];
}

export async function colonyModel(
  colony: WoodEarColony,
  params: WoodEarSceneParams,
  options: ResolvedOptions,
  isNatural: boolean,
  pace: Pace,
): Promise<ColonyModel> {
  const { solid, metresPerPixel: unit } = options;
  const grown = earsOf(colony, params);
  const ears = solid ? thickened(grown, SHEET) : grown;
  const flesh = fleshOf(params, isNatural, ears.isThick);
  const earParts = partsOf(ears);
  const log = logParts(colony.log);
  // A log that is made is closed.
  const isLogOpen = params.mesh !== null && !isClosed(colony.log);
  const crossing = solid ? await crossingEars(ears, pace) : new Set<number>();
  const bases = params.bases.length;
  const bodies = ears.count * earParts.length;
  const groups: Group[] = params.bases.map(({ range }, base) => ({
    name: `colony-${base + 1}`,
    noun: 'ear',
    parts: earParts.length,
    extras: { colony: base + 1, range: rounded(unit * (range ?? params.range)) },
  }));
  groups.push({
    name: 'log',
    extras: {
      size: sizeOf(colony.log.positions, 0, colony.log.positions.length / 3, unit).map(rounded),
      ...(solid && isLogOpen && { solid: false }),
    },
  });
  const feet = placesOnLog(colony, params);
  const model: Model = {
    unit,
    ...meshOf(ears, earParts, colony.log, log),
    groupOf: Uint8Array.from({ length: bodies + log.length }, (_, body) =>
      body < bodies ? colony.base[Math.floor(body / earParts.length)]! : bases,
    ),
    groups,
    materialOf: Uint8Array.from({ length: bodies + log.length }, (_, body) => {
      if (body >= bodies) return flesh.materials.length + log[body - bodies]!.kind;
      return flesh.of(colony.foot[Math.floor(body / earParts.length)]!)[body % earParts.length]!;
    }),
    materials: [...flesh.materials, ...woodMaterials(isNatural, isLogOpen)],
    origins: Float64Array.from({ length: 3 * (bodies + log.length) }, (_, k) =>
      k < 3 * bodies ? feet[3 * Math.floor(k / 3 / earParts.length) + (k % 3)]! : 0,
    ),
    centre: [0, 0, 0],
  };
  const notes: Note[] = [];
  if (solid && !grown.isThick && grown.count > 0) notes.push({ code: 'thickened' });
  if (crossing.size > 0) notes.push({ code: 'crosses-itself', count: crossing.size });
  if (solid && isLogOpen) notes.push({ code: 'open-log' });
  const extras = (body: number): Record<string, unknown> => {
    if (body >= bodies) return {};
    const ear = body / earParts.length;
    return {
      id: ear + 1,
      colony: colony.base[ear]! + 1,
      radius: rounded(unit * colony.size[ear]!),
      ...measured(ears, ear, unit),
      ...(params.thickness > 0 && { thickness: rounded(unit * params.thickness) }),
      ...(crossing.has(ear) && { solid: false }),
    };
  };
  return { model, extras, notes };
}

/** Those that pass through themselves. */
async function crossingEars(ears: Ears, pace: Pace): Promise<Set<number>> {
  const crossing = new Set<number>();
  for (let ear = 0; ear < ears.count; ear++) {
    if (crossesItself(earOf(ears, ear))) crossing.add(ear);
    if (pace.isDue()) await pace.rest(ear / ears.count);
  }
  return crossing;
}

/** An ear by itself. */
function earOf({ positions, vertices, triangles }: Ears, ear: number): Pick<Model, 'positions' | 'indices'> {
  return { positions: positions.subarray(3 * vertices * ear, 3 * vertices * (ear + 1)), indices: triangles };
}

/** The area of its inner side, m², and its size; the volume, m³, of one that is closed. */
function measured(ears: Ears, ear: number, unit: number): Record<string, unknown> {
  const { positions, indices } = earOf(ears, ear);
  let [twiceArea, sixfold] = [0, 0];
  const [ox, oy, oz] = [positions[0]!, positions[1]!, positions[2]!];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const [ux, uy, uz] = [positions[b]! - positions[a]!, positions[b + 1]! - positions[a + 1]!, positions[b + 2]! - positions[a + 2]!];
    const [vx, vy, vz] = [positions[c]! - positions[a]!, positions[c + 1]! - positions[a + 1]!, positions[c + 2]! - positions[a + 2]!];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    if (i < 3 * ears.inner) twiceArea += Math.sqrt(nx * nx + ny * ny + nz * nz);
    sixfold += (positions[a]! - ox) * nx + (positions[a + 1]! - oy) * ny + (positions[a + 2]! - oz) * nz;
  }
  return {
    area: rounded((unit * unit * twiceArea) / 2),
    ...(ears.isThick && { volume: rounded((unit * unit * unit * sixfold) / 6) }),
    size: sizeOf(positions, 0, positions.length / 3, unit).map(rounded),
  };
}

interface LogPart extends Part {
  /** Its place in `WOOD`. */
  kind: number;
}

/** The kinds of wood that there are. Of a triangle between two kinds, the one that more of its corners are of. */
function logParts({ indices, kinds }: WoodEarLog): LogPart[] {
  const lists = WOOD.map((): number[] => []);
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [indices[i]!, indices[i + 1]!, indices[i + 2]!] as const;
    const [a, b, c] = [kinds[corners[0]]!, kinds[corners[1]]!, kinds[corners[2]]!];
    const middle = Math.max(Math.min(a, b), Math.min(Math.max(a, b), c));
    lists[middle]!.push(...corners);
  }
  return lists.flatMap((list, kind) => (list.length > 0 ? [{ kind, ...compact(Uint32Array.from(list)) }] : []));
}

type Mesh = Pick<Model, 'positions' | 'normals' | 'indices' | 'indexStarts' | 'vertexStarts'>;

/** The parts of every ear, one ear after the other, and those of the log. */
function meshOf(ears: Ears, earParts: readonly Part[], log: WoodEarLog, own: readonly Part[]): Mesh {
  const sum = (parts: readonly Part[], of: (part: Part) => number): number => parts.reduce((all, part) => all + of(part), 0);
  const total = (of: (part: Part) => number): number => ears.count * sum(earParts, of) + sum(own, of);
  const vertices = total((part) => part.vertices.length);
  const bodies = ears.count * earParts.length + own.length;
  const mesh: Mesh = {
    positions: new Float32Array(3 * vertices),
    normals: new Float32Array(3 * vertices),
    indices: new Uint32Array(total((part) => part.triangles.length)),
    indexStarts: new Uint32Array(bodies + 1),
    vertexStarts: new Uint32Array(bodies + 1),
  };
  let [vertex, index, body] = [0, 0, 0];
  const add = (part: Part, from: Pick<Mesh, 'positions' | 'normals'>, first: number): void => {
    for (const corner of part.triangles) mesh.indices[index++] = vertex + corner;
    for (const one of part.vertices) {
      for (let axis = 0; axis < 3; axis++) {
        mesh.positions[3 * vertex + axis] = from.positions[3 * (first + one) + axis]!;
        mesh.normals[3 * vertex + axis] = from.normals[3 * (first + one) + axis]!;
      }
      vertex += 1;
    }
    body += 1;
    mesh.vertexStarts[body] = vertex;
    mesh.indexStarts[body] = index;
  };
  for (let ear = 0; ear < ears.count; ear++) for (const part of earParts) add(part, ears, ear * ears.vertices);
  for (const part of own) add(part, log, 0);
  return mesh;
}

/** Four digits: nobody measures a wood ear more closely. */
function rounded(value: number): number {
  return Number(value.toPrecision(4));
}
