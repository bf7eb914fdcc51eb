/** How a log file is refused: by name, in both languages, with the numbers as data. */

import { RockFieldError } from '../../base/errors.ts';
import type { ErrorInfo, ErrorName } from '../../base/errors.ts';
import type { Words } from '../../base/language.ts';

/** @param words Whole sentences that begin with the file's name. */
export function refused(name: ErrorName, words: Words, data: Pick<ErrorInfo, 'value' | 'min' | 'max'> = {}): RockFieldError {
  return new RockFieldError({ name, key: 'log', message: words.en, words, ...data });
}

/** As `2.5 MB`, rounded up: a file over a limit is never shown at the limit. */
export function megabytes(bytes: number): string {
  return `${Math.ceil((10 * bytes) / 2 ** 20) / 10} MB`;
}
