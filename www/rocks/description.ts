/** What a field shows, in a sentence: for those who cannot see it. */

import type { Field, FieldLayer } from '../data/field.ts';
import type { Language } from '../base/language.ts';

const COUNTS = ['no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight'];

/** "3,100 rocks in three sizes, largest 1.2 m, 84 % covered". */
export function describeField(field: Field, metresPerPixel: number, language: Language): string {
  const { stats, layers } = field;
  const rocks = new Intl.NumberFormat(language).format(stats.rocks);
  const covered = new Intl.NumberFormat(language, { style: 'percent' }).format(stats.coveredFraction);
  const sizes = layers.filter(({ selected }) => selected.length > 0).length;
  const largest = length(largestRock(layers) * metresPerPixel, language);
  if (language === 'ja') return stats.rocks === 0 ? '岩なし' : `${sizes}種類の大きさの岩${rocks}個、最大${largest}、被覆率${covered}`;
  if (stats.rocks === 0) return 'No rocks';
  const kinds = sizes === 1 ? 'one size' : `${COUNTS[sizes] ?? sizes} sizes`;
  return `${rocks} ${stats.rocks === 1 ? 'rock' : 'rocks'} in ${kinds}, largest ${largest}, ${covered} covered`;
}

/** A rock's size is the diameter of the circle that has its cell's area, px. */
function largestRock(layers: readonly FieldLayer[]): number {
  let most = 0;
  for (const { cellStarts, cellVertices, selected } of layers) {
    for (const site of selected) {
      let doubled = 0;
      const [from, to] = [cellStarts[site] ?? 0, cellStarts[site + 1] ?? 0];
      for (let k = from, before = to - 1; k < to; before = k, k += 1) {
        doubled +=
          (cellVertices[2 * before] ?? 0) * (cellVertices[2 * k + 1] ?? 0) -
          (cellVertices[2 * k] ?? 0) * (cellVertices[2 * before + 1] ?? 0);
      }
      most = Math.max(most, doubled / 2);
    }
  }
  return Math.sqrt((4 * most) / Math.PI);
}

/** Two digits are as many as the eye has. */
function length(metres: number, language: Language): string {
  const unit = metres >= 1000 ? 'kilometer' : metres >= 1 ? 'meter' : metres >= 0.01 ? 'centimeter' : 'millimeter';
  const scale = { kilometer: 0.001, meter: 1, centimeter: 100, millimeter: 1000 }[unit];
  return new Intl.NumberFormat(language, { style: 'unit', unit, maximumSignificantDigits: 2 }).format(metres * scale);
}
