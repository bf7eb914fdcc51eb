/** The meshes of a glTF file. */

import type { Kit } from '../shapes/kit.ts';
import { thingsOf } from '../model.ts';
import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';

/** What one material covers of a mesh: a primitive of the file. */
export interface Part {
  /** Which its vertices and triangles are of: a level of detail, or the hulls. */
  model: Model;
  /** None of a hull, which has no normals either. */
  material: number | undefined;
  bodies: readonly number[];
  /** The part of a finer level that has the same vertices and triangles: they are in the file once. */
  sameAs?: Part | undefined;
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

/** All meshes of the file: those of the finest level, those of the next in the same order …, and the hulls. */
export interface Meshes {
  all: readonly Mesh[];
  /** Those of the finest level, whose names have no level. */
  own: readonly Mesh[];
  levels: number;
  /** For each mesh of a level the number of its hull, if it has one. */
  hulls: (number | undefined)[];
}

/** The levels, the hulls if there are any, and what hulls are called. */
export interface Shapes {
  levels: readonly Model[];
  hulls?: Model | undefined;
  hullName: (object: string) => string;
}

export function allMeshes({ levels, hulls, hullName }: Shapes, form: ResolvedOptions['mesh'], kit?: Kit): Meshes {
  const own = meshesOf(levels[0]!, form, kit);
  const all = levels.length === 1 ? [...own] : atLevels(own, levels);
  const numbers = own.map(({ name, group, parts }) => {
    const [part] = parts;
    if (!hulls || !part || part.bodies.length > 1) return undefined;
    const body = part.bodies[0]!;
    if (hulls.vertexStarts[body + 1] === hulls.vertexStarts[body]) return undefined;
    return (
      all.push({ name: hullName(levelName(name, 0, levels.length)), group, parts: [{ ...part, model: hulls, material: undefined }] }) - 1
    );
  });
  return { all, own, levels: levels.length, hulls: numbers };
}

/** The meshes of the finest level, `own`, at all levels. */
function atLevels(own: readonly Mesh[], levels: readonly Model[]): Mesh[] {
  const all: Mesh[] = [];
  let finer = own;
  levels.forEach((model, level) => {
    const meshes = finer.map((mesh, m) => ({
      ...mesh,
      name: levelName(own[m]!.name, level, levels.length),
      parts: mesh.parts.map((part) => atLevel(part, model)),
    }));
    all.push(...meshes);
    finer = meshes;
  });
  return all;
}

/** The part of the finer level at this one. */
function atLevel(part: Part, model: Model): Part {
  const { sameAs = part, ...own } = part;
  return { ...own, model, ...(part.bodies.every((k) => model.unchanged?.[k]) && { sameAs }) };
}

/** What an object is called of which there are so many levels. */
export function levelName(name: string, level: number, levels: number): string {
  return levels > 1 ? `${name}_LOD${level}` : name;
}

/** The meshes of a model. `kit` where the form is so. */
function meshesOf(model: Model, form: ResolvedOptions['mesh'], kit?: Kit): Mesh[] {
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
      return bodies.length > 0 ? [{ model, material, bodies, origin: model.centre }] : [];
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
  return bodies.map((k) => ({ model, material: model.materialOf[k]!, bodies: [k], origin: originOf(model, k), ...(turn && { turn }) }));
}

function originOf({ origins }: Model, k: number): [number, number, number] {
  return [origins[3 * k]!, origins[3 * k + 1]!, origins[3 * k + 2]!];
}
