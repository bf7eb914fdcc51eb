/** The meshes of a glTF file. */

import type { Kit } from './kit.ts';
import { thingsOf } from './model.ts';
import type { Model } from './model.ts';
import type { ResolvedOptions } from './options.ts';

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
