/** What an export is made from, whatever grew it: bodies in flat arrays. */

/** Bodies that belong together, such as the rocks of a layer; or the parts of one thing, such as a log. */
export interface Group {
  name: string;
  /**
   * What each body is called, before its number: `rock`. A group without it is one thing, which has the group's name and is neither measured nor
   * closed; each of its bodies is the part of it that is of another material, and they have one origin.
   */
  noun?: string | undefined;
  /** What a reader of the file may want to know. JSON. */
  extras: Record<string, unknown>;
}

/** What bodies are made of. */
export interface Material {
  name: string;
  /** Linear, 0 … 1. */
  color: readonly [number, number, number];
}

/** z is up; `unit` says what a unit is. Body k owns the vertices and indices between `starts[k]` and `starts[k + 1]`. */
export interface Model {
  /** Metres. */
  unit: number;
  positions: Float32Array;
  /** Unit vectors. */
  normals: Float32Array;
  /** Counter-clockwise from outside; of the whole of `positions`. */
  indices: Uint32Array;
  indexStarts: Uint32Array;
  vertexStarts: Uint32Array;
  /** For each body. */
  groupOf: Uint8Array;
  groups: Group[];
  /** For each body. */
  materialOf: Uint8Array;
  materials: Material[];
  /** Float64Array(3 · bodies): where a body stands on the ground. */
  origins: Float64Array;
  /** The middle of the whole, at which the file has its origin. */
  centre: readonly [number, number, number];
}

/** What becomes an object: a body, or all bodies of a group that is one thing. */
export interface Thing {
  name: string;
  group: number;
  bodies: readonly number[];
}

/** In the order of their first bodies. Bodies with the same noun are numbered from 1 on, whatever their groups are. */
export function thingsOf({ groups, groupOf }: Pick<Model, 'groups' | 'groupOf'>): Thing[] {
  const counts = new Map<string, number>();
  const wholes = new Map<number, number[]>();
  const things: Thing[] = [];
  groupOf.forEach((group, k) => {
    const { name, noun } = groups[group]!;
    const parts = wholes.get(group);
    if (parts) parts.push(k);
    else if (noun === undefined) {
      const bodies = [k];
      wholes.set(group, bodies);
      things.push({ name, group, bodies });
    } else {
      const number = (counts.get(noun) ?? 0) + 1;
      counts.set(noun, number);
      things.push({ name: `${noun}-${number}`, group, bodies: [k] });
    }
  });
  return things;
}

export function isOneThing({ groups }: Pick<Model, 'groups'>, group: number): boolean {
  return groups[group]!.noun === undefined;
}
