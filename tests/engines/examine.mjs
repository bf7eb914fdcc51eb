// One engine with one backend: each element of an otherwise empty page, then whole pages, seen from outside and asked from inside.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { screenshotPath } from '../e2e/browser.mjs';
import path from 'node:path';
import { dist } from '../../scripts/env.mjs';
import { decodePng } from './png.mjs';
import { faults, statistics } from './statistics.mjs';

const PAGE = 'engine.html';
const EMPTY_PAGE = 'empty.html';
const HTML = { 'content-type': 'text/html' };
const HEAD = '<!doctype html><html lang="en"><meta charset="utf-8"><title>engine</title><link rel="icon" href="data:,">';
const WHITE = [255, 255, 255];
const OTHER_SEED = 7;
/** Not the proportions of the element, and small: it is drawn once more for it. */
const FILE = { width: 160, height: 90 };

const golden = (name) => JSON.parse(readFileSync(new URL(`../data/${name}.json`, import.meta.url), 'utf8'));
const ROCKS = golden('golden');
const WOOD_EARS = golden('wood-ear-golden');
/** Few individuals, and all that there is of collisions. */
const COLONY = 'thesis-minimum';
/** The site's pages: what each shows at its bare address. In the documentation that is an example. */
const PAGES = [
  { name: 'index.html', element: 'rock-field', hash: ROCKS.riverbed },
  { name: 'wood-ear.html', element: 'wood-ear-log', hash: WOOD_EARS['fallen-log'] },
  { name: 'docs/attributes.html', anchor: '#attribute-seed', element: 'rock-field' },
];
const SCRIPTS = { '/page.mjs': 'page.mjs', '/visit.js': 'visit.js', '/golden.mjs': '../golden.mjs' };

/** What the pages draw with. */
let pagesBackend;

/** For `serve`: the page, whose element gets the attributes of the query, its modules, and the site's pages with a script that is asked. */
export function intercept(request, response) {
  const { pathname, searchParams } = new URL(request.url, 'http://localhost');
  if (SCRIPTS[pathname]) response.writeHead(200, { 'content-type': 'text/javascript' }).end(readFileSync(new URL(SCRIPTS[pathname], import.meta.url)));
  else if (pathname === `/${PAGE}`) response.writeHead(200, HTML).end(page(searchParams.get('element'), [...searchParams].filter(([name]) => name !== 'element')));
  else if (PAGES.some(({ name }) => pathname === `/${name}`)) response.writeHead(200, HTML).end(watched(pathname.slice(1)));
  else if (pathname === `/${EMPTY_PAGE}`) response.writeHead(200, HTML).end(HEAD);
  else return false;
  return true;
}

function watched(name) {
  const script = `<script src="/visit.js" data-backend="${pagesBackend}"></script>`;
  return readFileSync(path.join(dist, name), 'utf8').replace(/<head>/, `<head>${script}`);
}

function page(element, attributes) {
  const written = attributes.map(([name, value]) => ` ${name}="${value}"`).join('');
  return `${HEAD}
<${element} style="width:400px;height:300px"${written}></${element}>
<script type="module" src="/page.mjs"></script><script type="module" src="/${element}.js"></script>`;
}

/** Whether an engine has a device for each backend, by its own account. */
export async function offers(engine, url) {
  await engine.go(url + EMPTY_PAGE);
  return engine.evaluate(`(async () => ({
    webgpu: Boolean(await navigator.gpu?.requestAdapter()),
    webgl: Boolean(document.createElement('canvas').getContext('webgl2')),
  }))()`);
}

/**
 * Everything that is asked of an engine with one backend.
 *
 * @returns {Promise<{ statistics: object, ms: number, rocks: number }>} of the picture; until the first picture; in it
 */
export async function examine(engine, url, { backend, name }) {
  const { ms, rocks, picture, box } = await show(engine, `${url}${PAGE}?element=rock-field&backend=${backend}`, backend, name);
  const seen = statistics(picture, box, WHITE);
  same(faults(seen), [], `faults of ${screenshotPath(name)}`);
  await file(engine);
  await edit(engine, picture, box);
  await removal(engine);
  return { statistics: seen, ms, rocks };
}

/** The element without any attribute takes the best backend there is. */
export async function examineAuto(engine, url, backend) {
  await show(engine, `${url}${PAGE}?element=rock-field`, backend);
}

/**
 * The element of wood ears: a colony, then one on a log from a file.
 *
 * @returns {Promise<{ individuals: number, hash: string }>} of the second
 */
export async function examineColony(engine, url, backend) {
  await engine.go(`${url}${PAGE}?element=wood-ear-log&backend=${backend}&preset=${COLONY}`);
  const said = await ask(engine, 'shown()');
  same([said.backend, said.hash], [backend, WOOD_EARS[COLONY]], 'what draws, and the hash of the colony');
  const { vertices, individuals, hash } = await ask(engine, `bringLog(${JSON.stringify(log())}, "log.obj")`);
  same(vertices, LOG.around * LOG.rings + 2, 'vertices of the log');
  assert(individuals > 0, 'something grows on it');
  await removal(engine);
  return { individuals, hash };
}

const LOG = { around: 24, rings: 30, radius: 8, length: 100 };

