/** What is refused since no file could hold it, and what would fit. */

import { RockFieldError } from '../base/errors.ts';
import { estimateOf } from './estimate.ts';
import type { Planned } from './estimate.ts';
import type { Model } from './model.ts';
import { FORMS, OPTIONS } from './options.ts';
import type { ResolvedOptions } from './options.ts';
import { cellsOf } from './parts.ts';

/** A file may be no larger: longer offsets do not fit into GLB, nor such a file into many programs. */
export const MOST_BYTES = 2 ** 31 - 1;
/** A ZIP of parts may be as large as one without 64-bit offsets can be, but for its list of files. */
export const MOST_ZIP = 2 ** 32 - 2 ** 16;
/** How much smaller a part has to be than the largest file before it is offered: parts are estimated by their vertices. */
const SAFE = 0.9;

/** @throws {RockFieldError} `ExportTooLarge`, which says what would fit. */
export function checkFits(planned: Planned): void {
  const { model, options } = planned;
  const { bytes } = estimateOf(planned);
  const largest = options.parts > 1 ? bytes * largestShare(model, options.parts) : bytes;
  if (largest <= MOST_BYTES && bytes <= MOST_ZIP) return;
  const [value, max] = largest > MOST_BYTES ? [largest, MOST_BYTES] : [bytes, MOST_ZIP];
  const [needed, most] = [value, max].map((length) => Math.round(length / 1e6));
  throw new RockFieldError({
    name: 'ExportTooLarge',
    key: 'format',
    value,
    max,
    message: `the file would be about ${needed} MB; it may be at most ${most} MB: choose ${remedyOf(model, options, bytes)}`,
  });
}

function remedyOf(model: Model, options: ResolvedOptions, bytes: number): string {
  const { format, mesh } = options;
  const remedies: string[] = [];
  // What has several parts has a shape of its own.
  const canBeKit = mesh !== 'kit' && mesh !== 'points' && model.groups.every(({ parts = 1 }) => parts === 1);
  if (canBeKit) remedies.push(FORMS[format]?.includes('kit') ? 'mesh "kit"' : 'mesh "kit" with format "glb"');
  const parts = mesh !== 'kit' && mesh !== 'points' ? fittingParts(model, bytes) : undefined;
  if (parts !== undefined) remedies.push(`parts ${parts}`);
  return [...remedies, 'a smaller image or less detail'].join(', or ');
}

/** The least number of parts of which each fits; undefined where they would not fit together. */
function fittingParts(model: Model, bytes: number): number | undefined {
  if (bytes > SAFE * MOST_ZIP) return undefined;
  for (let parts = Math.max(2, Math.ceil(bytes / MOST_BYTES)); parts <= OPTIONS.parts.max; parts++) {
    if (bytes * largestShare(model, parts) < SAFE * MOST_BYTES) return parts;
  }
  return undefined;
}

/** The share of the vertices that the part with the most has. */
function largestShare(model: Model, parts: number): number {
  const { vertexStarts, groupOf } = model;
  const all = vertexStarts[groupOf.length]!;
  const shares = cellsOf(model, parts).map(
    ({ bodies }) => bodies.reduce((sum, k) => sum + vertexStarts[k + 1]! - vertexStarts[k]!, 0) / all,
  );
  return all > 0 ? Math.max(...shares) : 0;
}
