/**
 * The one face of every renderer: the page talks to this and never to wasm, WebGPU or WebGL.
 *
 * World: plane x right, y up, in pixels of the image; z up. Nothing is drawn but by `render()`.
 */

import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import type { Look } from '../data/look.ts';
import type { Backend, CameraState, ColorMode, Quality, View } from '../base/view.ts';

export interface SceneStyle {
  view: View;
  color: ColorMode;
  /** The page's theme: backdrop and sky, never the rocks. */
  dark: boolean;
}

/** A log with its colony, and where they stand among the rocks. */
export interface Wood {
  colony: WoodEarColony;
  /** Of the layout of an individual's vertices. */
  rings: number;
  meridians: number;
  /** Where the log's origin is, px; px per cm. */
  place: readonly [x: number, y: number, z: number, scale: number];
}

/** A part of a picture, device pixels. */
export interface Tile {
  /** Of the whole picture. */
  whole: readonly [width: number, height: number];
  /** Its upper left corner in the whole. */
  corner: readonly [x: number, y: number];
  size: readonly [width: number, height: number];
  /** What stands in for ground and backdrop. */
  backing: 'none' | 'black' | 'white';
}

/** What depth of field comes from, px. */
export interface Lens {
  /** Of the lens. */
  radius: number;
  /** From the eye to the plane that is sharp. */
  focus: number;
}

export interface Stills {
  /**
   * Begins one of what the camera shows now, at the present size; `tile` is of a part. Without a lens everything is sharp. What is drawn must not change
   * until `end`. Wait for `done` before it: a page may have to wait here for a device that is busy.
   */
  begin(tile?: Tile, lens?: Lens): void;
  /** As `Pieces.make`, for samples. */
  make(): boolean;
  /** Draws the next part of a sample, out of sight: of its shadow maps, or a piece of about so many pixels. False: the sample is whole. */
  draw(pixels: number): boolean;
  /** Resolves when the device is done with what it was given; rejects where it had no memory for the still. */
  done(): Promise<void>;
  /** Shows the mean of the samples now, at the size of `begin`. */
  show(): void;
  /** Draws the mean over the picture in pieces that is shown, with this opacity, and shows it. Nothing happens where that is of another size. */
  blend(opacity: number): void;
  /** Frees what the still holds. */
  end(): void;
}

/** Pictures that are drawn in pieces, out of sight: none of them takes a device long, and the page goes on between them. */
export interface Pieces {
  /** Makes one of the things that such a picture lacks, none of which takes long. False: nothing is lacking. */
  make(isRough: boolean): boolean;
  /** Whether the device is still making some of them, and there is nothing to do but wait. */
  isMaking(): boolean;
  /**
   * Begins a picture of what is drawn now, through the camera of now; device pixels, whatever the size on the screen is. A rough one has one
   * sample a pixel. What it shows must not change until it is whole, but for the camera.
   */
  begin(width: number, height: number, isRough: boolean): void;
  /** Draws a part of what gives it light, which all pieces need, as a piece is drawn. False: nothing was lacking. */
  light(): boolean;
  /** Draws the next piece, of about so many pixels. False: that was the last. */
  draw(pixels: number): boolean;
  /** How many pieces the device has not drawn yet. */
  underWay(): number;
  /** Shows the picture if it is whole, and else the one that was shown before, if there is one, as large as the canvas. */
  show(): void;
  /** Frees what both hold. */
  end(): void;
}

export interface SceneRenderer {
  readonly backend: Backend;
  readonly canvas: HTMLCanvasElement;
  /** Uploads `field` and replaces what is drawn as one step; on an error the old field stays. */
  setField(field: Field): void;
  /** Uploads a log with its colony and replaces those that are drawn as one step, `null` with none; on an error the old ones stay. */
  setWood(wood: Wood | null): void;
  setStyle(style: SceneStyle): void;
  setLook(look: Look): void;
  setQuality(level: Quality): void;
  setCamera(camera: CameraState): void;
  /** Device pixels; below 1 counts as 1, above the device's largest texture as that. */
  resize(width: number, height: number): void;
  /** Draws one frame now. */
  render(): void;
  /** The most pixels that it draws in a row or a column; absent without a GPU. */
  readonly maxSide?: number;
  /** Draws a part of a picture now, which may be larger than the device draws; `resize` comes next. Absent without a GPU. */
  renderTile?(tile: Tile): void;
  /**
   * Makes stills: the mean of many samples of a picture in natural colours, which converges to what the sun, the sky and one bounce of light
   * give. Absent without a GPU.
   */
  stills?(): Promise<Stills>;
  /** Draws pictures in pieces. Absent without a GPU. */
  readonly pieces?: Pieces;
  /** What the browser calls the device; empty without a GPU. */
  readonly deviceName?: string;
  /** The device or context is lost, or about to be told so: what is drawn now is blank. */
  readonly isLost: boolean;
  /** Resolves, and never rejects, with a reason when the device or context is lost. */
  readonly lost: Promise<string>;
  /** Frees what the renderer holds; calls after it do nothing. */
  dispose(): void;
}
