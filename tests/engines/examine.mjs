// One engine with one backend: the element of an otherwise empty page, seen from outside and asked from inside.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { screenshotPath } from '../e2e/browser.mjs';
import { ask, same } from './ask.mjs';
import { changedShare, readPicture } from '../../scripts/lib/pixels.mjs';
import { faults, statistics } from './statistics.mjs';
import { hashInNode, interceptVisits } from './visits.mjs';

/** Of an element, `?element=rock-field` unless told otherwise; the rest of the query are its attributes. */
export const PAGE = 'engine.html';
const EMPTY_PAGE = 'empty.html';
const HTML = { 'content-type': 'text/html' };
const HEAD = '<!doctype html><html lang="en"><meta charset="utf-8"><title>engine</title><link rel="icon" href="data:,">';
const WHITE = [255, 255, 255];
const OTHER_SEED = 7;
/** Not the proportions of the element, and small: it is drawn once more for it. */
const FILE = { width: 160, height: 90 };

const golden = JSON.parse(readFileSync(new URL('../data/golden.json', import.meta.url), 'utf8'))['journal-fig1'];

/** For `serve`: the page, its modules, and what is visited. */
export function intercept(request, response) {
  const { pathname, searchParams } = new URL(request.url, 'http://localhost');
  const file = { '/page.mjs': new URL('page.mjs', import.meta.url), '/golden.mjs': new URL('../e2e/golden.mjs', import.meta.url) }[
    pathname
  ];
  if (file) response.writeHead(200, { 'content-type': 'text/javascript', 'access-control-allow-origin': '*' }).end(readFileSync(file));
  else if (pathname === `/${PAGE}`)
    response.writeHead(200, HTML).end(
      page(
        searchParams.get('element') ?? 'rock-field',
        [...searchParams].filter(([name]) => name !== 'element'),
      ),
    );
  else if (pathname === `/${EMPTY_PAGE}`) response.writeHead(200, HTML).end(HEAD);
  else return interceptVisits(request, response);
  return true;
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
  const { ms, rocks, picture, box } = await show(engine, `${url}${PAGE}?backend=${backend}`, backend, name);
  const seen = statistics(picture, box, WHITE);
  same(faults(seen), [], `faults of ${screenshotPath(name)}`);
  await file(engine);
  await edit(engine, picture, box);
  await removal(engine);
  return { statistics: seen, ms, rocks };
}

/** Opens a page with the element and compares what it says of itself; `name` is the screenshot's. */
async function show(engine, address, backend, name) {
  await engine.go(address);
  const { box: lengths, ms, ...said } = await ask(engine, 'shown()');
  same(said.backend, backend, 'what draws');
  same(said.hash, golden, 'hash of the field');
  same(said.notices, [], 'notice events');
  same(said.generated, [{ rocks: said.rocks, isShown: true }], 'generate events');
  const [x, y, width, height] = lengths.map(Math.round);
  return { ms, rocks: said.rocks, picture: await look(engine, name), box: { x, y, width, height } };
}

async function look(engine, name) {
  const shot = await engine.screenshot();
  writeFileSync(screenshotPath(name), shot);
  return readPicture(shot);
}

/** `toBlob` gives a PNG of the size asked for, with a picture in it. */
async function file(engine) {
  const { type, address } = await ask(engine, `picture(${JSON.stringify({ ...FILE, type: 'image/png' })})`);
  same(type, 'image/png', 'type of the file');
  const picture = readPicture(Buffer.from(address.slice(address.indexOf(',') + 1), 'base64'));
  same([picture.width, picture.height], [FILE.width, FILE.height], 'size of the file');
  const { layers } = statistics(picture, { x: 0, y: 0, ...FILE }, WHITE);
  assert(
    layers.every(({ share }) => share > 0),
    'there are rocks of every layer in the file',
  );
}

/** An attribute gives the field that Node gives, once, and another picture. */
async function edit(engine, before, box) {
  const { hash, fields } = await ask(engine, `change("seed", "${OTHER_SEED}")`);
  same(hash, await hashInNode({ preset: 'journal-fig1', seed: OTHER_SEED }), 'hash of the field of another seed');
  same(fields, 1, 'fields for one attribute');
  const after = readPicture(await engine.screenshot());
  const changed = changedShare(before, after, box);
  assert(changed > 0.1, `another seed changed only ${(100 * changed).toFixed(1)} % of the pixels`);
}

async function removal(engine) {
  const { workers, backend } = await ask(engine, 'remove()');
  same(workers, { started: 1, ended: 1 }, 'workers');
  same(backend, null, 'what draws after the removal');
}
