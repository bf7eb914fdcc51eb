/** What the rocks' presets are called. */

import type { Language } from '../base/language.ts';
import { labelOf, translate } from '../controls/strings.ts';
import type { PRESETS } from './params.ts';
import type { Preset } from './spec.ts';

/** The papers whose figures are presets, as the presets' names begin. */
export const PAPERS = ['journal', 'conference'] as const;
export type Paper = (typeof PAPERS)[number];

type NaturalName = Extract<(typeof PRESETS)[number], { natural: true }>['name'];

const NATURAL_NAMES: Record<NaturalName, string> = {
  riverbed: 'Riverbed',
  'beach-cobbles': 'Beach cobbles',
  scree: 'Scree',
  moraine: 'Moraine',
  'desert-pavement': 'Desert pavement',
  'lava-field': 'Lava field',
  'dry-garden': 'Dry garden',
  'forest-floor': 'Forest floor',
  'quarry-rubble': 'Quarry rubble',
  shingle: 'Shingle',
};

/** `Riverbed`; of a figure `Journal (2011), Fig. 11 (a)`. */
export function presetName(language: Language, { name }: Pick<Preset, 'name'>): string {
  const natural = NATURAL_NAMES[name as NaturalName] as string | undefined;
  if (natural) return labelOf(language, natural);
  return `${translate(language, paperOf(name))}${language === 'ja' ? '、' : ', '}${figureOf(name)}`;
}

/** The paper of a preset that is a figure. */
export function paperOf(name: string): Paper {
  return PAPERS.find((paper) => name.startsWith(paper)) ?? PAPERS[0];
}

/** `journal-fig11a` → `Fig. 11 (a)`. */
export function figureOf(name: string): string {
  const [, number = '', part = ''] = /fig(\d+)([a-z]?)$/.exec(name) ?? [];
  return `Fig. ${number}${part && ` (${part})`}`;
}
