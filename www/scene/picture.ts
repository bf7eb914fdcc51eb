/** The picture as a file. */

import { notConnected, RockFieldError } from '../base/errors.ts';
import type { ErrorName } from '../base/errors.ts';
import { errorText } from './renderer-keeper.ts';
import type { CameraState } from '../base/view.ts';
import { KEYWORD, originOf } from '../export/origin/origin.ts';
import { withText } from '../export/origin/png-text.ts';
import type { Field } from '../data/field.ts';
import type { Wood } from '../renderer/renderer.ts';
import type { Failures } from './failures.ts';
import { checkLens, lensOf } from './lens.ts';
import type { LensOptions } from './lens.ts';
import type { FramePacer } from './frame-pacer.ts';
import type { SceneRenderer } from '../renderer/renderer.ts';
import type { StageSize } from './stage-size.ts';
import type { Link } from '../table/link.ts';
import { isMade } from '../table/row.ts';
import { same } from '../table/table.ts';
import type { Edition, Kind, Table } from '../table/table.ts';
import type { TiledPicture } from './tiles.ts';
import { lazily } from '../base/lazy.ts';
import { MAX_PIXELS, MAX_SAMPLES, MAX_SIDE } from '../renderer/limits.ts';

export interface PictureOptions extends LensOptions {
  /** Device pixels; one follows from the other, and both from the size on the screen, when left out. */
  width?: number;
  height?: number;
  /** `image/png`, `image/jpeg` or `image/webp`. */
  type?: string;
  /** 0 … 1, of lossy types. */
  quality?: number;
  /**
   * How many samples the picture is the mean of, in natural colours, 1 … 4096: each in the light of another point of the sun, the sky and the
   * ground. Left out, light and shade are worked out at once, and less exactly.
   */
  samples?: number;
  /** Whether ground and backdrop are in it. Without them a PNG is transparent around the rocks, but for their shadows. True by default. */
  ground?: boolean;
  /** Ends a picture that takes longer, which is one of more pixels than a screen has. */
  signal?: AbortSignal | undefined;
  /** Called while such a picture is drawn, with 0 … 1. */
  onProgress?: ((fraction: number) => void) | undefined;
  /** Whether a PNG file carries the link to what it shows: dropped on the page, it brings it back. True by default. */
  link?: boolean;
}

/** What is in a picture: all that its file says of it comes from this. */
export interface PictureSource {
  definition: {
    table: Table<Kind>;
    encode(state: Link<Kind>): string;
    hash(result: object): Promise<string>;
  };
  settled: Edition<Kind>;
  onScreen: Edition<Kind>;
  /** How it is seen. */
  seenSettled: Pick<Link<Kind>, 'view' | 'color' | 'camera'>;
  result: object | null;
  metresPerPixel: number;
}

const PNG = 'image/png';

/** Of a picture that has no place on the screen, px. */
const UNSEEN_SIZE: [number, number] = [300, 150];

/** How long a picture is waited for. */
const PICTURE_TIMEOUT_MS = 120_000;

/** A device that is lost again and again is waited for no longer than this. */
const LOSSES_MS = 120_000;

/** What the picture is of. */
interface Pictured {
  /** Begins to load, if that has not begun. */
  start(): void;
  /** Whether there is what to draw and what to draw it with. */
  hasPicture(): boolean;
  /** Whether the element is in a document, or has just been. */
  isOpen(): boolean;
  failures: Pick<Failures, 'error' | 'wait'>;
  pacer: Pick<FramePacer, 'best' | 'redraw'>;
  renderer(): SceneRenderer | undefined;
  size(): StageSize | undefined;
  camera(aspect: number): CameraState;
  /** What is drawn, and how: as long as these are the same, so is the picture. */
  drawn(): readonly [Field | null, Wood | null, ...unknown[]];
  source(): PictureSource;
}

/** The picture as a file, as soon as there is one; taken again when the device was lost meanwhile, since it is blank then. */
export async function picture(options: PictureOptions, scene: Pictured): Promise<Blob> {
  checkSamples(options.samples, options.ground);
  checkLens(options);
  for (const end = performance.now() + LOSSES_MS; ; ) {
    await drawable(scene);
    const renderer = scene.renderer();
    const stage = scene.size();
    if (!renderer || !stage) throw new RockFieldError({ name: 'NoPicture', message: 'there is no picture' });
    // In a tab that nobody sees, nobody has told the size yet.
    if (stage.isEmpty) stage.measure();
    const own = stage.isEmpty ? UNSEEN_SIZE : stage.pixels;
    const isTiled = needsTiles(options, own, renderer);
    const size = pictureSize(options, own, isTiled);
    const source = scene.source();
    const aspect = size[0] / size[1];
    const camera = scene.camera(aspect);
    const [field, wood] = scene.drawn();
    const shot: Shot = {
      renderer,
      size,
      camera,
      lens: lensOf(options, { camera, aspect, field, wood, metresPerPixel: source.metresPerPixel }),
      prepare: () => {
        const { best } = scene.pacer;
        if (best) renderer.setQuality(best);
      },
      // In the same task the screen gets its own picture back.
      restore: () => {
        renderer.resize(...stage.pixels);
        scene.pacer.redraw();
      },
    };
    // Other styles have no light to be sampled.
    const samples = scene.pacer.best ? options.samples : undefined;
    const taken = isTiled
      ? takeTiles(shot, samples, options, scene)
      : samples
        ? takeStill(shot, samples, options, scene)
        : take(shot, options);
    const blob = await taken.catch((thrown: unknown) => {
      if (!renderer.isLost || options.signal?.aborted) throw thrown;
    });
    if (blob && (await isSound(renderer))) return options.link !== false && blob.type === PNG ? withOrigin(blob, source) : blob;
    if (performance.now() > end)
      throw new RockFieldError({ name: 'NoPicture', message: 'the graphics device is lost, or the scene changes, again and again' });
  }
}

