/**
 * The one face of every renderer: the page talks to this and never to wasm, WebGPU or WebGL.
 *
 * World: plane x right, y up, in pixels of the image; z up. Nothing is drawn but by `render()`.
 */

import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import type { Layer, PARAMS, Params, ParamSpec } from '../rocks/params.ts';

/** `3d` and `wireframe` are seen through the camera; `diagrams` and `selection` are plans, north (+y) up. */
export type View = '3d' | 'wireframe' | 'diagrams' | 'selection';

/** One colour per layer, one per rock, the papers' plain grey, or stone, moss and dust as in a photograph. */
export type ColorMode = 'layer' | 'rock' | 'plain' | 'natural';

/** How much work a pixel is worth, in natural colours. */
export const QUALITIES = ['low', 'medium', 'high'] as const;
export type Quality = (typeof QUALITIES)[number];

export type Backend = 'webgpu' | 'webgl' | 'canvas2d' | 'null';

/** Where the eye is: at azimuth 0 it looks along +y; growing azimuth carries it counter-clockwise round the target. */
export interface CameraState {
  /** Radians, counter-clockwise seen from above. */
  azimuth: number;
  /** Radians above the ground; π/2 looks straight down. */
  elevation: number;
  /** From the eye to the target, px. */
  distance: number;
  /** The point in the middle of the picture, px. */
  target: [number, number, number];
}

export interface SceneStyle {
  view: View;
  color: ColorMode;
  /** The page's theme: backdrop and sky, never the rocks. */
  dark: boolean;
}

/** What natural colours show beyond the mesh; the sun shines in all colours. As the parameters of the same names. */
export type Look = Pick<Params, LookKey<'field'>> & { layers: readonly ({ id: number } & Pick<Layer, LookKey<'layer'>>)[]; flesh?: Flesh };

/** Of wood ears, as the parameters of the same names; moisture 0 … 1. */
export interface Flesh {
  moisture: number;
  variation: number;
  translucency: number;
  velvet: number;
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

type LookKey<S extends ParamSpec['scope']> = Extract<(typeof PARAMS)[number], { stage: 'look'; scope: S }>['key'];

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
  /** The device or context is lost, or about to be told so: what is drawn now is blank. */
  readonly isLost: boolean;
  /** Resolves, and never rejects, with a reason when the device or context is lost. */
  readonly lost: Promise<string>;
  /** Frees what the renderer holds; calls after it do nothing. */
  dispose(): void;
}
