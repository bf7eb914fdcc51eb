/** Makes the page work offline after its first visit, and through the deployment of a newer build. */

import { ownBuild } from './newer-version.ts';
import type { KeepMessage } from './service-worker.ts';

export { offerNewerVersion, sayUncaught } from './newer-version.ts';

/**
 * Registers the service worker and hands it the files this page has fetched so far: on a first visit it was not there to see them.
 * Call it once the first picture stands. Without service workers (plain http, private windows) nothing happens.
 */
export async function keepOffline(): Promise<void> {
  try {
    await navigator.serviceWorker?.register(new URL('./sw.js', document.baseURI));
    const registration = await navigator.serviceWorker?.ready;
    if (!registration) return;
    const urls = [location.href, ...performance.getEntriesByType('resource').map((entry) => entry.name)];
    const message: KeepMessage = { type: 'keep', build: ownBuild(), urls };
    // After a deployment the files are those of the worker that is being installed.
    for (const worker of [registration.installing, registration.waiting, registration.active]) worker?.postMessage(message);
    registration.addEventListener('updatefound', () => registration.installing?.postMessage(message));
  } catch (error) {
    console.info('rock-field: not available offline:', error);
  }
}
