/** What a worker does: it makes a scene, and writes its file. */

import { createHash } from 'node:crypto';
import type { ExportNote } from '../export/file.ts';
import type { ExportOptions } from '../export/options.ts';
import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import { exportWith } from '../rocks/export.ts';
import { fieldHash } from '../rocks/hash.ts';
import type { GenerateOptions, HeadlessJob } from '../rocks/headless.ts';
import { decodeLink } from '../rocks/link.ts';
import type { PresetName } from '../rocks/params.ts';
import { colonyHash } from '../wood-ear/hash.ts';
import { exportColonyWith } from '../wood-ear/headless-export.ts';
import type { Generators } from '../wood-ear/headless-export.ts';
import { decodeWoodEarLink } from '../wood-ear/link.ts';
import { colonyRequest } from '../wood-ear/table.ts';
import { colonyDescription, colonyArrays, fieldArrays, fieldDescription } from './describe.ts';
import { npz } from './npz.ts';
import type { Scene } from './scenes.ts';
import { writeWhole } from './whole-file.ts';

/** What is made of a scene: a file of the exporter, a description, or that with all arrays for NumPy; with nothing, it is only generated. */
export type Wanted = { as: 'export'; options: ExportOptions } | { as: 'json' | 'npz' } | { as: 'hash' };

export interface Task {
  scene: Scene;
  wanted: Wanted;
  /** Where it is written; null: the bytes are part of what is answered. */
  file: string | null;
  /** Whether somebody looks at the progress. */
  isWatched: boolean;
}

export interface Made {
  /** Of the file. */
  bytes: number;
  sha256: string;
  /** Of the scene: the one that files carry, and that tests compare. */
  hash: string;
  seconds: number;
  notes: readonly ExportNote[];
  data: Uint8Array<ArrayBuffer> | null;
}

/** What was generated, and the file that was made of it. */
interface Outcome {
  hash: string;
  bytes: Uint8Array<ArrayBuffer>;
  notes: readonly ExportNote[];
}

/** Does tasks one by one with the generators of one realm. */
export class Work {
  readonly #tools: Generators;
  /** The last field: of one scene several maps are made. */
  #last: { link: string; field: Field } | undefined;

  constructor(tools: Generators) {
    this.#tools = tools;
  }

  /** @throws whatever the generator, the exporter or the file system says. */
  async do({ scene, wanted, file, isWatched }: Task, onProgress: (fraction: number) => void): Promise<Made> {
    const begin = performance.now();
    const told = isWatched ? ({ fraction }: { fraction: number }): void => onProgress(fraction) : undefined;
    const { hash, bytes, notes } = await (scene.generator === 'rocks'
      ? this.#rocks(scene, wanted, told)
      : this.#woodEars(scene, wanted, told));
    if (file !== null && wanted.as !== 'hash') writeWhole(file, bytes);
    const sha256 = createHash('sha256').update(bytes).digest('hex');
    const seconds = Math.round(performance.now() - begin) / 1000;
    return { bytes: bytes.length, sha256, hash, seconds, notes, data: file === null ? bytes : null };
  }

  async #rocks({ link, preset }: Scene, wanted: Wanted, onProgress: Told | undefined): Promise<Outcome> {
    const { params } = decodeLink(link);
    const known = this.#last?.link === link ? this.#last.field : undefined;
    this.#last = undefined;
    let made: Field | undefined = known;
    const generate = async (request: HeadlessJob = {}, options?: GenerateOptions): Promise<Field> => {
      made ??= await this.#tools.generate(request, options);
      return made;
    };
    const source = { ...params, preset: preset as PresetName };
    const file =
      wanted.as === 'export' ? await exportWith({ generate, ground: this.#tools.soil }, source, wanted.options, { onProgress }) : undefined;
    const field = await generate(source, { onProgress });
    this.#last = { link, field };
    const hash = await fieldHash(field);
    if (file) return { hash, bytes: file.bytes, notes: file.report.notes };
    const description = fieldDescription({ link, preset, params, hash }, field);
    return { hash, bytes: described(wanted, description, () => fieldArrays(field)), notes: [] };
  }

  async #woodEars({ link, preset }: Scene, wanted: Wanted, onProgress: Told | undefined): Promise<Outcome> {
    const { params } = decodeWoodEarLink(link);
    let made: WoodEarColony | undefined;
    const grow: Generators['grow'] = async (request, options) => {
      made = await this.#tools.grow(request, options);
      return made;
    };
    const { mesh: _, ...rest } = params;
    const source = { ...rest, preset: preset as NonNullable<Parameters<typeof exportColonyWith>[1]>['preset'] };
    const file =
      wanted.as === 'export' ? await exportColonyWith({ ...this.#tools, grow }, source, wanted.options, { onProgress }) : undefined;
    const colony = made ?? (await grow(colonyRequest(params), { onProgress }));
    const hash = await colonyHash(colony);
    if (file) return { hash, bytes: file.bytes, notes: file.report.notes };
    const description = colonyDescription({ link, preset, params: rest, hash }, colony);
    return { hash, bytes: described(wanted, description, () => colonyArrays(colony)), notes: [] };
  }
}

type Told = (progress: { fraction: number }) => void;

function described({ as }: Wanted, description: object, arrays: () => Parameters<typeof npz>[0]): Uint8Array<ArrayBuffer> {
  if (as === 'hash') return new Uint8Array(0);
  const json = new TextEncoder().encode(`${JSON.stringify(description, null, 2)}\n`);
  return as === 'npz' ? npz(arrays(), { 'scene.json': json }) : json;
}