/** A cylinder as an OBJ file, cm. */
function log() {
  const { around, rings, radius, length } = LOG;
  const lines = [];
  const vertex = (ring, k, share = 1) => {
    const angle = (2 * Math.PI * k) / around;
    const point = [(length * ring) / (rings - 1) - length / 2, share * radius * Math.cos(angle), radius + share * radius * Math.sin(angle)];
    lines.push(`v ${point.map((c) => c.toFixed(3)).join(' ')}`);
  };
  const face = (...corners) => lines.push(`f ${corners.map((corner) => corner + 1).join(' ')}`);
  for (let ring = 0; ring < rings; ring += 1) for (let k = 0; k < around; k += 1) vertex(ring, k);
  vertex(0, 0, 0);
  vertex(rings - 1, 0, 0);
  const [left, right] = [around * rings, around * rings + 1];
  for (let k = 0; k < around; k += 1) {
    const next = (k + 1) % around;
    for (let ring = 0; ring + 1 < rings; ring += 1) {
      const at = ring * around;
      face(at + k, at + next, at + around + next, at + around + k);
    }
    face(left, next, k);
    face(right, around * (rings - 1) + k, around * (rings - 1) + next);
  }
  return lines.join('\n');
}

/** The site's two pages and one of the documentation's, each until it shows what it has to. */
export async function examinePages(engine, url, backend) {
  pagesBackend = backend;
  for (const { name, anchor = '', element, hash } of PAGES) {
    await engine.go(`${url}${name}${anchor}`);
    const said = await ask(engine, 'visited()');
    same([said.element, said.backend], [element, backend], `what draws in ${name}`);
    same(said.hash, hash ?? (await hashInNode(said.params)), `hash of what ${name} shows`);
  }
}

async function hashInNode(params) {
  const { generate } = await import('rock-field/core');
  const { hashField } = await import('../golden.mjs');
  return hashField(await generate(params));
}

/** Opens a page with the element and compares what it says of itself; `name` is the screenshot's, if one is to be taken. */
async function show(engine, address, backend, name) {
  await engine.go(address);
  const { box: lengths, ms, ...said } = await ask(engine, 'shown()');
  same(said.backend, backend, 'what draws');
  same(said.hash, ROCKS['journal-fig1'], 'hash of the field');
  same(said.generated, [{ rocks: said.rocks, isShown: true }], 'generate events');
  if (!name) return {};
  const [x, y, width, height] = lengths.map(Math.round);
  return { ms, rocks: said.rocks, picture: await look(engine, name), box: { x, y, width, height } };
}

async function look(engine, name) {
  const shot = await engine.screenshot();
  writeFileSync(screenshotPath(name), shot);
  return decodePng(shot);
}

/** `toBlob` gives a PNG of the size asked for, with a picture in it. */
async function file(engine) {
  const { type, address } = await ask(engine, `picture(${JSON.stringify({ ...FILE, type: 'image/png' })})`);
  same(type, 'image/png', 'type of the file');
  const picture = decodePng(Buffer.from(address.slice(address.indexOf(',') + 1), 'base64'));
  same([picture.width, picture.height], [FILE.width, FILE.height], 'size of the file');
  const { layers } = statistics(picture, { x: 0, y: 0, ...FILE }, WHITE);
  assert(layers.every(({ share }) => share > 0), 'there are rocks of every layer in the file');
}

/** An attribute gives the field that Node gives, once, and another picture. */
async function edit(engine, before, box) {
  const { hash, fields } = await ask(engine, `change("seed", "${OTHER_SEED}")`);
  same(hash, await hashInNode({ preset: 'journal-fig1', seed: OTHER_SEED }), 'hash of the field of another seed');
  same(fields, 1, 'fields for one attribute');
  const after = decodePng(await engine.screenshot());
  const changed = changedShare(before, after, box);
  assert(changed > 0.1, `another seed changed only ${(100 * changed).toFixed(1)} % of the pixels`);
}

function changedShare(a, b, { x, y, width, height }) {
  same([a.width, a.height, a.channels], [b.width, b.height, b.channels], 'size of the screenshots');
  let changed = 0;
  for (let row = y; row < y + height; row += 1) {
    for (let column = x; column < x + width; column += 1) {
      const at = (row * a.width + column) * a.channels;
      // Less than this is noise of a device.
      if ([0, 1, 2].some((channel) => Math.abs(a.data[at + channel] - b.data[at + channel]) > 8)) changed += 1;
    }
  }
  return changed / (width * height);
}

async function removal(engine) {
  const { workers, backend } = await ask(engine, 'remove()');
  same(workers.ended, workers.started, 'workers that have ended');
  same(backend, null, 'what draws after the removal');
}

/** The answer of the page, in which nothing may have gone wrong. */
async function ask(engine, call) {
  // A page counts as loaded before its modules have run, in some engines.
  const arrived = `new Promise((done) => { const look = () => (globalThis.examined ? done(examined.${call}) : setTimeout(look, 20)); look(); })`;
  const { complaints, ...answer } = await engine.evaluate(arrived);
  same([...complaints, ...engine.complaints()], [], 'what went wrong in the page');
  return answer;
}

function same(actual, expected, what) {
  assert.deepEqual(actual, expected, `${what}: ${JSON.stringify(actual)} instead of ${JSON.stringify(expected)}`);
}
