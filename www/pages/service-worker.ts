/**
 * Keeps the page working offline after the first visit, and while a new build is put on the server.
 *
 * A page itself comes from the network while there is one, so a new build is seen at the next visit. Files with hashed names are the same
 * whoever has them: they come from a cache, of this build or of a former one that an open page may still need, and from the network
 * otherwise. Every file taken in is checked against its hash, so that a server's error page is never kept in a file's place.
 */

/** Written in by scripts/build/web.mjs: the build's id, each file's `sha256-…`, by page the files that every visitor of it needs, by worker the artefacts that it runs, and the pattern of hashed names. */
declare const __BUILD__: string;
declare const __FILES__: Record<string, string>;
declare const __PAGES__: Record<string, string[]>;
declare const __WORKERS__: Record<string, string[]>;
declare const __HASHED__: string;

/** From a page: the build it is of, where it knows, and what it fetched before this worker was there to see it, such as its renderer. */
export interface KeepMessage {
  type: 'keep';
  build?: string;
  urls: string[];
}

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
/** Another copy of the page on this origin has caches of its own. */
const PREFIX = `rock-field:${new URL(scope).pathname}:`;
const CACHE = PREFIX + __BUILD__;
/** By client, the build of each open page: the browser stops this worker whenever it is idle, and it has to know after that. */
const OPEN_PAGES = `${PREFIX}open-pages`;
/** What caches were called before they had the scope in their names. */
const UNSCOPED = /^rock-field-\w+$/;
const PAGE = 'index.html';
const HASHED = new RegExp(__HASHED__);
const BUILD_IN_PAGE = /"rock-field-build" content="(\w+)"/;

worker.addEventListener('install', (event) => {
  event.waitUntil(Promise.all([PAGE, ...(__PAGES__[PAGE] ?? [])].map(keep)));
});

worker.addEventListener('activate', (event) => {
  event.waitUntil(dropUnneeded().then(() => worker.clients.claim()));
});

worker.addEventListener('message', (event) => {
  const message = event.data as KeepMessage | undefined;
  if (message?.type !== 'keep' || !Array.isArray(message.urls)) return;
  const names = message.urls.map((url) => nameOf(String(url))).filter((name) => name !== undefined);
  // Of another page than the first one, all that a visit needs.
  const visited = names.flatMap((name) => (name === PAGE ? [] : (__PAGES__[name] ?? [])));
  // A page does not see what its workers fetched.
  const byWorkers = names.flatMap((name) => __WORKERS__[name] ?? []);
  const { source } = event;
  const remembered = message.build && source instanceof Client ? remember(source.id, String(message.build)) : undefined;
  event.waitUntil(Promise.allSettled([remembered, ...[...new Set([...names, ...visited, ...byWorkers])].map(keep)]).then(dropUnneeded));
});

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  const file = fileOf(request.url);
  if (request.method !== 'GET' || file === undefined) return;
  const name = nameOf(request.url);
  // The documentation's pages have no build id: they are the network's, and without one what was read before.
  if (request.mode === 'navigate' && name !== undefined && name in __PAGES__) event.respondWith(navigate(event, name));
  else if (HASHED.test(file)) event.respondWith(hashedFile(request, file));
  else if (name !== undefined) event.respondWith(networkFirst(request, name));
});

/** The network's page; ours when there is no network, or a server that is not ready. */
async function navigate(event: FetchEvent, name: string): Promise<Response> {
  let response: Response | undefined;
  try {
    response = await fetch(event.request);
  } catch (error) {
    if (!(await cached(name))) throw error;
  }
  if (!response || response.status >= 500) response = (await cached(name)) ?? (response as Response);
  const [, build] = response.ok ? (BUILD_IN_PAGE.exec(await response.clone().text()) ?? []) : [];
  if (build) await remember(event.resultingClientId, build);
  if (build && build !== __BUILD__) void worker.registration.update().catch(() => undefined);
  return response;
}

