/** What is refused since no file could hold it, and what would fit. */

import { RockFieldError } from '../base/errors.ts';
import { estimateOf } from './estimate.ts';
import type { Planned } from './estimate.ts';
import type { Model } from './model.ts';
import { FORMS, OPTIONS } from './options.ts';
import type { ResolvedOptions } from './options.ts';
import { cellsOf, MOST_BYTES, MOST_ZIP, SAFE } from './parts.ts';

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
    // Beside these the page has buttons for what else helps.
    words: {
      en: `The file would be about ${needed} MB; it may be at most ${most} MB. A smaller scene or less detail fits.`,
      ja: `ファイルは約 ${needed} MB になり、上限の ${most} MB を超えます。シーンを小さくするか、細かさを下げてください。`,
    },
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
