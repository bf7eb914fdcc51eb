/**
 * Colonies with what their log lies on: two generators in two workers, whose results are shown as one.
 *
 * The rocks are asked for again only where the log or the ground is another: a colony on the log that there is waits for nothing.
 */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import { errorInfo, isCoded, RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import { footprintOf } from './footprint.ts';
import { GeneratorClient } from '../rocks/client.ts';
import { ColonyClient } from './client.ts';
import type { Progress } from '../generator/protocol.ts';
import type { WoodEarStage } from './session.ts';
import { decodeLink } from '../rocks/link.ts';
import type { Arrival, OnResult, RunClient } from '../generator/runs.ts';
import { colonyRequest, groundSide, placeOf } from './table.ts';
import type { Place, WoodEarScene, WoodEarSceneParams } from './table.ts';

/** Rocks that are higher than this at their edge do not fit under the log's side, px. */
const CLEARANCE = 9;

/** The rocks round a log. */
interface Ground {
  /** What they were asked for with. */
  link: string;
  side: number;
  log: WoodEarLog;
  field: Promise<Field>;
  /** Once they are there. */
  made: Field | undefined;
}

type OnScene = OnResult<WoodEarSceneParams, WoodEarScene>;

export class WoodEarSceneClient implements RunClient<WoodEarSceneParams, WoodEarScene, WoodEarStage> {
  readonly #onResult: OnScene;
  readonly #colonies: ColonyClient;
  #rocks: GeneratorClient | undefined;
  #ground: Ground | undefined;
  /** What runs of the colony were asked for with. */
  readonly #params = new WeakMap<object, WoodEarSceneParams>();
  /** What waits for its ground, and settles when it is shown. */
  #waiting: Promise<unknown> | undefined;
  /** Counts colonies as they come; an older one is never shown after a newer. */
  #arrived = 0;
  #shown = 0;

  constructor({ onResult }: { onResult: OnScene }) {
    this.#onResult = onResult;
    this.#colonies = new ColonyClient({ onResult: (colony, arrival, request) => this.#arrive(colony, arrival, request) });
  }

  get busy(): boolean {
    return this.#colonies.busy || this.#waiting !== undefined;
  }

  async generate(params: WoodEarSceneParams, options: { onProgress: (progress: Progress<WoodEarStage>) => void }): Promise<WoodEarScene> {
    const request = colonyRequest(params);
    this.#params.set(request, params);
    const colony = await this.#colonies.generate(request, options);
    const field = await this.#groundOf(colony.log, params).field;
    return sceneOf(colony, field, params);
  }

  freshSeed(): Promise<number> {
    return this.#colonies.freshSeed();
  }

  cancel(): void {
    this.#colonies.cancel();
    if (this.#ground && !this.#ground.made) this.#ground = undefined;
    this.#rocks?.cancel();
  }

  dispose(): void {
    this.#colonies.dispose();
    this.#rocks?.dispose();
    this.#ground = undefined;
  }

  #arrive(colony: WoodEarColony, arrival: Arrival, request: object): void {
    const params = this.#params.get(request);
    if (!params) return;
    const turn = ++this.#arrived;
    const show = (field: Field): void => {
      if (turn < this.#shown) return;
      this.#shown = turn;
      this.#onResult(sceneOf(colony, field, params), arrival, params);
    };
    const ground = this.#groundOf(colony.log, params);
    if (ground.made) {
      show(ground.made);
      return;
    }
    // An error is told by the run, which waits for the same rocks.
    const waiting = ground.field
      .then(show, () => undefined)
      .finally(() => {
        if (this.#waiting === waiting) this.#waiting = undefined;
      });
    this.#waiting = waiting;
  }

  #groundOf(log: WoodEarLog, params: WoodEarSceneParams): Ground {
    const link = params.ground;
    const side = groundSide(params);
    const old = this.#ground;
    if (old && old.link === link && old.side === side && (old.log === log || link === '')) return old;
    const bare = link === '' ? bareField(side) : undefined;
    const field = bare ? Promise.resolve(bare) : this.#rocksOf(link, side, log, placeOf(log, params));
    const ground: Ground = { link, side, log, field, made: bare };
    field.then(
      (made) => (ground.made = made),
      () => {
        if (this.#ground === ground) this.#ground = undefined;
      },
    );
    this.#ground = ground;
    return ground;
  }

  async #rocksOf(link: string, side: number, log: WoodEarLog, place: Place): Promise<Field> {
    this.#rocks ??= new GeneratorClient();
    const { params } = decodeLink(link);
    try {
      return await this.#rocks.generate({ ...params, imageWidth: side, imageHeight: side, footprint: footprintOf(log, place, CLEARANCE) });
    } catch (thrown) {
      throw ofGround(thrown);
    }
  }
}

function sceneOf(colony: WoodEarColony, ground: Field, params: WoodEarSceneParams): WoodEarScene {
  const { rings, meridians } = params;
  return { colony, ground, place: placeOf(colony.log, params), rings, meridians };
}

/** What is wrong with a parameter of the rocks is wrong with the ground, which has no such parameter of its own. */
function ofGround(thrown: unknown): unknown {
  return isCoded(thrown) && thrown.key
    ? new RockFieldError({ ...errorInfo(thrown), key: 'ground', layer: undefined, message: `ground: ${thrown.message}` })
    : thrown;
}

/** Soil without a rock. */
function bareField(side: number): Field {
  const none = { sites: 0, cells: 0, selection: 0, shape: 0, mesh: 0, total: 0 };
  return {
    imageWidth: side,
    imageHeight: side,
    layers: [],
    positions: new Float32Array(),
    normals: new Float32Array(),
    indices: new Uint32Array(),
    rockStarts: new Uint32Array(1),
    vertexStarts: new Uint32Array(1),
    rockLayer: new Uint8Array(),
    stats: { rocks: 0, triangles: 0, coveredFraction: 0, ms: none },
  };
}
