/**
 * When a scene is drawn, and how well: nothing unless something changed and can be seen; in motion as well as it flows, at rest once
 * more at its best, then not at all.
 */

import { AutoQuality } from '../renderer/quality.ts';
import type { Quality, WantedQuality } from '../base/view.ts';

/** Who asks for no frame for so long is at rest. */
const REST_MS = 150;

export interface PacedScene {
  /** The window it is in; it may come into another. */
  view(): Window;
  canDraw(): boolean;
  /** Whether the quality makes a difference to what is shown. */
  isGraded(): boolean;
  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number): boolean;
  /** Null: it makes no difference. */
  draw(level: Quality | null): void;
}

export class FramePacer {
  readonly #scene: PacedScene;
  #wanted: WantedQuality = 'auto';
  #auto = new AutoQuality();
  #dirty = false;
  #frame = 0;
  #resting: ReturnType<typeof setTimeout> | undefined;
  /** Of the picture on the screen. */
  #level: Quality | null = null;
  /** Counts what would make the time of a still another's. */
  #disturbances = 0;

  constructor(scene: PacedScene) {
    this.#scene = scene;
  }

  get wanted(): WantedQuality {
    return this.#wanted;
  }

  set wanted(wanted: WantedQuality) {
    if (wanted === this.#wanted) return;
    this.#wanted = wanted;
    this.invalidate();
  }

  /** Of a picture that is taken and not looked at while it is made. */
  get best(): Quality | null {
    if (!this.#scene.isGraded()) return null;
    return this.#wanted === 'auto' ? 'high' : this.#wanted;
  }

  /** Another renderer draws: nothing is known of it. */
  renew(): void {
    this.#auto = new AutoQuality();
  }

  /** Asks for a frame; many calls, one frame. */
  invalidate(): void {
    this.#dirty = true;
    clearTimeout(this.#resting);
    this.#request();
  }

  /** It may be seen now, or no longer. */
  look(isMoving: boolean): void {
    this.#disturbances += 1;
    if (this.#dirty || isMoving) this.invalidate();
  }

  stop(): void {
    this.#scene.view().cancelAnimationFrame(this.#frame);
    clearTimeout(this.#resting);
    this.#frame = 0;
    this.#auto.rest();
  }

  /** Draws in this very task if it can. A frame that was asked for still comes: more may hang on it than this picture. */
  drawNow(): void {
    if (this.#scene.canDraw()) this.#drawMoving();
    else this.#dirty = true;
  }

  /** What is on the screen, once more, if it can be seen and no frame that is to be drawn comes before it is. */
  redraw(): void {
    if (!this.#scene.canDraw()) this.#dirty = true;
    else if (this.#frame === 0 || !this.#dirty) this.#scene.draw(this.#level);
  }

  #request(): void {
    if (this.#frame === 0 && this.#scene.canDraw()) this.#frame = this.#scene.view().requestAnimationFrame((now) => this.#onFrame(now));
  }

  #onFrame(now: number): void {
    this.#frame = 0;
    if (!this.#scene.canDraw()) {
      this.#dirty = true;
      return;
    }
    if (!this.#dirty) {
      this.#settle();
      return;
    }
    const goesOn = this.#scene.advance(now);
    if (this.#isAuto) this.#auto.frame(now);
    this.#drawMoving();
    if (goesOn) this.invalidate();
  }

  get #isAuto(): boolean {
    return this.#wanted === 'auto' && this.#scene.isGraded();
  }

  #drawMoving(): void {
    this.#draw(this.#isAuto ? this.#auto.moving : this.best);
    if (this.#isAuto && !this.#dirty) this.#resting = setTimeout(() => this.#rest(), REST_MS);
  }

  #draw(level: Quality | null): void {
    if (this.#frame === 0) this.#dirty = false;
    clearTimeout(this.#resting);
    this.#disturbances += 1;
    this.#level = level;
    this.#scene.draw(level);
  }

  /** By way of a frame: what the pointer did while the GPU was busy arrives with it, and is no rest. */
  #rest(): void {
    if (this.#scene.canDraw()) this.#request();
    else this.#dirty = true;
  }

  #settle(): void {
    this.#auto.rest();
    if (!this.#isAuto || this.#level === this.#auto.still) return;
    this.#draw(this.#auto.still);
    const drawn = this.#disturbances;
    const start = performance.now();
    // The browser gives out the second one when the GPU is done with what the first one came after.
    const view = this.#scene.view();
    view.requestAnimationFrame(() =>
      view.requestAnimationFrame(() => {
        if (drawn === this.#disturbances) this.#auto.stillTook(performance.now() - start);
      }),
    );
  }
}
