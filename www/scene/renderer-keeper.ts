/** Keeps a scene drawn: opens its renderer, and another one when the graphics device is lost. */

import type { ErrorInfo, RockFieldError } from '../base/errors.ts';
import { lazily } from '../base/lazy.ts';
import type { Language } from '../base/language.ts';
import type { Recovery } from '../renderer/recovery.ts';
import { backendsOf, loadRenderer } from '../renderer/load.ts';
import type { Refusal, WantedBackend } from '../renderer/load.ts';
import type { Backend } from '../base/view.ts';
import type { SceneRenderer } from '../renderer/renderer.ts';

/** More losses than this within so short a time are no accident: the plan is drawn without the GPU for a while. */
const MAX_LOSSES = 3;
const LOSS_WINDOW_MS = 30_000;

/** Before an exception while drawing is told, so that there is at most one a second. */
const TELL_MS = 1000;

/** What it keeps the picture for. */
export interface KeptScene {
  wantedBackend(): WantedBackend;
  makeCanvas(): HTMLCanvasElement;
  /** Gives a new renderer what it is to draw; may throw. */
  fill(renderer: SceneRenderer): void;
  /** The renderer stands: show its canvas. */
  opened(renderer: SceneRenderer): void;
  /** What `words` gives has changed, or is as it was after another try. */
  said(): void;
  report(error: ErrorInfo): void;
}

export class RendererKeeper {
  readonly #scene: KeptScene;
  #renderer: SceneRenderer | undefined;
  #losses: number[] = [];
  #restoring = false;
  /** The last frame threw. */
  #isFailing = false;
  #telling: ReturnType<typeof setTimeout> | undefined;
  /** Counts openings and closings; compared after every await. */
  #cycle = 0;
  /** Fetched beside the renderer: what helps when the network is gone has to be there before that. */
  #recovery: Promise<Recovery> | undefined;
  #standing: Recovery | undefined;

  constructor(scene: KeptScene) {
    this.#scene = scene;
  }

  get renderer(): SceneRenderer | undefined {
    return this.#renderer;
  }

  /** Why the picture is not drawn as it was asked for; empty while it is. */
  words(language: Language): string {
    return this.#standing?.words(language) ?? '';
  }

  /** Whether trying again at once makes sense. */
  get canRetry(): boolean {
    return this.#standing?.canRetry ?? false;
  }

