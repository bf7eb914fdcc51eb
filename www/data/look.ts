/** What natural colours show beyond the meshes; the sun shines in all colours. As the parameters of the same names. */
export interface Look {
  variation: number;
  wetness: number;
  moss: number;
  dust: number;
  snow: number;
  water: number;
  /** The place of the word among the choices of the parameter. */
  ground: number;
  /** Degrees. */
  sunAzimuth: number;
  sunElevation: number;
  /** `material` is a place among the choices too. */
  layers: readonly { id: number; material: number }[];
  flesh?: Flesh;
}

/** Of wood ears, as the parameters of the same names; moisture 0 … 1. */
export interface Flesh {
  moisture: number;
  variation: number;
  translucency: number;
  velvet: number;
}
