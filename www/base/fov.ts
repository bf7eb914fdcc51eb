/** The vertical field of view of cameras, degrees. */

/** Where none is given: so narrow that boulders do not seem to lean. */
export const FOV = 36;

/** From what a long lens shows to where the corners of a picture are stretched beyond use. */
export const FOV_BOUNDS = { min: 5, max: 120 };

interface Lens {
  fov?: number | undefined;
}

/** A camera's, in radians. */
export function fovOf({ fov = FOV }: Lens): number {
  return (fov * Math.PI) / 180;
}

/** Half the height of a camera's picture at a distance of one. */
export function tangentOf(camera: Lens): number {
  return Math.tan(fovOf(camera) / 2);
}
