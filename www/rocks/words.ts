/** What the rocks' presets are called. */

import type { Language } from '../base/language.ts';
import { labelOf, translate } from '../controls/strings.ts';
import type { Preset } from './spec.ts';

/** The papers whose figures are presets, as the presets' names begin. */
export const PAPERS = ['journal', 'conference'] as const;
export type Paper = (typeof PAPERS)[number];

/** Of a natural ground what its key says, `Beach cobbles`; of a figure `Journal (2011), Fig. 11 (a)`. */
export function presetName(language: Language, { name }: Pick<Preset, 'name'>): string {
  if (PAPERS.some((paper) => name.startsWith(paper)))
    return `${translate(language, paperOf(name))}${language === 'ja' ? '、' : ', '}${figureOf(name)}`;
  return labelOf(language, name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' '));
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