/** A picture that is about to be taken. */
type Shot = Pick<TiledPicture, 'renderer' | 'size' | 'camera' | 'lens' | 'prepare' | 'restore'>;

function take({ renderer, size, camera, prepare, restore }: Shot, options: PictureOptions): Promise<Blob> {
  prepare();
  const taken = takePicture(renderer, size, camera, options);
  restore();
  return taken;
}

/** Sample by sample; undefined where the scene changed meanwhile. */
async function takeStill(shot: Shot, samples: number, options: PictureOptions, scene: Pictured): Promise<Blob | undefined> {
  const { stillPicture } = await lazily(() => import('./still.ts'));
  const { signal, onProgress } = options;
  try {
    return await stillPicture({ ...shot, samples, isSame: sameness(scene), signal, onProgress }, () => encoded(shot.renderer, options));
  } catch (thrown) {
    throw signal?.aborted ? thrown : pictureError(thrown);
  }
}

/** Whether a scene is drawn as it is now. */
function sameness(scene: Pictured): () => boolean {
  const before = scene.drawn();
  return () => scene.drawn().every((value, k) => value === before[k]);
}

/** In parts; undefined where the scene changed meanwhile. */
async function takeTiles(
  shot: Shot,
  samples: number | undefined,
  { ground = true, signal, onProgress }: PictureOptions,
  scene: Pictured,
): Promise<Blob | undefined> {
  const { tiledPicture } = await lazily(() => import('./tiles.ts'));
  try {
    return await tiledPicture({ ...shot, samples, isBare: !ground, isSame: sameness(scene), signal, onProgress });
  } catch (thrown) {
    throw signal?.aborted ? thrown : pictureError(thrown);
  }
}

/** The same picture, with what brings it back. */
async function withOrigin(png: Blob, source: PictureSource): Promise<Blob> {
  const { definition, settled, onScreen, seenSettled, result, metresPerPixel } = source;
  // Of a run that goes on, a preview may be on screen, which has no hash that anybody could find again.
  const isWhole = same(definition.table, settled.params, onScreen.params, isMade);
  const link = definition.encode({ ...(isWhole ? settled : onScreen), ...seenSettled });
  const hash = isWhole && result ? await definition.hash(result) : '';
  return withText(png, KEYWORD, JSON.stringify(originOf({ link, hash, metresPerPixel })));
}

/** Resolves when there is a picture to take; rejects when there will be none, or the cycle ends. */
function drawable(scene: Pictured): Promise<void> {
  scene.start();
  if (scene.hasPicture()) return Promise.resolve();
  const failure = scene.isOpen() ? scene.failures.error : notConnected();
  if (failure) return Promise.reject(failure);
  return new Promise((resolve, reject) => {
    const timer = setTimeout(
      () => reject(new RockFieldError({ name: 'NoPicture', message: 'there was no picture within two minutes' })),
      PICTURE_TIMEOUT_MS,
    );
    scene.failures.wait((error) => {
      clearTimeout(timer);
      if (error) reject(error);
      else resolve();
    });
  });
}

/** As asked for, unchecked: one side follows from the other. */
function sizeOf({ width, height }: PictureOptions, [ownWidth, ownHeight]: readonly [number, number]): [number, number] {
  return [
    width ?? Math.round((ownWidth * (height ?? ownHeight)) / ownHeight),
    height ?? Math.round((ownHeight * (width ?? ownWidth)) / ownWidth),
  ];
}

/**
 * Whether a picture has to be drawn in parts.
 *
 * @throws {RockFieldError} `OutOfRange` for a type of file that is not written so, `NoPicture` where this renderer does not draw so.
 */
function needsTiles(options: PictureOptions, own: readonly [number, number], { renderTile, maxSide = MAX_SIDE }: SceneRenderer): boolean {
  const { type = PNG, ground = true } = options;
  const [width, height] = sizeOf(options, own);
  if (ground && (type !== PNG || !renderTile)) return false;
  if (type !== PNG) {
    const message = `type is ${type}; a picture without the ground is ${PNG}`;
    throw new RockFieldError({ name: 'OutOfRange', key: 'type', value: type, message });
  }
  if (!renderTile) throw new RockFieldError({ name: 'NoPicture', message: 'without a GPU there is no picture without the ground' });
  return !ground || width * height > MAX_PIXELS || Math.max(width, height) > maxSide;
}

