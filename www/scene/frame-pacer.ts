/**
 * When a scene is drawn, and how well: nothing unless something changed and can be seen; in motion as well as it flows, at rest once
 * more at its best, then refined (`refine.ts`), then not at all.
 *
 * Where a whole picture takes longer than a page may wait, pictures are drawn in pieces (`cut-pictures.ts`): small ones in motion, and at rest
 * first one that is whole, then the best one.
 */

import { lazily } from '../base/lazy.ts';
import type { AutoQuality } from '../renderer/quality.ts';
import { isSoftware, paceOf, rememberPace } from '../renderer/pace.ts';
import type { SceneRenderer } from '../renderer/renderer.ts';
import type { Quality, WantedQuality } from '../base/view.ts';
import type { CutPictures, CutScene } from './cut-pictures.ts';
import { FINAL, SMALL, WHOLE } from './steps.ts';

/** Who asks for no frame for so long is at rest. */
const REST_MS = 150;

/** So many frames in a row that each took longer than this are a motion that pieces are better for. */
const STUCK_MS = 50;
const STUCK_FRAMES = 8;
/** A longer pause is none of a frame. */
const PAUSE_MS = 3000;
/** A still that takes longer is drawn in pieces the next time. */
const SLOW_STILL_MS = 100;

/** More than any picture has. */
const EVERY_PIXEL = 1e9;

export interface PacedScene extends CutScene {
  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number): boolean;
  /** Null: it makes no difference. */
  draw(level: Quality | null): void;
  /** What refines a picture at rest; undefined where nothing does. */
  refiner(): Pick<SceneRenderer, 'stills' | 'isLost'> | undefined;
}

/** What is under way: a picture in pieces of a motion, or of a scene at rest, or what refines that. */
interface Work {
  isMoving: boolean;
}

export class FramePacer {
  readonly #scene: PacedScene;
  #wanted: WantedQuality = 'auto';
  #samples = 0;
  /** Of motions, where nobody says: at first, and as they flow from when they are watched. */
  #first: Quality = 'medium';
  #auto: AutoQuality | undefined;
  #dirty = false;
  #frame = 0;
  #resting: ReturnType<typeof setTimeout> | undefined;
  /** Of the picture on the screen. */
  #level: Quality | null = null;
  #shown = FINAL;
  /** Counts what would make the time of a still another's. */
  #disturbances = 0;
  /** What the device is remembered by; empty where it is not. */
  #device = '';
  #isCut = false;
  /** A whole still is drawn before anybody would wait for it. */
  #isFast = false;
  #cut: CutPictures | undefined;
  #isFetching = false;
  #work: Work | undefined;
  /** The picture on the screen was drawn in pieces. */
  #isPieced = false;
  #lastFrame = -Infinity;
  #stuck = 0;

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

  /** How many samples a picture at rest is refined with at its best; 0: with none. */
  get samples(): number {
    return this.#samples;
  }

