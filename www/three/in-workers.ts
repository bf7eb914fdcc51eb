/** Fields for scenes, generated in the workers of an element, so that the page stays free. */

import { EXPORTER } from '../rocks/export-task.ts';
import { GeneratorClient } from '../rocks/client.ts';
import { inWorker } from '../generator/one-task.ts';
import { GENERATED } from '../export/pace.ts';
import type { SceneParts } from '../export/scene.ts';
import type { Grower } from './rock-field.ts';

/** How long the stages of a run are kept for the next one, ms: sliders are moved again and again, but most fields are built once and stay. */
export const KEPT_MS = 10_000;

type Client = Pick<GeneratorClient, 'generate' | 'dispose'>;

/** Keeps the stages of its last run for a while, so that the next one begins with the first stage that changed. */
export function workers(newClient: () => Client = () => new GeneratorClient()): Grower {
  let client: Client | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let running = 0;
  const leave = (): void => {
    clearTimeout(timer);
    client?.dispose();
    client = undefined;
  };
  return {
    async grow({ source, options }, { signal, onProgress, maxBytes }) {
      clearTimeout(timer);
      running += 1;
      client ??= newClient();
      try {
        const field = await client.generate(source.params, {
          signal,
          maxBytes,
          onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GENERATED * progress.fraction })),
        });
        const run = {
          signal,
          onProgress:
            onProgress && ((fraction: number) => onProgress({ stage: 'scene', fraction: GENERATED + (1 - GENERATED) * fraction })),
        };
        return (await inWorker(EXPORTER, { field, source, options, step: 'scene' }, run)) as SceneParts;
      } finally {
        running -= 1;
        if (running === 0 && client) timer = setTimeout(leave, KEPT_MS);
      }
    },
    dispose: leave,
  };
}
