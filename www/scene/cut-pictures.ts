/**
 * Draws pictures in pieces, for devices on which a whole one takes longer than a page may wait. Nothing here waits for the device: it is asked
 * again and again how much it has done.
 *
 * Of a motion, all pieces of a picture are handed over at once, since the next one is wanted from another place; its size is what the device
 * draws in time. A still is drawn piece by piece, each as large as the device can draw while somebody waits, and ends at once when it is not
 * wanted any more.
 */

import type { Quality } from '../base/view.ts';
import type { Pieces } from '../renderer/renderer.ts';
import { ROUGH, SMALL, WHOLE } from './steps.ts';

/** A picture of a motion is to take so long, ms, and changes its size where it takes more or less than this. */
const MOTION_MS = 75;
const [TOO_FAST_MS, TOO_SLOW_MS] = [50, 100];
/** Smallest share of a side that is drawn. */
const LEAST_SCALE = 0.2;
/** Before anything is known of the device, a picture has at most so many pixels. */
const FIRST_PIXELS = 24_000;
/** A whole picture in less, twice, is a device on which nothing has to be cut. */
const WHOLE_MS = 14;
const WHOLE_PICTURES = 2;

/** How often the device is asked while it draws a picture of a motion, ms; while it draws a still, with every frame of the screen. */
const POLL_MS = 4;

/** What takes longer is followed by a task of its own, ms. */
const LONG_MS = 10;

/** A piece of a still is to take so long, ms. Two are under way, so that the device never waits for the screen. */
const PIECE_MS = 40;
const UNDER_WAY = 2;
/** Pixels. Every piece also costs the triangles that cross it: smaller than the least, they would make up most of its time. */
const [FIRST_PIECE, LEAST_PIECE, LARGEST_PIECE] = [24_576, 12_288, 1_048_576];

/** What is drawn in pieces. */
export interface CutScene {
  /** The window it is in; it may come into another. */
  view(): Window;
  canDraw(): boolean;
  /** Whether the quality makes a difference to what is shown. */
  isGraded(): boolean;
  /** What draws in pieces, and for a stage of which size; undefined where nothing does. */
  pieces(): { pieces: Pieces; size: readonly [number, number] } | undefined;
  /** Readies the renderer for a picture in pieces through the camera of now. What it returns is called with what shows the picture. */
  prepare(level: Quality | null): (show: () => void) => void;
}

interface Wanted {
  level: Quality | null;
  /** One of a motion, or else a still. */
  isMoving: boolean;
  /** A still that another follows. */
  mayBeRough: boolean;
}

export interface CutPicture {
  pieces: Pieces;
  view: Window;
  /** Of the stage, device pixels. */
  size: readonly [width: number, height: number];
  /** One of a motion, or else a still. */
  isMoving: boolean;
  /** With one sample a pixel; one of a motion is so if it is smaller than the stage. */
  isRough: boolean;
  /** Readies the renderer: what else is drawn with it may come between pieces. */
  prepare(): void;
  /** Whether nobody wants it any more. */
  isOver(): boolean;
}

/** The still that is being drawn. */
let drawing: CutPicture | undefined;

export class CutPictures {
  /** Of a picture of a motion; 0 before it is known. */
  pixels: number;
  /** Of a still's pieces. */
  #piece = FIRST_PIECE;
  #fastOnes = 0;
  /** What was drawn before: the first of a kind also makes its pipelines, and tells nothing of the next. */
  readonly #seen = new Set<string>();

  constructor(pixels: number) {
    this.pixels = pixels;
  }

  /** Whether whole pictures take so little that none has to be cut. */
  get isNeedless(): boolean {
    return this.#fastOnes >= WHOLE_PICTURES;
  }

  /** Whether a picture of a motion is smaller than a stage of this size. */
  isScaled(size: readonly [number, number]): boolean {
    return this.#scaleFor(size) < 1;
  }

  /**
   * Draws a picture of the scene and shows it: what is on the screen then, or undefined where it went out of sight. Nothing is shown that is not
   * wanted any more.
   */
  async show(scene: CutScene, { level, isMoving, mayBeRough }: Wanted, isWanted: () => boolean): Promise<number | undefined> {
    const found = scene.pieces();
    if (!found) return undefined;
    const { pieces, size } = found;
    const isRough = mayBeRough && scene.isGraded();
    const step = isMoving && this.isScaled(size) ? SMALL : isRough ? ROUGH : WHOLE;
    let shown = (_show: () => void): void => {};
    const prepare = (): void => {
      shown = scene.prepare(level);
    };
    const isOver = (): boolean => !isWanted() || !scene.canDraw();
    try {
      const isDrawn = await this.draw({ pieces, size, isMoving, isRough, view: scene.view(), prepare, isOver }, String(level));
      if (!isWanted()) return undefined;
      if (isDrawn) shown(() => pieces.show());
      else pieces.show();
      return isDrawn ? step : undefined;
    } catch (thrown) {
      if (isWanted())
        shown(() => {
          throw thrown;
        });
      return step;
    }
  }

