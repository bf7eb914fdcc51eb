/** Keeps a scene drawn: opens its renderer, and another when the graphics device is lost. */

import type { ErrorInfo } from './errors.ts';
import { loadRenderer } from './renderer/load.ts';
import type { WantedBackend } from './renderer/load.ts';
import type { SceneRenderer } from './renderer/renderer.ts';

/** So many losses within so short a time are no accident: the plan is drawn without the GPU then. */
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

  constructor(scene: KeptScene) {
    this.#scene = scene;
  }

  get renderer(): SceneRenderer | undefined {
    return this.#renderer;
  }

  open(): void {
    this.#cycle += 1;
    void this.#open(this.#cycle, this.#scene.wantedBackend());
  }

  close(): void {
    this.#cycle += 1;
    this.#renderer?.dispose();
    this.#renderer?.canvas.remove();
    this.#renderer = undefined;
    this.#losses = [];
    this.#restoring = false;
    this.#isFailing = false;
    clearTimeout(this.#telling);
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
      if (this.#renderer === renderer) this.#scene.report({ name: 'RendererFailed', message: `the picture could not be drawn: ${errorText(thrown)}` });
    }, TELL_MS);
  }

  async #open(cycle: number, backend: WantedBackend): Promise<boolean> {
    let renderer: SceneRenderer;
    try {
      renderer = await loadRenderer(() => this.#scene.makeCanvas(), backend);
    } catch (thrown) {
      if (cycle === this.#cycle) this.#scene.report({ name: 'NoRenderer', message: errorText(thrown) });
      return false;
    }
    if (cycle !== this.#cycle) {
      renderer.dispose();
      return false;
    }
    try {
      this.#scene.fill(renderer);
    } catch (thrown) {
      renderer.dispose();
      this.#scene.report({ name: 'RendererFailed', message: `the picture could not be made: ${errorText(thrown)}` });
      return false;
    }
    this.#renderer = renderer;
    void renderer.lost.then((reason) => this.#onLost(renderer, reason));
    this.#scene.opened(renderer);
    return true;
  }

  /** The device or context is gone: a new canvas and renderer, the same field, the same camera. */
  async #onLost(renderer: SceneRenderer, reason: string): Promise<void> {
    if (this.#renderer !== renderer) return;
    const cycle = this.#cycle;
    this.#renderer = undefined;
    renderer.dispose();
    const now = performance.now();
    this.#losses = [...this.#losses.filter((time) => now - time < LOSS_WINDOW_MS), now];
    const givenUp = this.#losses.length > MAX_LOSSES;
    this.#restoring = true;
    // The old canvas keeps its last picture on the screen until the new one is put in its place.
    const opened = await this.#open(cycle, givenUp ? 'canvas2d' : this.#scene.wantedBackend());
    if (opened && givenUp) this.#scene.report({ name: 'DeviceLost', message: `the graphics device was lost ${this.#losses.length} times: ${reason}` });
  }
}

export function errorText(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}
