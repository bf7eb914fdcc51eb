/** What a command is. */

import type { Exit } from './failures.ts';
import type { Surroundings } from './make.ts';
import type { Option } from './options.ts';
import type { Arguments } from './parse.ts';

export interface Group {
  title: string;
  options: readonly Option[];
}

export interface Example {
  /** What it is for, without a full stop. */
  what: string;
  line: string;
}

export interface Command {
  /** What follows `rock-field`. */
  usage: string;
  /** What it does, in a few sentences. */
  about: string;
  groups: readonly Group[];
  /** Options that are accepted, and listed elsewhere. */
  others?: readonly Option[];
  /** What is said after the lists. */
  footer?: string;
  examples: readonly Example[];
  /** @throws {Ending} */
  run(args: Arguments, surroundings: Surroundings): Promise<Exit>;
}
