/** Vertical field of view, radians: 36°. The same number is in `src/render/camera.rs`. */
export const FOV_Y = (36 * Math.PI) / 180;
