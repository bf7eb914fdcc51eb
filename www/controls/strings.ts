/**
 * The sentences of the page and the panel: `strings.en.ts` has them in English, `strings.ja.ts` in Japanese. What a parameter is called and does stands in its table
 * (`params.gen.ts`), what may be wrong with a link in `table/notices.ts`.
 */

import { filled } from '../base/filled.ts';
import { lazily } from '../base/lazy.ts';
import { STRINGS } from './strings.en.ts';
import type { StringKey } from './strings.en.ts';
import type { Slots } from '../base/filled.ts';
import type { Language, Words } from '../base/language.ts';
import type * as Japanese from './strings.ja.ts';

export const LANGUAGES = ['en', 'ja'] as const satisfies readonly Language[];

/** Each language in itself. */
export const LANGUAGE_NAMES: Words = { en: 'English', ja: '日本語' };

export function translate(language: Language, key: StringKey, slots: Slots = {}): string {
  return filled((language === 'ja' && japanese?.STRINGS_JA[key]) || STRINGS[key], slots);
}

/** The label of a parameter or of a choice, which the tables have in English; also the name of a natural preset. */
export function labelOf(language: Language, label: string): string {
  return (language === 'ja' && japanese?.LABELS_JA[label]) || label;
}

let japanese: typeof Japanese | undefined;

/** Few read Japanese, so its sentences are fetched; until they are there, and where they cannot be had, they are English. */
export async function loadJapanese(): Promise<void> {
  try {
    japanese ??= await lazily(() => import('./strings.ja.ts'));
  } catch (thrown) {
    console.warn(thrown);
  }
}

/** The page's title in Japanese; undefined where it is the document's own. */
export function pageTitle(language: Language, element: string): string | undefined {
  return language === 'ja' ? japanese?.TITLES_JA[element] : undefined;
}

/** English or Japanese, whichever the list of preferred languages names first; English for all others. */
export function pickLanguage(preferred: readonly string[]): Language {
  const found = preferred.map((tag) => LANGUAGES.find((language) => tag.toLowerCase().split('-')[0] === language)).find(Boolean);
  return found ?? 'en';
}
