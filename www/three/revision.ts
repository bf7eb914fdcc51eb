/** Which revisions of three.js fit. */

import * as three from 'three';
import { RockFieldError } from '../base/errors.ts';

/** The first whose `BatchedMesh` can give an instance another shape. Its peer range in package.json says the same. */
export const FIRST_REVISION = 169;

/** @throws {RockFieldError} `ThreeUnsuitable`. */
export function checkRevision(revision: unknown = three.REVISION): void {
  const number = Number.parseInt(String(revision), 10);
  if (number >= FIRST_REVISION && typeof three.BatchedMesh === 'function') return;
  throw new RockFieldError({
    name: 'ThreeUnsuitable',
    key: 'three',
    value: revision,
    min: FIRST_REVISION,
    message: `three.js is r${revision}; rock-field/three needs r${FIRST_REVISION} or newer`,
  });
}
