/** Numbers that pictures of every kind share. */

/** A 4K screen's worth. With 4 samples a pixel takes some 40 bytes, so this is 330 MB on the device. */
export const MAX_PIXELS = 3840 * 2160;

/** Of a still: twice as many would halve what nobody sees any more. */
export const MAX_SAMPLES = 4096;

/** Of a still that a picture at rest is refined into, where nobody says. */
export const REST_SAMPLES = 64;
export const SAMPLES_BOUNDS = { min: 0, max: MAX_SAMPLES };

/** Of a picture that is drawn in parts, pixels in a row and in a column. */
export const MAX_SIDE = 16_384;
