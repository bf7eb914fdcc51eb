/** Makes the page work offline after its first visit. */

import type { KeepMessage } from './service-worker.ts';

/**
 * Registers the service worker and hands it the files this page has fetched so far: on a first visit it was not there to see them.
 * Call it once the first picture stands. Without service workers (plain http, private windows) nothing happens.
 */
export async function keepOffline(): Promise<void> {
  try {
    await navigator.serviceWorker?.register(new URL('./sw.js', document.baseURI));
    const registration = await navigator.serviceWorker?.ready;
    const urls = [location.href, ...performance.getEntriesByType('resource').map((entry) => entry.name)];
    registration?.active?.postMessage({ type: 'keep', urls } satisfies KeepMessage);
  } catch (error) {
    console.info('rock-field: not available offline:', error);
  }
}
