/** What the wood ears' scene says of itself. */

import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import { filled } from '../base/filled.ts';
import type { Language } from '../base/language.ts';

const WORDS = {
  label: { en: 'Wood ears on a fallen log', ja: '倒木のキクラゲ' },
  base: {
    en: 'Base {n} of {count}: drag along the log, arrow keys move it, Delete removes it',
    ja: '基点 {n} / {count}：丸太に沿ってドラッグ、矢印キーで移動、Delete で削除',
  },
  turned: { en: 'The log was inside out; it has been turned.', ja: '丸太の面が裏返しだったため、表に返しました。' },
  scaled: { en: 'The log was made in other units; it is shown 200 cm long.', ja: '丸太の単位が異なるため、長さ200cmで表示しています。' },
  slow: {
    en: 'The thesis’s collisions take about {time} more; “Pressed” takes a fraction of that and leaves no pair crossing.',
    ja: '論文の衝突処理には、あと約{time}かかります。「押し合い」ならはるかに短く、交差も残りません。',
  },
  scene: { en: '{ears} in {colonies} on a fallen log {length} long', ja: '長さ{length}の倒木に{colonies}、{ears}' },
  ears: { en: '{n} wood ears', ja: 'キクラゲ{n}個' },
  oneEar: { en: 'one wood ear', ja: 'キクラゲ1個' },
  colonies: { en: '{n} colonies', ja: '{n}つの群生' },
  oneColony: { en: 'one colony', ja: '1つの群生' },
} as const;

export function sceneLabel(language: Language): string {
  return WORDS.label[language];
}

export function sayOfLog(language: Language, what: 'turned' | 'scaled'): string {
  return WORDS[what][language];
}

export function saySlow(language: Language, time: string): string {
  return filled(WORDS.slow[language], { time });
}

export function sayBase(language: Language, n: number, count: number): string {
  return filled(WORDS.base[language], { n, count });
}

/** "497 wood ears in one colony on a fallen log 2.1 m long". */
export function describeColony(
  { stats: { individuals }, bases, log }: WoodEarColony,
  metresPerCentimetre: number,
  language: Language,
): string {
  const n = new Intl.NumberFormat(language).format(individuals);
  const count = bases.length / 3;
  const length = new Intl.NumberFormat(language, { style: 'unit', unit: 'meter', maximumSignificantDigits: 2 }).format(
    lengthOf(log) * metresPerCentimetre,
  );
  return filled(WORDS.scene[language], {
    ears: filled(WORDS[individuals === 1 ? 'oneEar' : 'ears'][language], { n }),
    colonies: filled(WORDS[count === 1 ? 'oneColony' : 'colonies'][language], { n: count }),
    length,
  });
}

function lengthOf({ positions }: WoodEarLog): number {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    low = Math.min(low, positions[i]!);
    high = Math.max(high, positions[i]!);
  }
  return high - low;
}
