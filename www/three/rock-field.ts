/** A field of rocks for a scene of three.js, in the shape of three's own generators. */

import * as three from 'three';
import type { BatchedMesh, Group, Intersection, Material, Mesh } from 'three';
import { abortError } from '../base/errors.ts';
import type { SceneBodies, SceneParts } from '../export/scene.ts';
import { Pace } from '../export/pace.ts';
import type { Progress, StageName } from '../generator/protocol.ts';
import { checkRun } from '../generator/run-checks.ts';
import { batchOf } from './bodies.ts';
import { geometryOf, IDS } from './geometry.ts';
import { OPTION_KEYS, resolve } from './options.ts';
import type { RockFieldOptions, Wanted } from './options.ts';
import { checkRevision } from './revision.ts';

/** As of `generate`; the stage `scene` is that in which the meshes are made. */
export type BuildProgress = Progress<StageName | 'scene'>;

/** Who waits for a build. */
export interface BuildRun {
  /** Aborting rejects with the signal's reason; the field that was there stays. */
  signal?: AbortSignal | undefined;
  onProgress?: ((progress: BuildProgress) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

/** A rock that a ray has met. */
export interface FoundRock {
  /** From 1 on: the `id` of its object in an exported file. */
  id: number;
  /** The `id` of its layer. */
  layer: number;
}

/** Generates: in workers, or where there are none on the calling thread. */
export interface Grower {
  grow(wanted: Pick<Wanted, 'source' | 'options'>, run: BuildRun): Promise<SceneParts>;
  /** Ends what it keeps for the next run. */
  dispose(): void;
}

/** The share of the work that is done when the arrays are there. */
const GROWN = 0.9;

/** What is in the group. */
interface Built {
  objects: Mesh[];
  materials: Material[];
  about: Pick<SceneParts, 'title' | 'origin' | 'groups'>;
  /** For each rock of a `BatchedMesh`. */
  rocks: Pick<SceneBodies, 'numbers' | 'groupOf'> | undefined;
}

export class RockFieldBuilder {
  /** What stands in your scene: the same from the beginning, with another field in it after each `build()`. Metres, y up, the middle of the field in its origin. */
  readonly group: Group = new three.Group();
  /** What the next `build()` makes. */
  readonly parameters: RockFieldOptions;

  readonly #newGrower: () => Grower;
  #grower: Grower | undefined;
  #built: Built | undefined;
  /** Ends the build that is under way. */
  #running: AbortController | undefined;

  constructor(newGrower: () => Grower, options: RockFieldOptions = {}) {
    this.#newGrower = newGrower;
    this.parameters = { ...options };
    this.group.name = 'rock-field';
  }

  /**
   * Generates the field and puts it into `group`, in the place of the one before. The newest call counts: an older one rejects with an `AbortError`.
   *
   * @throws {RockFieldError} naming the parameter or the option, its value and its bounds, or `ThreeUnsuitable`: the field that was there stays.
   * @throws {DOMException} `AbortError` after `dispose()` or a newer call; the signal's reason.
   */
  async build(run: BuildRun = {}): Promise<Group> {
    checkRevision();
    const { onProgress, signal, maxBytes } = checkRun(run, 'run') as BuildRun;
    const wanted = resolve(this.parameters);
    signal?.throwIfAborted();
    this.#running?.abort(abortError('superseded by a newer build'));
    const running = new AbortController();
    this.#running = running;
    const onAbort = (): void => running.abort(signal?.reason);
    signal?.addEventListener('abort', onAbort, { once: true });
    try {
      this.#grower ??= this.#newGrower();
      const parts = await this.#grower.grow(wanted, {
        maxBytes,
        signal: running.signal,
        onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GROWN * progress.fraction })),
      });
      running.signal.throwIfAborted();
      const built = await builtOf(parts, wanted, running.signal, onProgress);
      this.#clear();
      this.#show(built);
      return this.group;
    } finally {
      signal?.removeEventListener('abort', onAbort);
      if (this.#running === running) this.#running = undefined;
    }
  }

  /** The rock that a ray has met, of an intersection with `group`; null of the ground and of what is not of this field. */
  rockOf({ object, batchId, face }: Pick<Intersection, 'object' | 'batchId' | 'face'>): FoundRock | null {
    if (!this.#built?.objects.includes(object as Mesh)) return null;
    const { rocks, about } = this.#built;
    if (batchId !== undefined && rocks && (object as BatchedMesh).isBatchedMesh) {
      return { id: rocks.numbers[batchId]!, layer: about.groups[rocks.groupOf[batchId]!]!.extras.layer as number };
    }
    const ids = (object as Mesh).geometry.getAttribute(IDS);
    const { layer } = object.userData as { layer?: number };
    return ids && face && layer !== undefined ? { id: ids.getX(face.a) + 1, layer } : null;
  }

  /**
   * Ends a build that is under way and frees what the field holds, on the graphics device too. `group` is empty then; `build()` fills it again.
   */
  dispose(): void {
    this.#running?.abort(abortError('the field was disposed of'));
    this.#running = undefined;
    this.#grower?.dispose();
    this.#grower = undefined;
    this.#clear();
  }

  #show(built: Built): void {
    this.#built = built;
    const { title, origin } = built.about;
    this.group.userData = { title, ...origin };
    this.group.add(...built.objects);
  }

  #clear(): void {
    if (!this.#built) return;
    this.group.remove(...this.#built.objects);
    this.group.userData = {};
    free(this.#built);
    this.#built = undefined;
  }
}

async function builtOf(
  parts: SceneParts,
  { material: given, options }: Wanted,
  signal: AbortSignal,
  onProgress: BuildRun['onProgress'],
): Promise<Built> {
  const { title, origin, groups, bodies } = parts;
  const rocks = bodies && { numbers: bodies.numbers, groupOf: bodies.groupOf };
  const built: Built = { objects: [], materials: [], about: { title, origin, groups }, rocks };
  const material = (color?: readonly [number, number, number]): Material => {
    if (given) return given;
    const made = new three.MeshStandardMaterial({ roughness: 0.9, metalness: 0, vertexColors: options.mesh === 'one' });
    if (color) made.color.setRGB(...color);
    built.materials.push(made);
    return made;
  };
  const pace = new Pace({
    signal,
    onProgress: onProgress && ((fraction) => onProgress({ stage: 'scene', fraction: GROWN + (1 - GROWN) * fraction })),
  });
  try {
    const shared = material();
    for (const { group, places, material: own } of parts.meshes) {
      const { name, extras, hasRocks } = groups[group]!;
      const geometry = geometryOf(parts, places, bodies !== undefined);
      const mesh = new three.Mesh(geometry, bodies ? material(parts.materials[own]!.color) : shared);
      mesh.name = name;
      mesh.userData = { ...extras };
      mesh.castShadow = hasRocks;
      mesh.receiveShadow = true;
      built.objects.push(mesh);
    }
    if (bodies && bodies.shapes.length > 0) {
      const batch = await batchOf(parts, bodies, shared, pace);
      batch.castShadow = batch.receiveShadow = true;
      built.objects.push(batch);
    }
    return built;
  } catch (thrown) {
    free(built);
    throw thrown;
  }
}

function free({ objects, materials }: Built): void {
  for (const object of objects) {
    if ((object as BatchedMesh).isBatchedMesh) (object as BatchedMesh).dispose();
    else object.geometry.dispose();
  }
  for (const material of materials) material.dispose();
}

/** A method for each key of the options that gives it a value: `setSeed`, `setPreset` … */
export type Setters<Owner> = { [Key in keyof RockFieldOptions as `set${Capitalize<Key>}`]-?: (value: RockFieldOptions[Key]) => Owner };

/** Gives a class the methods of `Setters`. */
export function addSetters(owner: { prototype: object }): void {
  for (const key of OPTION_KEYS) {
    const name = `set${key[0]!.toUpperCase()}${key.slice(1)}`;
    Object.defineProperty(owner.prototype, name, {
      configurable: true,
      writable: true,
      value(this: RockFieldBuilder, value: unknown) {
        (this.parameters as Record<string, unknown>)[key] = value;
        return this;
      },
    });
  }
}
