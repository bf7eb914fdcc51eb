/** Language and theme: this browser's, in no link. */

import { LANGUAGES, pickLanguage } from './strings.ts';
import { THEMES } from '../base/view.ts';
import type { Preferences } from './store.ts';

const KEY = 'rock-field';

export function loadPreferences(): Preferences {
  let saved: Partial<Record<keyof Preferences, unknown>> = {};
  try {
    saved = (JSON.parse(localStorage.getItem(KEY) ?? '{}') ?? {}) as typeof saved;
  } catch {
    // Storage may be off, or hold what another page put there.
  }
  return {
    language: LANGUAGES.find((language) => language === saved.language) ?? pickLanguage(navigator.languages),
    theme: THEMES.find((theme) => theme === saved.theme) ?? 'auto',
  };
}

export function savePreferences(preferences: Preferences): void {
  // What the browser says itself is not saved: it may say something else tomorrow.
  const isLanguageChosen = preferences.language !== pickLanguage(navigator.languages);
  const chosen = {
    ...(isLanguageChosen && { language: preferences.language }),
    ...(preferences.theme !== 'auto' && { theme: preferences.theme }),
  };
  try {
    if (Object.keys(chosen).length > 0) localStorage.setItem(KEY, JSON.stringify(chosen));
    else localStorage.removeItem(KEY);
  } catch {
    // Then for this visit only.
  }
}