  /** Makes what the first picture of a motion needs, while what it shows is still grown. */
  ready(scene: CutScene, level: Quality | null, isWanted: () => boolean): void {
    const found = scene.pieces();
    if (!found || scene.canDraw()) return;
    const picture = { ...found, prepare: () => void scene.prepare(level), isOver: () => !isWanted() || scene.canDraw() };
    // Nobody waits for it: what is refused is told when it is drawn.
    this.#make(picture, this.isScaled(found.size)).catch(() => undefined);
  }

  /** True when the picture is whole; it is still to be shown. `kind` is what its pipelines depend on. */
  async draw(picture: CutPicture, kind: string): Promise<boolean> {
    const { pieces, size, isMoving, isOver } = picture;
    const scale = isMoving ? this.#scaleFor(size) : 1;
    const [width, height] = size.map((side) => Math.max(1, Math.round(side * scale))) as [number, number];
    const isRough = isMoving ? scale < 1 : picture.isRough;
    if (!(await this.#make(picture, isRough))) return false;
    pieces.begin(width, height, isRough);
    const start = performance.now();
    if (isMoving) {
      if (!(await this.#light(picture))) return false;
      while (pieces.draw(this.#piece));
    }
    const isDone = isMoving ? await this.#wait(picture) : await this.#inTurn(picture);
    const of = `${kind} ${isRough}`;
    if (isDone && isMoving && this.#seen.has(of)) this.#took(performance.now() - start, size, scale);
    if (isDone) this.#seen.add(of);
    return isDone && !isOver();
  }

  /** Makes what such pictures lack, in short tasks; the renderer is ready after it. False when nobody wants one any more. */
  async #make({ pieces, prepare, isOver }: Pick<CutPicture, 'pieces' | 'prepare' | 'isOver'>, isRough: boolean): Promise<boolean> {
    for (;;) {
      const start = performance.now();
      prepare();
      do if (!pieces.make(isRough)) return true;
      while (!pieces.isMaking() && performance.now() - start < LONG_MS);
      await nextTask();
      if (isOver()) return false;
    }
  }

  /** Has all drawn that gives light to a picture of a motion, in short tasks. False when nobody wants it any more. */
  async #light({ pieces, prepare, isOver }: CutPicture): Promise<boolean> {
    for (let since = performance.now(); pieces.light(); ) {
      if (performance.now() - since < LONG_MS) continue;
      await nextTask();
      if (isOver()) return false;
      prepare();
      since = performance.now();
    }
    return true;
  }

  async #wait({ pieces, isOver }: CutPicture): Promise<boolean> {
    while (pieces.underWay() > 0) {
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
      if (isOver()) return false;
    }
    return true;
  }

  /**
   * Stills of a page are drawn one after the other: elements share the maps of light on a device, and those who drew in turns would begin theirs
   * again and again. One that nobody wants any more keeps nobody waiting, though its window may never have another frame.
   */
  async #inTurn(picture: CutPicture): Promise<boolean> {
    while (drawing && !drawing.isOver()) {
      await nextFrame(picture.view);
      if (picture.isOver()) return false;
    }
    drawing = picture;
    try {
      return await this.#drawn(picture);
    } finally {
      if (drawing === picture) drawing = undefined;
    }
  }

  async #drawn({ pieces, view, prepare, isOver }: CutPicture): Promise<boolean> {
    let isLit = false;
    let goesOn = true;
    let given = 0;
    let last = performance.now();
    while (goesOn || pieces.underWay() > 0) {
      const under = pieces.underWay();
      const now = performance.now();
      // The first ones also make pipelines.
      if (given > UNDER_WAY && goesOn) this.#pieceTook(now - last, UNDER_WAY - under, under === 0);
      last = now;
      prepare();
      for (let k = under; goesOn && k < UNDER_WAY; k += 1) {
        isLit ||= !pieces.light();
        if (!isLit) continue;
        goesOn = pieces.draw(this.#piece);
        given += 1;
      }
      await nextFrame(view);
      if (isOver()) return false;
    }
    return true;
  }

  /** `done` pieces were drawn within so many ms; perhaps the device has nothing to do since. */
  #pieceTook(ms: number, done: number, isIdle: boolean): void {
    if (isIdle) this.#piece *= ms < PIECE_MS ? 2 : 1;
    else if (done === 0) this.#piece *= ms > PIECE_MS ? 0.7 : 0.95;
    this.#piece = Math.round(Math.min(LARGEST_PIECE, Math.max(LEAST_PIECE, this.#piece)));
  }

  #scaleFor([width, height]: readonly [number, number]): number {
    return Math.min(1, Math.max(LEAST_SCALE, Math.sqrt((this.pixels || FIRST_PIXELS) / (width * height))));
  }

  /** A picture of a motion was there after so many ms. */
  #took(ms: number, [width, height]: readonly [number, number], scale: number): void {
    this.#fastOnes = scale === 1 && ms < WHOLE_MS ? this.#fastOnes + 1 : 0;
    if (ms > TOO_FAST_MS && ms < TOO_SLOW_MS) return;
    this.pixels = Math.round(width * height * scale ** 2 * Math.min(2, MOTION_MS / ms));
  }
}

function nextTask(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

function nextFrame(view: Window): Promise<number> {
  return new Promise((resolve) => view.requestAnimationFrame(resolve));
}