async function hashedFile(request: Request, file: string): Promise<Response> {
  const kept = await inAnyBuild(file);
  if (kept) return kept;
  // What cannot be kept is still the page's to judge.
  return file in __FILES__ ? take(file).catch(() => fetch(request)) : fetch(request);
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

/** Puts a file of this build into its cache. */
async function keep(name: string): Promise<void> {
  if (await cached(name)) return;
  const former = HASHED.test(name) ? await inAnyBuild(name) : undefined;
  if (former) await (await caches.open(CACHE)).put(urlOf(name), former);
  else await take(name);
}

/** Fetches a file of this build and keeps it; fails when the network has another one. */
async function take(name: string): Promise<Response> {
  const fetched = (cache: RequestCache) => fetch(urlOf(name), { cache, ...(__FILES__[name] && { integrity: __FILES__[name] }) });
  // The HTTP cache may hold what the server answered before the file was there.
  const response = HASHED.test(name) ? await fetched('default').catch(() => fetched('reload')) : await fetched('no-cache');
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  // Hosts may add to a page, so it is known by its build id instead of its hash.
  if (name in __PAGES__ && BUILD_IN_PAGE.exec(await response.clone().text())?.[1] !== __BUILD__)
    throw new Error(`${name} is of another build`);
  await (await caches.open(CACHE)).put(urlOf(name), response.clone());
  return response;
}

async function cached(name: string, cache: string = CACHE): Promise<Response | undefined> {
  return (await caches.open(cache)).match(urlOf(name), { ignoreVary: true });
}

/** A file with a hashed name, from this build's cache or another's. */
async function inAnyBuild(file: string): Promise<Response | undefined> {
  const own = await cached(file);
  if (own) return own;
  for (const cache of await builds()) {
    const kept = await cached(file, cache);
    if (kept) return kept;
  }
  return undefined;
}

/** The caches of the builds of this copy of the page. */
async function builds(): Promise<string[]> {
  const names = (await caches.keys()).filter((name) => (name.startsWith(PREFIX) && name !== OPEN_PAGES) || UNSCOPED.test(name));
  // One without the scope in its name has its first page under it.
  const isOurs = await Promise.all(names.map(async (name) => name.startsWith(PREFIX) || Boolean(await cached(PAGE, name))));
  return names.filter((_, index) => isOurs[index]);
}

function remember(client: string, build: string): Promise<void> {
  return caches.open(OPEN_PAGES).then((pages) => pages.put(keyOf(client), new Response(build)));
}

function keyOf(client: string): string {
  return `${scope}?client=${client}`;
}

/** Drops the caches of builds that no open page is of, once it is known of which each is. */
async function dropUnneeded(): Promise<void> {
  const { installing, waiting } = worker.registration;
  // The cache of a newer worker is not this one's to judge; that one will.
  if (installing || waiting) return;
  const clients = (await worker.clients.matchAll({ includeUncontrolled: true, type: 'window' })).filter(({ url }) => url.startsWith(scope));
  const pages = await caches.open(OPEN_PAGES);
  const open = await Promise.all(clients.map(async ({ id }) => (await pages.match(keyOf(id)))?.text()));
  const known = new Set(clients.map(({ id }) => keyOf(id)));
  await Promise.all((await pages.keys()).filter(({ url }) => !known.has(url)).map((request) => pages.delete(request)));
  if (open.includes(undefined)) return;
  const needed = [__BUILD__, ...open];
  await Promise.all((await builds()).filter((name) => !needed.includes(name.split(/[-:]/).at(-1))).map((name) => caches.delete(name)));
}

/** What a URL asks for below the scope, of a folder its page; `undefined` for anything else. */
function fileOf(url: string): string | undefined {
  const bare = url.replace(/[?#].*$/s, '');
  return bare.startsWith(scope) ? bare.slice(scope.length).replace(/(^|\/)$/, `$1${PAGE}`) : undefined;
}

/** The file of this build that a URL means. */
function nameOf(url: string): string | undefined {
  const file = fileOf(url);
  return file !== undefined && (file in __PAGES__ || file in __FILES__) ? file : undefined;
}

function urlOf(name: string): string {
  // The directory itself: some hosts redirect index.html to it, and a redirected answer cannot be given to a page.
  return scope + name.replace(/(^|\/)index\.html$/, '$1');
}
