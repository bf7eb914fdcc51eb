// One engine: the element of wood ears with logs from files, the site's pages, and a frame without an origin.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { dist } from '../../scripts/lib/env.mjs';
import { ask, same } from './ask.mjs';
import { LOG_VERTICES, logAsObj } from './log.mjs';

const HTML = { 'content-type': 'text/html' };
const SMALL = 'style="display: block; width: 300px; height: 200px"';

const golden = (name) => JSON.parse(readFileSync(new URL(`../data/${name}.json`, import.meta.url), 'utf8'));
const ROCKS = golden('golden');
const WOOD_EARS = golden('wood-ear-golden');
/** With all there is of drying, wrinkles and collisions. */
const COLONY = 'thesis-default';
const QUANTIZED = readFileSync(new URL('../data/logs/F06-quantized.glb', import.meta.url)).toString('base64');

/** What each of the site's pages shows at an address; in the documentation it is an example. */
const PAGES = [
  { name: 'index.html', address: '#preset=journal-fig1', element: 'rock-field', hash: ROCKS['journal-fig1'] },
  { name: 'wood-ear.html', address: `#preset=${COLONY}`, element: 'wood-ear-log', hash: WOOD_EARS[COLONY] },
  { name: 'docs/index.html', element: 'rock-field' },
];
const FRAME = 'engine-frame.html';
const FRAMED = 'engine-framed.html';

/** For `serve`: the site's pages with a script that is asked, and a page with a frame. */
export function interceptVisits(request, response) {
  const { pathname, searchParams } = new URL(request.url, 'http://localhost');
  const allowed = searchParams.get('allowed');
  // A frame without an origin gets modules as other origins do.
  response.setHeader('access-control-allow-origin', '*');
  if (pathname === '/visit.js')
    response.writeHead(200, { 'content-type': 'text/javascript' }).end(readFileSync(new URL('visit.js', import.meta.url)));
  else if (PAGES.some(({ name }) => pathname === `/${name}`))
    response.writeHead(200, HTML).end(watched(readFileSync(path.join(dist, pathname), 'utf8'), allowed));
  else if (pathname === `/${FRAME}`) response.writeHead(200, HTML).end(framing(allowed));
  else if (pathname === `/${FRAMED}`) response.writeHead(200, HTML).end(framed());
  else return false;
  return true;
}

/** `allowed` is what the page may draw with. */
function watched(page, allowed) {
  return page.replace('<head>', `<head><script src="/visit.js" data-allowed="${allowed}"></script>`);
}

function framing(allowed) {
  return watched(
    `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>frame</title><link rel="icon" href="data:,"></head>
<iframe sandbox="allow-scripts" src="/${FRAMED}" width="400" height="500"></iframe>`,
    allowed,
  );
}

/** Both elements; the frame tells the page what they come to. */
function framed() {
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>framed</title><link rel="icon" href="data:,">
<rock-field preset="journal-fig1" ${SMALL}></rock-field><wood-ear-log preset="${COLONY}" ${SMALL}></wood-ear-log>
<script type="module">
  import '/rock-field.js';
  import '/wood-ear-log.js';
  import { hashColony, hashField } from '/golden.mjs';
  for (const element of document.querySelectorAll('rock-field, wood-ear-log')) {
    const tell = (told) => parent.postMessage({ element: element.localName, ...told }, '*');
    element.addEventListener('error', ({ detail }) => tell({ error: detail.error.name + ': ' + detail.error.message }));
    const hash = async () => (element.localName === 'rock-field' ? hashField(await element.getField()) : hashColony(await element.getColony()));
    // The hash needs a secure context, which a frame without an origin is on this machine's own address.
    void element.ready.then(hash).then((hash) => tell({ hash }), (error) => tell({ error: String(error) }));
  }
</script>`;
}

/**
 * The element of wood ears: a colony, then one on a log from an OBJ file, then one from a quantized GLB, each as it grows in Node.
 *
 * @returns {Promise<{ individuals: number }>} on the OBJ's log
 */
export async function examineColony(engine, address, backend) {
  await engine.go(`${address}?element=wood-ear-log&backend=${backend}&preset=${COLONY}&ground=none`);
  // How long a run takes, and whether lengths had to be guessed, is told by notices, which are of no interest here.
  const said = await ask(engine, 'shown()');
  same([said.backend, said.hash], [backend, WOOD_EARS[COLONY]], 'what draws, and the hash of the colony');
  const obj = await ask(engine, `bringLog(${JSON.stringify(btoa(logAsObj()))}, "log.obj")`);
  same(obj.params.mesh.positions.length, 3 * LOG_VERTICES, 'coordinates of the log');
  assert(obj.individuals > 0, 'something grows on the log');
  same(obj.hash, await grownInNode(obj.params), 'hash of the colony on the log of an OBJ file');
  const glb = await ask(engine, `bringLog(${JSON.stringify(QUANTIZED)}, "log.glb")`);
  same(glb.hash, await grownInNode(glb.params), 'hash of the colony on the log of a GLB file');
  return { individuals: obj.individuals };
}

async function grownInNode({ mesh, log, ground: _, ...params }) {
  const { growWoodEar } = await import('rock-field/core');
  const { hashColony } = await import('../e2e/golden.mjs');
  const ownLog = { positions: Float32Array.from(mesh.positions), indices: Uint32Array.from(mesh.indices), spacing: log.spacing };
  return hashColony(await growWoodEar({ ...params, log: ownLog }));
}

/** The site's two pages and one of the documentation's, each until it shows what it has to. Left to themselves they take the best backend that is allowed. */
export async function examinePages(engine, url, backend) {
  for (const { name, address = '', element, hash } of PAGES) {
    await engine.go(`${url}${name}?allowed=${backend}${address}`);
    const said = await ask(engine, 'visited()');
    same([said.element, said.backend], [element, backend], `what draws in ${name}`);
    same(said.hash, hash ?? (await hashInNode(said.params)), `hash of what ${name} shows`);
    same(said.plain, [], `files that ${name} asks for by a name without a hash`);
  }
}

export async function hashInNode(params) {
  const { generate } = await import('rock-field/core');
  const { hashField } = await import('../e2e/golden.mjs');
  return hashField(await generate(params));
}

/** Both elements in a frame that may run scripts and nothing else. */
export async function examineFrame(engine, url, backend) {
  await engine.go(`${url}${FRAME}?allowed=${backend}`);
  const { told } = await ask(engine, 'framed(2)');
  same(told, { 'rock-field': { hash: ROCKS['journal-fig1'] }, 'wood-ear-log': { hash: WOOD_EARS[COLONY] } }, 'what the frame shows');
}
