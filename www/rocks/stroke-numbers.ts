/** Painted strokes, from text to the numbers that the generator takes. */

/** Parts of the image's width. */
export const UNITS = 4096;
export const DIGITS = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-~';

/** The numbers of each stroke: mode, layer + 1 or 0, width, and its points, in units. */
export function numbersOf(text: string): number[][] {
  if (text === '') return [];
  return text.split('.').map((part) => {
    const numbers: number[] = [];
    let number = 0;
    let place = 1;
    for (const character of part) {
      const digit = DIGITS.indexOf(character);
      number += (digit % 32) * place;
      place *= 32;
      if (digit > 31) continue;
      numbers.push(number);
      number = 0;
      place = 1;
    }
    const [mode = 0, layer = 0, width = 0, ...rest] = numbers;
    const points: number[] = [];
    for (const [k, value] of rest.entries()) {
      const step = ((value % 2 ? -1 : 1) * (value - (value % 2))) / 2;
      const before = k < 2 ? 0 : points[k - 2]!;
      points.push(before + step + (k < 4 ? 0 : before - points[k - 4]!) + 0);
    }
    return [mode, layer, width, ...points];
  });
}

/** What the generator takes: for each stroke mode, layer + 1 or 0, half its width, its number of points, and these. */
export function strokeNumbers(text: string): Float64Array {
  return Float64Array.from(
    numbersOf(text).flatMap(([mode = 0, layer = 0, width = 0, ...points]) => [mode, layer, width / 2, points.length / 2, ...points]),
  );
}
