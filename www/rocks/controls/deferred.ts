/** The part of the rocks' controls that the first picture does not need. */

import { deferred } from '../../base/deferred.ts';
import type * as module from './later.ts';

export type RockLater = typeof module;

export const ROCK_LATER = deferred<RockLater>(() => import('./later.ts'));
