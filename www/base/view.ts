/** How a picture is seen: the words that attributes, links, elements, controls and renderers share. */

/** `3d` and `wireframe` are seen through the camera; `diagrams` and `selection` are plans, north (+y) up. */
export type View = '3d' | 'wireframe' | 'diagrams' | 'selection';

/** One colour per layer, one per rock, the papers' plain grey, or stone, moss and dust as in a photograph. */
export type ColorMode = 'layer' | 'rock' | 'plain' | 'natural';

/** How much work a pixel is worth, in natural colours. */
export const QUALITIES = ['low', 'medium', 'high'] as const;
export type Quality = (typeof QUALITIES)[number];

/** As the attribute `quality` has it. */
export const QUALITY_CHOICES = ['auto', ...QUALITIES] as const;
export type WantedQuality = (typeof QUALITY_CHOICES)[number];

export type Backend = 'webgpu' | 'webgl' | 'canvas2d' | 'null';
/** The backends that are a wasm renderer. */
export type GpuBackend = 'webgpu' | 'webgl';

/** What moves the camera; the first is the default, as in the lists below. */
export const INTERACTIONS = ['cooperative', 'always', 'none'] as const;
export type Interaction = (typeof INTERACTIONS)[number];

/** How hands move the camera: round what it looks at, or as somebody who walks on the ground. */
export const NAVIGATIONS = ['orbit', 'walk'] as const;
export type Navigation = (typeof NAVIGATIONS)[number];

export const THEMES = ['auto', 'light', 'dark'] as const;
export type Theme = (typeof THEMES)[number];

export const LOADINGS = ['eager', 'lazy'] as const;
export type Loading = (typeof LOADINGS)[number];

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
  /** Vertical field of view, degrees; as the attribute `fov` where it is left out. */
  fov?: number | undefined;
}
