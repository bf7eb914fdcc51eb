/** The languages in which everything is said. */
export type Language = 'en' | 'ja';

/** A text in each of them. */
export type Words = Record<Language, string>;
