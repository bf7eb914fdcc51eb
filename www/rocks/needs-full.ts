/** Which of the two artefacts of the generator a request needs. */

import type { FlatRequest } from '../generator/protocol.ts';

/** Whether only `generator-full` can do it: it is painted. */
export function needsFull({ strokes, mask }: FlatRequest): boolean {
  return Boolean(strokes || mask);
}
