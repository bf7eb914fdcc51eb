/** Sessions of wood ears: the buffers of the wasm as a `WoodEarColony`. */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import type { LogMesh } from './log-mesh.ts';
import type { FlatColony } from './request.ts';
import type { LoopCraft } from '../generator/loop.ts';
import { Session } from '../generator/session.ts';
import type { Craft, RawSteps, Times } from '../generator/session.ts';

/** The class of the same name in pkg/wood-ear.d.ts, as far as it is used. */
export interface RawWoodEarGenerator extends RawSteps {
  set_log(positions: Float32Array, indices: Uint32Array): void;
  log_turned(): boolean;
  clear_log(): void;
  start(params: Float64Array, maxBytes: number): void;
  preview_ready(): boolean;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  individual_starts(): Uint32Array;
  vertex_starts(): Uint32Array;
  foot(): Uint32Array;
  size(): Float32Array;
  base(): Uint8Array;
  log_positions(): Float32Array;
  log_normals(): Float32Array;
  log_indices(): Uint32Array;
  log_kinds(): Uint8Array;
  log_coords(): Float32Array;
  log_version(): number;
  bases(): Float64Array;
  summary(): Float64Array;
}

/** What pkg/wood-ear.js exports, as far as it is used. */
export interface WoodEarModule {
  WoodEarGenerator: new () => RawWoodEarGenerator;
  fresh_seed(): number;
}

export type WoodEarStage = 'log' | 'spawn' | 'deform' | 'collide' | 'mesh';

const STAGES: readonly WoodEarStage[] = ['log', 'spawn', 'deform', 'collide', 'mesh'];

export function woodEarSession(generator: RawWoodEarGenerator): Session<RawWoodEarGenerator, FlatColony, WoodEarColony, WoodEarStage> {
  return new Session(generator, new WoodEars());
}

/** A colony as it crosses to the page: `log` is null where it is the one that crossed before. */
export type PackedColony = Omit<WoodEarColony, 'log'> & { log: WoodEarLog | null };

/** For the worker's loop of one client: what has crossed stays here too, so that the next colony can be told to be on the same log. */
export function woodEarLoop(): LoopCraft<WoodEarModule, FlatColony, WoodEarColony, WoodEarStage> {
  let crossed: WoodEarLog | undefined;
  return {
    open: ({ WoodEarGenerator }) => woodEarSession(new WoodEarGenerator()),
    pack: ({ log, ...colony }) => {
      const result: PackedColony = { ...colony, log: log === crossed ? null : log };
      crossed = log;
      const { positions, normals, indices, individualStarts, vertexStarts, foot, size, base, bases } = colony;
      return {
        result,
        transfer: [positions, normals, indices, individualStarts, vertexStarts, foot, size, base, bases].map(
          ({ buffer }) => buffer as ArrayBuffer,
        ),
      };
    },
  };
}

class WoodEars implements Craft<RawWoodEarGenerator, FlatColony, WoodEarColony, WoodEarStage> {
  readonly stages = STAGES;
  /** The user's log that the generator has. */
  #given: LogMesh | null = null;
  #log: WoodEarLog | undefined;
  #version = -1;

  start(generator: RawWoodEarGenerator, { params, log, maxBytes }: FlatColony): void {
    if (!log && this.#given) generator.clear_log();
    // Setting it would start from the log again.
    else if (log && !(this.#given && sameLog(log, this.#given))) generator.set_log(log.positions, log.indices);
    this.#given = log;
    generator.start(params, maxBytes);
  }

  collect(generator: RawWoodEarGenerator, { log }: FlatColony, ms: Times<WoodEarStage>, isPreview: boolean): WoodEarColony {
    const [individuals = 0, triangles = 0, crossingPairs = 0, sweeps = 0, rounds = 0, keptMedian = 0, keptP10 = 0] = generator.summary();
    return {
      positions: generator.positions(),
      normals: generator.normals(),
      indices: generator.indices(),
      individualStarts: generator.individual_starts(),
      vertexStarts: generator.vertex_starts(),
      foot: generator.foot(),
      size: generator.size(),
      base: generator.base(),
      log: this.#collectLog(generator, log),
      bases: generator.bases(),
      stats: { individuals, triangles, ...(isPreview ? {} : { crossingPairs }), sweeps, rounds, keptMedian, keptP10, ms },
    };
  }

  /** The copy made before, unless the log changed since, or somebody transferred it. */
  #collectLog(generator: RawWoodEarGenerator, given: LogMesh | null): WoodEarLog {
    const version = generator.log_version();
    if (!this.#log || version !== this.#version || this.#log.positions.byteLength === 0 || this.#log.indices.byteLength === 0) {
      this.#log = {
        positions: generator.log_positions(),
        normals: generator.log_normals(),
        indices: generator.log_indices(),
        kinds: generator.log_kinds(),
        coords: generator.log_coords(),
        turned: given !== null && generator.log_turned(),
        scale: given?.scale ?? 1,
      };
      this.#version = version;
    }
    return this.#log;
  }
}

function sameLog(a: LogMesh, b: LogMesh): boolean {
  return same(a.positions, b.positions) && same(a.indices, b.indices);
}

function same(a: Float32Array | Uint32Array, b: Float32Array | Uint32Array): boolean {
  return a.length === b.length && a.every((value, k) => value === b[k]);
}
