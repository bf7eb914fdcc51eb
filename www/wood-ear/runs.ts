/**
 * Colonies with what their log lies on: two generators in two workers, whose results are shown as one.
 *
 * The rocks are asked for again only where the log or the ground is another: a colony on the log that there is waits for nothing.
 */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import { bareField, ofGround, rocksAround, sceneOf } from './ground.ts';
import { GeneratorClient } from '../rocks/client.ts';
import { ColonyClient } from './client.ts';
import type { Progress } from '../generator/protocol.ts';
import type { WoodEarStage } from './session.ts';
import type { Arrival, OnResult, RunClient } from '../generator/runs.ts';
import { colonyRequest, groundSide, placeOf } from './table.ts';
import type { Place, WoodEarScene, WoodEarSceneParams } from './table.ts';

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
    try {
      return await this.#rocks.generate(rocksAround(link, side, log, place));
    } catch (thrown) {
      throw ofGround(thrown);
    }
  }
}
