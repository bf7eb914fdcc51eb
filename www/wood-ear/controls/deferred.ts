/** The part of the wood ears' controls that the first picture does not need. */

import { deferred } from '../../base/deferred.ts';

export const WOOD_EAR_LATER = deferred(() => import('./later.ts'));
