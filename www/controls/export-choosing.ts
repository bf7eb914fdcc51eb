/** What the controls of the export dialog are given. */

import type { ExportTarget, ResolvedOptions } from '../export/options.ts';
import type { Slots } from '../base/filled.ts';
import type { LaterKey } from './strings-later.ts';

export interface Choosing {
  words: (key: LaterKey, slots?: Slots) => string;
  /** What is chosen now. */
  options: ResolvedOptions;
  target: ExportTarget;
  choose: (change: Partial<ResolvedOptions>) => void;
}
