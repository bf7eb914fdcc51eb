/** Fields for scenes, generated in the workers of an element, so that the page stays free. */

import { EXPORTER } from '../rocks/export-task.ts';
import { GeneratorClient } from '../rocks/client.ts';
import { inWorker } from '../generator/one-task.ts';
import type { SceneParts } from '../export/scene.ts';
import type { Grower } from './rock-field.ts';

/** The share of the work that is done when the field is there. */
const GENERATED = 0.6;

/** Keeps the stages of its last run, so that the next one begins with the first stage that changed. */
export function workers(): Grower {
  const client = new GeneratorClient();
  return {
    async grow({ source, options }, { signal, onProgress, maxBytes }) {
      const field = await client.generate(source.params, {
        signal,
        maxBytes,
        onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GENERATED * progress.fraction })),
      });
      const run = {
        signal,
        onProgress: onProgress && ((fraction: number) => onProgress({ stage: 'scene', fraction: GENERATED + (1 - GENERATED) * fraction })),
      };
      return (await inWorker(EXPORTER, { field, source, options, step: 'scene' }, run)) as SceneParts;
    },
    dispose: () => client.dispose(),
  };
}