  set samples(samples: number) {
    if (samples === this.#samples) return;
    this.#samples = samples;
    this.invalidate();
  }

  /** Of a picture that is taken and not looked at while it is made. */
  get best(): Quality | null {
    if (!this.#scene.isGraded()) return null;
    return this.#wanted === 'auto' ? 'high' : this.#wanted;
  }

  /** Another renderer draws. Of its device is known what the last visit found out, or its name. */
  renew(device = ''): void {
    const { level, isCut, pixels } = paceOf(device);
    this.#end();
    this.#auto = undefined;
    this.#first = level;
    this.#device = device;
    this.#isCut = isCut;
    this.#isFast = this.#isPieced = false;
    this.#cut = undefined;
    if (isCut) this.#fetch(pixels);
  }

  /** Asks for a frame; many calls, one frame. */
  invalidate(): void {
    this.#dirty = true;
    clearTimeout(this.#resting);
    this.#endStill();
    this.#request();
  }

  /** It may be seen now, or no longer. */
  look(isMoving: boolean): void {
    this.#disturbances += 1;
    if (this.#dirty || isMoving) this.invalidate();
    else if (!this.#isFinal) this.#request();
  }

  stop(): void {
    this.#scene.view().cancelAnimationFrame(this.#frame);
    clearTimeout(this.#resting);
    this.#frame = 0;
    if (this.#work) this.#dirty = true;
    this.#end();
    this.#auto?.rest();
  }

  /** Draws in this very task if it can. A frame that was asked for still comes: more may hang on it than this picture. */
  drawNow(): void {
    if (!this.#scene.canDraw()) this.#dirty = true;
    else if (!this.#isCut) this.#drawMoving();
    else {
      // As it was, until there is another.
      if (this.#isPieced) this.#scene.pieces()?.pieces.show();
      this.invalidate();
    }
  }

  /** What is on the screen, once more, if it can be seen and no frame that is to be drawn comes before it is. */
  redraw(): void {
    if (!this.#scene.canDraw()) this.#dirty = true;
    else if (this.#isPieced) this.#scene.pieces()?.pieces.show();
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
    // Its end asks for the next frame.
    if (this.#work) return;
    if (!this.#dirty) {
      this.#settle();
      return;
    }
    const goesOn = this.#scene.advance(now);
    this.#watch(now);
    this.#drawMoving();
    if (goesOn) this.invalidate();
  }

  /** Takes note of how long frames take. */
  #watch(now: number): void {
    const ms = now - this.#lastFrame;
    this.#lastFrame = now;
    if (this.#isCut) return;
    if (this.#isAuto) this.#watchQuality(now);
    this.#stuck = ms > STUCK_MS && ms < PAUSE_MS ? this.#stuck + 1 : 0;
    if (this.#stuck < STUCK_FRAMES || (this.#isAuto && this.#flowing !== 'low') || !this.#scene.pieces()) return;
    this.#isCut = true;
    if (!this.#cut) this.#fetch(EVERY_PIXEL);
  }

  /** What watches is fetched with the first frame; nothing waits for it. */
  #watchQuality(now: number): void {
    this.#auto?.frame(now);
    if (this.#auto) return;
    const first = this.#first;
    lazily(() => import('../renderer/quality.ts')).then(
      ({ AutoQuality }) => (this.#auto ??= new AutoQuality(first)),
      () => undefined,
    );
  }

  get #flowing(): Quality {
    return this.#auto?.moving ?? this.#first;
  }

  get #isAuto(): boolean {
    return this.#wanted === 'auto' && this.#scene.isGraded();
  }

  get #movingLevel(): Quality | null {
    return this.#isAuto ? this.#flowing : this.best;
  }

  #drawMoving(): void {
    if (this.#isCut && this.#scene.pieces()) {
      this.#drawCut(this.#movingLevel, true);
      return;
    }
    this.#draw(this.#movingLevel);
    if (!this.#dirty && (this.#isAuto || !this.#isFinal)) this.#rest();
  }

  #draw(level: Quality | null): void {
    if (this.#frame === 0) this.#dirty = false;
    clearTimeout(this.#resting);
    this.#disturbances += 1;
    this.#endStill();
    this.#level = level;
    this.#shown = WHOLE;
    if (this.#isPieced) this.#scene.pieces()?.pieces.end();
    this.#isPieced = false;
    this.#scene.draw(level);
  }

  /** By way of a frame: what the pointer did while the GPU was busy arrives with it, and is no rest. */
  #rest(): void {
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      if (this.#scene.canDraw()) this.#request();
      else this.#dirty = true;
    }, REST_MS);
  }

  #settle(): void {
    this.#auto?.rest();
    this.#lastFrame = -Infinity;
    const { best } = this;
    const isCut = this.#isCut && this.#scene.pieces() !== undefined;
    if (this.#shown >= WHOLE && this.#level === best) this.#refine();
    else if (isCut && this.#shown === SMALL) this.#drawCut(this.#movingLevel, false, true);
    else if (isCut || (this.#cut && !this.#isFast && this.#scene.pieces())) this.#drawCut(best, false);
    else this.#drawStill(best);
    if (this.#device)
      rememberPace(this.#device, { level: this.#flowing, isCut: this.#isCut, pixels: this.#isCut ? (this.#cut?.pixels ?? 0) : 0 });
  }

  get #refiner(): ReturnType<PacedScene['refiner']> {
    return this.#samples > 0 && this.best === 'high' ? this.#scene.refiner() : undefined;
  }

  /** Whether no better picture can follow at rest. */
  get #isFinal(): boolean {
    return this.#shown === FINAL || (this.#shown === WHOLE && this.#level === this.best && !this.#refiner);
  }

  #refine(): void {
    const found = this.#scene.pieces();
    const renderer = this.#refiner;
    if (this.#shown === FINAL || !found || !renderer) return;
    const work: Work = { isMoving: false };
    this.#work = work;
    const refinement = {
      ...found,
      renderer,
      samples: this.#samples,
      isPieced: this.#isPieced,
      view: this.#scene.view(),
      holds: () => {
        this.#isPieced = true;
      },
      prepare: () => this.#scene.prepare(this.#level),
      isOver: () => this.#work !== work || !this.#scene.canDraw(),
    };
    const end = (isFinal: boolean): void => {
      if (this.#work !== work) return;
      this.#work = undefined;
      if (isFinal) this.#shown = FINAL;
    };
    // What is refused leaves the picture as it is.
    lazily(() => import('./refine.ts'))
      .then(({ refine }) => refine(refinement))
      .then(end, () => end(true));
  }

  /** At once; how long it took says whether the next one is. */
  #drawStill(level: Quality | null): void {
    this.#draw(level);
    const drawn = this.#disturbances;
    const start = performance.now();
    // The browser gives out the second one when the GPU is done with what the first one came after.
    const view = this.#scene.view();
    view.requestAnimationFrame(() =>
      view.requestAnimationFrame(() => {
        if (drawn !== this.#disturbances) return;
        this.#isFast = performance.now() - start < SLOW_STILL_MS;
        if (!this.#isFast && !this.#cut && this.#scene.pieces()) this.#fetch(EVERY_PIXEL);
        if (!this.#isFinal) this.#request();
      }),
    );
  }

  /** Fetches what draws in pieces; until it is there, what is on the screen stays. */
  #fetch(pixels: number): void {
    if (this.#isFetching) return;
    this.#isFetching = true;
    const device = this.#device;
    lazily(() => import('./cut-pictures.ts'))
      .then(
        ({ CutPictures }) => {
          if (device !== this.#device) return;
          const cut = new CutPictures(pixels);
          this.#cut = cut;
          cut.ready(this.#scene, this.#movingLevel, () => this.#cut === cut);
        },
        // Without it pictures are drawn whole.
        () => (this.#isCut = false),
      )
      .finally(() => {
        this.#isFetching = false;
        if (this.#dirty) this.#request();
      });
  }

  #drawCut(level: Quality | null, isMoving: boolean, mayBeRough = false): void {
    const cut = this.#cut;
    if (!cut) {
      this.#fetch(0);
      return;
    }
    if (isMoving && this.#frame === 0) this.#dirty = false;
    clearTimeout(this.#resting);
    this.#disturbances += 1;
    const work: Work = { isMoving };
    this.#work = work;
    void cut
      .show(this.#scene, { level, isMoving, mayBeRough }, () => this.#work === work)
      .then((shown) => {
        if (this.#work !== work) return;
        this.#work = undefined;
        // Or else it went out of sight.
        if (shown === undefined) this.#dirty = true;
        else {
          this.#level = level;
          this.#shown = shown;
          this.#isPieced = true;
          if (isMoving && cut.isNeedless && !isSoftware(this.#device)) this.#isCut = false;
        }
        if (!isMoving) this.#request();
        else if (!this.#dirty) this.#rest();
        else {
          // The next one of a motion does not wait for the screen, which is faster than these are.
          this.#scene.view().cancelAnimationFrame(this.#frame);
          this.#onFrame(performance.now());
        }
      });
  }

  /** Ends what is under way. */
  #end(): void {
    this.#work = undefined;
  }

  /** The same, unless it is of a motion: that is followed by what has changed since. */
  #endStill(): void {
    if (this.#work && !this.#work.isMoving) this.#end();
  }
}
