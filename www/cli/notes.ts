/** What the exporter says of many files, each note once. */

import type { ExportNote } from '../export/file.ts';
import { inOptions } from './options.ts';

export class Notes {
  /** By their code: what is said first of it, and of how many files. */
  readonly #said = new Map<string, { message: string; count: number }>();

  add(notes: readonly ExportNote[]): void {
    for (const { code, message } of notes)
      this.#said.set(code, { message, ...this.#said.get(code), count: (this.#said.get(code)?.count ?? 0) + 1 });
  }

  /** In words for people, of so many files. */
  lines(total: number): string[] {
    return [...this.#said.values()].map(({ message, count }) => {
      const of = total > 1 ? ` (in ${count === total ? 'all' : `${count} of ${total}`} files)` : '';
      return `note: ${inOptions({ message })}${of}`;
    });
  }
}
