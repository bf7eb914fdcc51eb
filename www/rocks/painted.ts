/** Requests with what is painted: a mask, and strokes as objects. */

import { objectOf } from '../table/param-checks.ts';
import type { Mask } from './mask.ts';
import type { Params } from './params.ts';
import { resolveParams } from './request.ts';
import type { FieldRequest } from './request.ts';
import { strokesToText } from './strokes.ts';

/** What code may ask for, with a picture that says how dense the rocks stand where: at full brightness as the layers ask. No link has it. */
export type PaintedRequest = FieldRequest & { mask?: Mask | undefined };

/** @throws {RockFieldError} naming key, value and bounds; the mask has still to be checked. */
export function resolvePainted(request: PaintedRequest = {}): { params: Params; mask: Mask | undefined } {
  const { mask, strokes, ...asked } = objectOf(request, 'params') as PaintedRequest;
  return { params: resolveParams({ ...asked, strokes: strokesToText(strokes) }), mask };
}
