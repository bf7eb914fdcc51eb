/**
 * Keeps the page working offline after the first visit, and never in the way of a new deploy.
 *
 * A page asks the network for index.html first; the build id in it says whether this worker's files are that page's files.
 * Only then are they given from the cache. A page of another build, and anyone unknown (a web worker has a client id of its
 * own), gets what the network has; the cache is for when there is none. Every file taken in is checked against its hash,
 * so a cache holds the files of one build and nothing else.
 */

/** Written in by scripts/web.mjs: the build's id, each file's `sha256-…`, and by page the files that every visitor of it needs. */
declare const __BUILD__: string;
declare const __FILES__: Record<string, string>;
declare const __PAGES__: Record<string, string[]>;

/** From the page: files it fetched before this worker was there to see it, such as its renderer. */
export interface KeepMessage {
  type: 'keep';
  urls: string[];
}

const worker = self as unknown as ServiceWorkerGlobalScope;
const PREFIX = 'rock-field-';
const CACHE = PREFIX + __BUILD__;
const PAGE = 'index.html';

/** Pages known to be of this build. Forgotten when the browser stops the worker; then the network is asked. */
const ours = new Set<string>();

worker.addEventListener('install', (event) => {
  event.waitUntil(Promise.all([PAGE, ...(__PAGES__[PAGE] ?? [])].map(take)));
});

worker.addEventListener('activate', (event) => {
  event.waitUntil(dropOldCaches().then(() => worker.clients.claim()));
});

worker.addEventListener('message', (event) => {
  const message = event.data as KeepMessage | undefined;
  if (message?.type !== 'keep' || !Array.isArray(message.urls)) return;
  const names = message.urls.map((url) => nameOf(String(url))).filter((name) => name !== undefined);
  // Of another page than the first one, all that a visit needs.
  const visited = names.flatMap((name) => (name === PAGE ? [] : (__PAGES__[name] ?? [])));
  event.waitUntil(Promise.allSettled([...new Set([...names, ...visited])].map(fromCacheOrTake)));
});

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  const name = nameOf(request.url);
  if (request.method !== 'GET' || name === undefined) return;
  // The documentation's pages have no build id: they are the network's, and without one what was read before.
  if (request.mode === 'navigate' && name in __PAGES__) event.respondWith(navigate(request, name, event.resultingClientId));
  else if (ours.has(event.clientId)) event.respondWith(fromCacheOrTake(name).catch(() => fetch(request)));
  else event.respondWith(networkFirst(request, name));
});

/** The network's page, or ours when there is no network. */
async function navigate(request: Request, name: string, client: string): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(request);
  } catch (error) {
    const kept = await cached(name);
    if (!kept) throw error;
    ours.add(client);
    return kept;
  }
  if (response.ok && isOfThisBuild(await response.clone().text())) ours.add(client);
  else void worker.registration.update().catch(() => undefined);
  return response;
}

async function networkFirst(request: Request, name: string): Promise<Response> {
  try {
    return await fetch(request);
  } catch (error) {
    const kept = await cached(name);
    if (!kept) throw error;
    return kept;
  }
}

async function fromCacheOrTake(name: string): Promise<Response> {
  return (await cached(name)) ?? take(name);
}

/** Fetches a file of this build, past the HTTP cache, and keeps it; fails when the network has another one. */
async function take(name: string): Promise<Response> {
  const integrity = __FILES__[name];
  const response = await fetch(urlOf(name), { cache: 'no-cache', ...(integrity ? { integrity } : {}) });
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  // Hosts may add to a page, so it is known by its build id instead of its hash.
  if (name in __PAGES__ && !isOfThisBuild(await response.clone().text())) throw new Error(`${name} is of another build`);
  await (await caches.open(CACHE)).put(urlOf(name), response.clone());
  return response;
}

async function cached(name: string): Promise<Response | undefined> {
  return (await caches.open(CACHE)).match(urlOf(name));
}

async function dropOldCaches(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name.startsWith(PREFIX) && name !== CACHE).map((name) => caches.delete(name)));
}

function isOfThisBuild(page: string): boolean {
  return page.includes(`"rock-field-build" content="${__BUILD__}"`);
}

/** The file of this build that a URL means, of a folder its page; `undefined` for anything else. */
function nameOf(url: string): string | undefined {
  const { scope } = worker.registration;
  const bare = url.replace(/[?#].*$/s, '');
  if (!bare.startsWith(scope)) return undefined;
  const name = bare.slice(scope.length).replace(/(^|\/)$/, `$1${PAGE}`);
  return name in __PAGES__ || name in __FILES__ ? name : undefined;
}

function urlOf(name: string): string {
  // The directory itself: some hosts redirect index.html to it, and a redirected answer cannot be given to a page.
  return worker.registration.scope + name.replace(/(^|\/)index\.html$/, '$1');
}
