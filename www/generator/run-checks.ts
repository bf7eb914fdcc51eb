/** What callers of a generator without a worker may do wrong. */

import { checkNumber, objectOf, wrongType } from '../table/param-checks.ts';
import { defaultMaxBytes } from './budget.ts';
import type { RunOptions } from './session.ts';

export interface HeadlessOptions<Result, Stage extends string> extends RunOptions<Result, Stage> {
  maxBytes?: number | undefined;
}

/**
 * The options of a run, with the default of `maxBytes`.
 *
 * @param name what an error calls them.
 * @throws {RockFieldError} `WrongType` or `OutOfRange`, before anything runs.
 */
export function checkRun<Run extends object>(options: Run, name: string): Run & { maxBytes: number } {
  const given = objectOf(options, name);
  const { signal, maxBytes = defaultMaxBytes() } = given;
  if (signal !== undefined && typeof (signal as AbortSignal | null)?.throwIfAborted !== 'function')
    throw wrongType('signal', signal, 'an AbortSignal');
  for (const key of ['onProgress', 'onPreview'] as const) {
    if (given[key] !== undefined && typeof given[key] !== 'function') throw wrongType(key, given[key], 'a function');
  }
  checkNumber('maxBytes', maxBytes, { min: 0, max: Infinity }, false);
  return { ...options, maxBytes: maxBytes as number };
}
