/** How a log file is refused: by name, in both languages, with the numbers as data. */

import { RockFieldError } from '../../base/errors.ts';
import type { ErrorInfo, ErrorName } from '../../base/errors.ts';
import type { Words } from '../../base/language.ts';

/** Characters of a file's name, or of a piece of it, that a message shows. */
const MOST_SHOWN = 60;

/** @param words Whole sentences that begin with the file's name. */
export function refused(name: ErrorName, words: Words, data: Pick<ErrorInfo, 'value' | 'min' | 'max'> = {}): RockFieldError {
  return new RockFieldError({ name, key: 'log', message: words.en, words, ...data });
}

/** A piece of a file, short enough for a message and without characters that would break or reorder the line. The end is kept: it tells the kind of a file. */
export function shown(text: string): string {
  const plain = text.slice(0, 2 * MOST_SHOWN) + (text.length > 4 * MOST_SHOWN ? text.slice(-2 * MOST_SHOWN) : text.slice(2 * MOST_SHOWN));
  const line = plain.replace(/[\p{C}\p{Zl}\p{Zp}]+/gu, ' ').trim();
  return text.length <= MOST_SHOWN ? line : `${line.slice(0, MOST_SHOWN - 16)}…${line.slice(-15)}`;
}

/** As `2.5 MB`, rounded up: a file over a limit is never shown at the limit. */
export function megabytes(bytes: number): string {
  return `${Math.ceil((10 * bytes) / 2 ** 20) / 10} MB`;
}
