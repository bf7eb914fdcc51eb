/** Colours in linear light, as files have them. */

/** Of bytes of sRGB (IEC 61966-2-1). */
export function linearColor(bytes: readonly [number, number, number]): [number, number, number] {
  return [linear(bytes[0]), linear(bytes[1]), linear(bytes[2])];
}

function linear(byte: number): number {
  const c = byte / 255;
  // Rounded, since engines differ in the last digits of a power.
  const exact = c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  return Math.round(exact * 1e4) / 1e4;
}
