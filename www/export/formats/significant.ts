/** Rounding to significant digits as `toPrecision` does it, in a tenth of its time. */

/** Powers of ten that a 64-bit float holds exactly. */
export const POWERS = /* @__PURE__ */ Array.from({ length: 23 }, (_, k) => Number(`1e${k}`));
/** Numbers so near to the middle between two roundings are left to `toPrecision`, since multiplying has rounded them. */
const NEAR = 1e-5;

/**
 * How many decimals a number has that is rounded to so many significant digits.
 *
 * @param size not negative.
 * @param digits at most 9.
 * @returns −1 where only `toPrecision` can tell: of 0, numbers with more digits before the point, very small ones, and those between two roundings.
 */
export function decimalsFor(size: number, digits: number): number {
  const [least, most] = [POWERS[digits - 1]!, POWERS[digits]!];
  if (!(size < most && size * POWERS[22 - digits]! >= 1)) return -1;
  let decimals = digits - 1;
  while (size * POWERS[decimals]! >= most) decimals -= 1;
  while (size * POWERS[decimals]! < least) decimals += 1;
  const scaled = size * POWERS[decimals]!;
  return Math.abs(scaled - Math.floor(scaled) - 0.5) < NEAR ? -1 : decimals;
}

/** The same as `Number(value.toPrecision(digits))`. */
export function rounded(value: number, digits: number): number {
  const size = Math.abs(value);
  const decimals = decimalsFor(size, digits);
  if (decimals < 0) return Number(value.toPrecision(digits));
  const unit = POWERS[decimals]!;
  const near = Math.floor(size * unit + 0.5) / unit;
  return value < 0 ? -near : near;
}
