/** What the rocks' presets are called. */

import type { Language } from '../base/language.ts';
import { labelOf, translate } from '../controls/strings.ts';
import { figureOf, PAPERS, paperOf } from './figures.ts';
import type { Preset } from './spec.ts';

/** Of a natural ground what its key says, `Beach cobbles`; of a figure `Journal (2011), Fig. 11 (a)`. */
export function presetName(language: Language, { name }: Pick<Preset, 'name'>): string {
  if (PAPERS.some((paper) => name.startsWith(paper)))
    return `${translate(language, paperOf(name))}${language === 'ja' ? '、' : ', '}${figureOf(name)}`;
  return labelOf(language, name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' '));
}