  open(): void {
    this.#cycle += 1;
    const cycle = this.#cycle;
    void this.#open(cycle, this.#backends());
    const again = async () => cycle === this.#cycle && this.#open(cycle, this.#backends('canvas2d'), true);
    this.#recovery = lazily(() => import('../renderer/recovery.ts'), true).then(
      ({ Recovery }) => new Recovery({ again, said: () => this.#scene.said() }),
    );
    this.#recovery.catch(() => undefined);
  }

  close(): void {
    this.#cycle += 1;
    this.#renderer?.dispose();
    this.#renderer?.canvas.remove();
    this.#renderer = undefined;
    this.#standing?.end();
    this.#standing = undefined;
    this.#losses = [];
    this.#restoring = false;
    this.#isFailing = false;
    clearTimeout(this.#telling);
  }

  /** Tries at once to draw as it was asked for, if that is not so. */
  retry(): void {
    if (this.#standing) void this.#standing.retry();
    else if (!this.#isWhole(this.#renderer)) this.open();
  }

  /** Draws with the renderer, if there is one; `restored` is the first picture after a loss. */
  draw(work: (renderer: SceneRenderer) => void): 'drawn' | 'restored' | 'nothing' {
    const renderer = this.#renderer;
    if (!renderer) return 'nothing';
    try {
      work(renderer);
    } catch (thrown) {
      this.#drawingFailed(renderer, thrown);
      return 'nothing';
    }
    this.#isFailing = false;
    const restored = this.#restoring;
    this.#restoring = false;
    return restored ? 'restored' : 'drawn';
  }

  /**
   * Tells of an exception while drawing, once until a frame succeeds again. The renderer stays: another would throw the same. Where
   * the device is being lost, the news of it follows shortly and is told in its stead.
   */
  #drawingFailed(renderer: SceneRenderer, thrown: unknown): void {
    if (this.#isFailing) return;
    this.#isFailing = true;
    clearTimeout(this.#telling);
    this.#telling = setTimeout(() => {
      if (this.#renderer === renderer)
        this.#scene.report({ name: 'RendererFailed', message: `the picture could not be drawn: ${errorText(thrown)}` });
    }, TELL_MS);
  }

  #backends(without?: Backend): readonly Backend[] {
    const wanted = this.#scene.wantedBackend();
    return backendsOf(wanted).filter((backend) => backend !== without || backend === wanted);
  }

  /** Whether the renderer is one that was asked for, not the plan in its stead. */
  #isWhole(renderer: SceneRenderer | undefined): boolean {
    return renderer !== undefined && (renderer.backend !== 'canvas2d' || this.#scene.wantedBackend() === 'canvas2d');
  }

  /** True when the picture is drawn as it was asked for. Another try changes nothing unless it succeeds. */
  async #open(cycle: number, backends: readonly Backend[], isRetry = false): Promise<boolean> {
    const refusals: Refusal[] = [];
    const renderer = await loadRenderer(() => this.#scene.makeCanvas(), backends, refusals);
    if (cycle !== this.#cycle) {
      renderer?.dispose();
      return false;
    }
    const isWhole = this.#isWhole(renderer);
    if (isRetry && !isWhole) return false;
    try {
      if (renderer) this.#scene.fill(renderer);
    } catch (thrown) {
      renderer?.dispose();
      this.#scene.report({ name: 'RendererFailed', message: `the picture could not be made: ${errorText(thrown)}` });
      return false;
    }
    if (renderer) this.#put(renderer, isRetry);
    else
      this.#scene.report({
        name: 'NoRenderer',
        message: `The rocks cannot be drawn here. ${refusals.map(({ backend, error }) => `${backend}: ${errorText(error)}`).join('; ')}`,
      });
    if (isWhole) this.#standing?.end();
    else this.#lack(cycle, refusals).catch((error: RockFieldError) => this.#scene.report(error));
    return isWhole;
  }

  #put(renderer: SceneRenderer, isRetry: boolean): void {
    this.#renderer?.dispose();
    this.#renderer = renderer;
    this.#restoring ||= isRetry;
    void renderer.lost.then((reason) => this.#onLost(renderer, reason));
    this.#scene.opened(renderer);
  }

  /** The plan stands in, or nothing does: says why, and tries again from time to time. */
  async #lack(cycle: number, refusals: readonly Refusal[]): Promise<void> {
    const recovery = await this.#recovery;
    if (cycle !== this.#cycle) return;
    this.#standing = recovery;
    recovery?.begin(refusals, this.#losses.length, this.#losses.length > MAX_LOSSES);
  }

  /** The device or context is gone: a new canvas and renderer, the same field, the same camera. */
  async #onLost(renderer: SceneRenderer, reason: string): Promise<void> {
    if (this.#renderer !== renderer) return;
    const cycle = this.#cycle;
    this.#renderer = undefined;
    renderer.dispose();
    const now = performance.now();
    this.#losses = [...this.#losses.filter((time) => now - time < LOSS_WINDOW_MS), now];
    const { length } = this.#losses;
    this.#restoring = true;
    // The old canvas keeps its last picture on the screen until the new one is put in its place.
    const isWhole = await this.#open(cycle, length > MAX_LOSSES ? ['canvas2d'] : this.#backends());
    if (!isWhole && cycle === this.#cycle)
      this.#scene.report({ name: 'DeviceLost', message: `the graphics device was lost${length > 1 ? ` ${length} times` : ''}: ${reason}` });
  }
}

export function errorText(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}
