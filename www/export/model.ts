/** What an export is made from, whatever grew it: bodies in flat arrays. */

/** Bodies that belong together, such as the rocks of a layer; or the parts of one thing, such as a log. */
export interface Group {
  name: string;
  /** What each of its things is called, before its number: `rock`. A group without it is one thing, which has the group's name. */
  noun?: string | undefined;
  /**
   * How many bodies, one after the other, make a thing; 1 unless given, and all of them where the group is one thing. They are its parts, each of
   * another material, and have one origin. A kit cannot have things of several parts.
   */
  parts?: number | undefined;
  /** Whether its bodies are open below, and their rims their first vertices: they are measured, and closed where a file shall be solid. */
  isOpenBelow?: boolean | undefined;
  /** What a reader of the file may want to know. JSON. */
  extras: Record<string, unknown>;
}

/** What bodies are made of. */
export interface Material {
  name: string;
  /** Linear, 0 … 1. */
  color: readonly [number, number, number];
  /** 0 … 1; 0.9 unless given. */
  roughness?: number | undefined;
  /** Whether it is seen from behind too, as what has no other side has to be. */
  isTwoSided?: boolean | undefined;
  /** Its colour and all else are in the model's textures. */
  isTextured?: true;
}

/** What bodies look like, as images. */
export interface Textures {
  /** Of each image, texels. */
  side: number;
  /** For each vertex x and y in texels, from the upper left corner, and its tangent, which points to the right in the images: five numbers. */
  vertices: Float32Array;
  images: Images;
}

/** As PNG. */
export interface Images {
  /** Albedo, sRGB. */
  color: Uint8Array<ArrayBuffer>;
  /** The normal in the tangent frame, y up. */
  normal: Uint8Array<ArrayBuffer>;
  /** Occlusion, roughness and metalness in red, green and blue. */
  surface: Uint8Array<ArrayBuffer>;
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
  /** Where a material is textured. */
  textures?: Textures | undefined;
  /** Float64Array(3 · bodies): where a body stands on the ground. */
  origins: Float64Array;
  /** The middle of the whole, at which the file has its origin. */
  centre: readonly [number, number, number];
  /** For each body the number of its thing, where the model is a part of a larger one. */
  numbers?: Uint32Array | undefined;
  /** Of a level of detail, for each body: whether it is as in the finer level. */
  unchanged?: Uint8Array | undefined;
  /** What maps show; absent where there is no ground that is seen from above. */
  ground?: Ground | undefined;
}

/** A rectangle on z = 0, from the origin on along x and y. */
export interface Ground {
  size: readonly [number, number];
  /** For each group, whether its bodies are small ones: gravel. */
  gravel: readonly boolean[];
}

/** What becomes an object. */
export interface Thing {
  name: string;
  group: number;
  /** From 1 on, among those with the same noun in the whole. */
  number: number;
  bodies: readonly number[];
}

/** In the order of their first bodies. Those with the same noun are numbered through, whatever their groups are. */
export function thingsOf({ groups, groupOf, numbers }: Pick<Model, 'groups' | 'groupOf' | 'numbers'>): Thing[] {
  const counts = new Map<string, number>();
  /** For each group, the bodies of the thing that lacks some. */
  const unfinished = new Map<number, number[]>();
  const things: Thing[] = [];
  groupOf.forEach((group, k) => {
    const { name, noun, parts = noun === undefined ? Infinity : 1 } = groups[group]!;
    let bodies = unfinished.get(group);
    if (bodies) bodies.push(k);
    else {
      bodies = [k];
      const number = noun === undefined ? 1 : (numbers?.[k] ?? (counts.get(noun) ?? 0) + 1);
      if (noun !== undefined) counts.set(noun, number);
      things.push({ name: noun === undefined ? name : `${noun}-${number}`, group, number, bodies });
    }
    if (bodies.length < parts) unfinished.set(group, bodies);
    else unfinished.delete(group);
  });
  return things;
}

/** For each body the number of its thing. */
export function numbersOf(model: Model): Uint32Array {
  const numbers = new Uint32Array(model.groupOf.length);
  for (const { number, bodies } of thingsOf(model)) for (const k of bodies) numbers[k] = number;
  return numbers;
}

export function isOneThing({ groups }: Pick<Model, 'groups'>, group: number): boolean {
  return groups[group]!.noun === undefined;
}
