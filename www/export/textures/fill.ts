/** What lies between the patches of an atlas, so that neither filtering nor smaller copies of it mix anything foreign into their edges. */

/** Bytes of a texel; in the last of them 255 says that it was drawn. */
export const TEXEL = 8;

/**
 * Gives every texel that was not drawn the mean of what was drawn nearby, first among 2 × 2 texels, else among 4 × 4, and so on: as smaller
 * copies are made, too.
 *
 * @param texels `side` × `side`, a power of two.
 */
export function filled(texels: Uint8Array, side: number): void {
  const half = side / 2;
  if (half < 1) return;
  const coarse = new Uint8Array(TEXEL * half * half);
  for (let y = 0; y < half; y++)
    for (let x = 0; x < half; x++) mean(texels, TEXEL * 2 * (2 * y * half + x), TEXEL * side, coarse, TEXEL * (y * half + x));
  filled(coarse, half);
  for (let y = 0; y < side; y++) {
    for (let x = 0; x < side; x++) {
      const to = TEXEL * (y * side + x);
      if (texels[to + TEXEL - 1]! > 0) continue;
      const from = TEXEL * ((y >> 1) * half + (x >> 1));
      for (let byte = 0; byte < TEXEL; byte++) texels[to + byte] = coarse[from + byte]!;
    }
  }
}

/** Of those of four texels that were drawn. */
function mean(texels: Uint8Array, at: number, row: number, to: Uint8Array, place: number): void {
  let count = 0;
  const last = TEXEL - 1;
  for (const from of [at, at + TEXEL, at + row, at + row + TEXEL]) if (texels[from + last]! > 0) count += 1;
  if (count === 0) return;
  for (let byte = 0; byte < last; byte++) {
    let sum = 0;
    for (const from of [at, at + TEXEL, at + row, at + row + TEXEL]) if (texels[from + last]! > 0) sum += texels[from + byte]!;
    to[place + byte] = Math.round(sum / count);
  }
  to[place + last] = 255;
}