/** @throws {RockFieldError} `OutOfRange` for a number of samples that is not drawn. */
function checkSamples(samples: number | undefined, ground = true): void {
  if (samples === undefined) return;
  const bounds = { key: 'samples', value: samples, min: 1, max: MAX_SAMPLES };
  if (!(Number.isInteger(samples) && samples >= 1 && samples <= MAX_SAMPLES)) {
    const message = `samples is ${samples}; a picture is the mean of a whole number of samples, at most ${MAX_SAMPLES}`;
    throw new RockFieldError({ name: 'OutOfRange', ...bounds, message });
  }
  if (!ground) {
    const message = `samples is ${samples}; a picture without the ground is not the mean of samples`;
    throw new RockFieldError({ name: 'OutOfRange', ...bounds, message });
  }
}

/**
 * Width and height in pixels.
 *
 * @throws {RockFieldError} `OutOfRange` for a size that cannot be drawn.
 */
function pictureSize(options: PictureOptions, own: readonly [number, number], isTiled: boolean): [number, number] {
  const size = sizeOf(options, own);
  const fits = (value: number): boolean => (isTiled ? value <= MAX_SIDE : size[0] * size[1] <= MAX_PIXELS);
  const sides = [
    ['width', size[0]],
    ['height', size[1]],
  ] as const;
  const max = isTiled ? MAX_SIDE : MAX_PIXELS;
  // What follows from a wrong side is wrong too: the side that was given is named.
  for (const [key, value] of options.width === undefined ? [...sides].reverse() : sides) {
    if (Number.isInteger(value) && value >= 1 && fits(value)) continue;
    const message = `${key} is ${value}; a picture has whole numbers of pixels, at most ${max} ${isTiled ? 'in a row or a column' : 'together'}`;
    throw new RockFieldError({ name: 'OutOfRange', key, value, min: 1, max, message });
  }
  return size;
}

/**
 * Draws through `camera` at `size` and takes what is in the canvas, at once; only the encoding comes later.
 *
 * @throws {RockFieldError} `OutOfRange` for a size that this device does not draw, `NoPicture` where the browser makes no file, and what the
 *   renderer refuses, by its name.
 */
export async function takePicture(
  renderer: SceneRenderer,
  size: readonly [number, number],
  camera: CameraState,
  options: PictureOptions,
): Promise<Blob> {
  try {
    draw(renderer, size, camera);
  } catch (thrown) {
    throw pictureError(thrown);
  }
  return encoded(renderer, options);
}

/** What is in the canvas, at once; only the encoding comes later. */
async function encoded(renderer: SceneRenderer, { type = PNG, quality }: PictureOptions): Promise<Blob> {
  const blob = await new Promise<Blob | null>((resolve) => renderer.canvas.toBlob(resolve, type, quality));
  if (!blob) throw new RockFieldError({ name: 'NoPicture', message: 'the browser made no file of the picture' });
  return blob;
}

/** What a renderer says of itself (`src/render/error.rs`) when it is asked for a picture. */
const RENDERER_ERRORS = ['NoSurface', 'FieldTooLarge', 'MalformedField'] as const satisfies readonly ErrorName[];

/** Of what a renderer throws, an error of the list. */
function pictureError(thrown: unknown): RockFieldError {
  if (thrown instanceof RockFieldError) return thrown;
  const name = RENDERER_ERRORS.find((known) => thrown instanceof Error && thrown.name === known);
  return new RockFieldError(
    { name: name ?? 'RendererFailed', message: name ? errorText(thrown) : `the picture could not be made: ${errorText(thrown)}` },
    { cause: thrown },
  );
}

function draw(renderer: SceneRenderer, size: readonly [number, number], camera: CameraState): void {
  renderer.resize(...size);
  // A device has its own limit, and draws no larger.
  for (const [key, value, drawn] of [
    ['width', size[0], renderer.canvas.width],
    ['height', size[1], renderer.canvas.height],
  ] as const) {
    if (drawn === value) continue;
    throw new RockFieldError({
      name: 'OutOfRange',
      key,
      value,
      min: 1,
      max: drawn,
      message: `${key} is ${value}; this device draws at most ${drawn} pixels in a row`,
    });
  }
  renderer.setCamera(camera);
  renderer.render();
}

/** Between a loss and the news of it. */
const LOSS_MS = 50;

/** Whether what was drawn last was drawn: WebGPU and 2D canvases tell of a loss some time after they have given a blank picture. */
async function isSound(renderer: SceneRenderer): Promise<boolean> {
  if (renderer.backend === 'webgpu') {
    const { deviceDone } = await lazily(() => import('../renderer/done.ts'));
    await deviceDone(renderer.canvas, renderer.backend);
  }
  if (renderer.backend !== 'webgl') await Promise.race([renderer.lost, new Promise((resolve) => setTimeout(resolve, LOSS_MS))]);
  return !renderer.isLost;
}
