/** Names and pieces of files in sentences. */

/** Characters that a message shows. */
const MOST_SHOWN = 60;

/** A piece of a file, short enough for a message and without characters that would break or reorder the line. The end is kept: it tells the kind of a file. */
export function shown(text: string): string {
  const plain = text.slice(0, 2 * MOST_SHOWN) + (text.length > 4 * MOST_SHOWN ? text.slice(-2 * MOST_SHOWN) : text.slice(2 * MOST_SHOWN));
  const line = plain.replace(/[\p{C}\p{Zl}\p{Zp}]+/gu, ' ').trim();
  return text.length <= MOST_SHOWN ? line : `${line.slice(0, MOST_SHOWN - 16)}…${line.slice(-15)}`;
}
