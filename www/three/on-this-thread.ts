/** Fields for scenes where there are no workers of the page's kind, in slices of about 16 ms. */

import type { Field } from '../data/field.ts';
import { GENERATED } from '../export/pace.ts';
import { fieldScene } from '../rocks/export.ts';
import type { GroundRealm } from '../rocks/ground.ts';
import type { GenerateOptions } from '../rocks/headless.ts';
import type { FieldRequest } from '../rocks/request.ts';
import type { Grower } from './rock-field.ts';

/** @param generate as of `rock-field/core`. */
export function onThisThread(generate: (request?: FieldRequest, options?: GenerateOptions) => Promise<Field>, ground: GroundRealm): Grower {
  return {
    async grow({ source, options }, { signal, onProgress, maxBytes }) {
      const field = await generate(source.params, {
        signal,
        maxBytes,
        onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GENERATED * progress.fraction })),
      });
      signal?.throwIfAborted();
      return fieldScene(field, source, options, ground, {
        signal,
        onProgress: onProgress && ((fraction) => onProgress({ stage: 'scene', fraction: GENERATED + (1 - GENERATED) * fraction })),
      });
    },
    dispose: () => {},
  };
}
