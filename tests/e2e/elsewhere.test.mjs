// The elements in pages that are unlike ours: sandboxed, under Trusted Types, isolated, on another origin, with the scripts in other ways than meant.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { dist } from '../../scripts/lib/env.mjs';
import { buildInline } from '../../scripts/build/inline.mjs';
import { serve } from '../../scripts/lib/serve.mjs';
import { PATIENCE, launch } from './browser.mjs';

const SMALL = 'image-width="200" image-height="150" style="display: block; width: 200px; height: 150px"';
const ROCKS = `<rock-field ${SMALL} radius="30 10"></rock-field>`;
const EARS =
  '<wood-ear-log ground="none" density="4" range="20" log-spacing="6" style="display: block; width: 200px; height: 150px"></wood-ear-log>';

/** What an element comes to: its picture and what is in it, or its first error. */
const SEEN = `
  const failures = {};
  // From the beginning, and on the way down: these events do not bubble.
  const failed = (name) => (failures[name] ??= Promise.withResolvers());
  document.addEventListener('error', ({ target, detail }) => detail?.error && failed(target.localName).resolve(detail.error.name + ': ' + detail.error.message), true);
  globalThis.seen = (name) => {
    const element = document.querySelector(name);
    const shown = customElements.whenDefined(name).then(() => element.ready).then(() => (element.field?.stats.rocks ?? 0) > 0 || element.colony ? 'shown by ' + element.backend : 'empty');
    return Promise.race([failed(name).promise, shown, new Promise((resolve) => setTimeout(resolve, ${PATIENCE}, 'nothing'))]);
  };
`;

/** @type {import('./browser.mjs').Session} */
let session;
let far;
let folder;
let html = {};
let headers = {};

before(async () => {
  folder = mkdtempSync(path.join(os.tmpdir(), 'rock-field-inline-'));
  await buildInline(folder);
  const intercept = (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    response.setHeader('access-control-allow-origin', '*');
    for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
    if (pathname.startsWith('/inline/')) {
      response
        .writeHead(200, { 'content-type': 'text/javascript' })
        .end(readFileSync(path.join(folder, pathname.slice('/inline/'.length))));
      return true;
    }
    const text = html[pathname.slice(1)];
    if (text !== undefined) response.writeHead(200, { 'content-type': 'text/html' }).end(text);
    return text !== undefined;
  };
  session = await launch({ intercept });
  far = await serve(dist, { intercept: (_, response) => void response.setHeader('access-control-allow-origin', '*') });
});

after(async () => {
  await session?.close();
  await far?.close();
  rmSync(folder, { recursive: true, force: true });
});

function pageWith(body, head = '') {
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>elsewhere</title><link rel="icon" href="data:,">${head}<script>${SEEN}</script>${body}`;
}

/** What the elements of a page come to. */
async function look(body, { names = ['rock-field'], header = {}, head = '' } = {}) {
  html = { 'elsewhere.html': pageWith(body, head) };
  headers = header;
  const { page, errors, close } = await session.open('elsewhere.html');
  const seen = await page.evaluate((all) => Promise.all(all.map((name) => globalThis.seen(name))), names);
  await close();
  headers = {};
  return { seen, errors };
}

/** As `look`, of a page in a frame of this page. */
async function lookInside(body, attributes, names = ['rock-field']) {
  html = {
    'inner.html': pageWith(body),
    'elsewhere.html': pageWith(`<iframe ${attributes} src="/inner.html" width="400" height="300"></iframe>`),
  };
  const { page, errors, close } = await session.open('elsewhere.html');
  const frame = /** @type {import('playwright-core').Frame} */ (await (await page.waitForSelector('iframe')).contentFrame());
  await frame.waitForFunction(() => globalThis.seen !== undefined && document.readyState === 'complete');
  const seen = await frame.evaluate((all) => Promise.all(all.map((name) => globalThis.seen(name))), names);
  await close();
  return { seen, errors };
}

const MODULES = '<script type="module" src="/rock-field.js"></script><script type="module" src="/wood-ear-log.js"></script>';
const CLASSIC = '<script src="/cdn.js"></script><script src="/wood-ear-cdn.js"></script>';
const INLINE = '<script type="module" src="/inline/rock-field.js"></script><script type="module" src="/inline/wood-ear-log.js"></script>';
const BOTH = ['rock-field', 'wood-ear-log'];
const SHOWN = ['shown by webgl', 'shown by webgl'];

for (const [name, scripts] of Object.entries({
  'the modules': MODULES,
  'the classic scripts': CLASSIC,
  'the scripts with everything in them': INLINE,
})) {
  test(`a sandboxed frame, which has no origin, shows both elements: ${name}`, async () => {
    assert.deepEqual(await lookInside(ROCKS + EARS + scripts, 'sandbox="allow-scripts"', BOTH), { seen: SHOWN, errors: [] });
  });
}

test('the classic scripts of another origin show both elements, in a sandboxed frame too', async () => {
  const scripts = `<script src="${far.url.replace('localhost', '127.0.0.1')}cdn.js"></script><script src="${far.url.replace('localhost', '127.0.0.1')}wood-ear-cdn.js"></script>`;
  assert.deepEqual(await look(ROCKS + EARS + scripts, { names: BOTH }), { seen: SHOWN, errors: [] });
  assert.deepEqual(await lookInside(ROCKS + EARS + scripts, 'sandbox="allow-scripts"', BOTH), { seen: SHOWN, errors: [] });
});

const TYPED = "require-trusted-types-for 'script'";

for (const [name, scripts] of Object.entries({
  'the modules': MODULES,
  'the classic scripts': CLASSIC,
  'the scripts with everything in them': INLINE,
})) {
  test(`a page that requires Trusted Types shows both elements with their panels by the policies of the recipe: ${name}`, async () => {
    const recipe = readFileSync(new URL('../../www/docs/pages/recipes.md', import.meta.url), 'utf8');
    const [policy] = /^require-trusted-types-for 'script'; trusted-types .*$/m.exec(recipe) ?? ['the recipe says nothing'];
    const open = `${ROCKS}${EARS}`.replaceAll(' style=', ' controls="open" style=');
    const { seen, errors } = await look(open + scripts, { names: BOTH, header: { 'content-security-policy': policy } });
    assert.deepEqual({ seen, errors }, { seen: SHOWN, errors: [] });
  });
}

test('a page that requires Trusted Types and does not allow the policy is told which one to allow', async () => {
  const { seen } = await look(ROCKS + MODULES, { header: { 'content-security-policy': `${TYPED}; trusted-types other` } });
  assert.match(seen[0], /^WorkerUnavailable: .*trusted-types rock-field/);
});

test('the classic script works as a module, deferred, twice, and beside the other one', async () => {
  const ways = {
    module: '<script type="module" src="/cdn.js"></script>',
    async: '<script async src="/cdn.js"></script>',
    defer: '<script defer src="/cdn.js"></script>',
    injected: "<script>const script = document.createElement('script'); script.src = '/cdn.js'; document.head.append(script)</script>",
    imported: '<script type="module">import(\'/cdn.js\')</script>',
    twice: '<script src="/cdn.js"></script><script src="/cdn.js"></script>',
    'as a module and classic': '<script type="module" src="/cdn.js"></script><script src="/cdn.js"></script>',
    'with a query': '<script type="module" src="/cdn.js?v=1:2:3"></script>',
  };
  for (const [name, script] of Object.entries(ways))
    assert.deepEqual(await look(ROCKS + script), { seen: SHOWN.slice(1), errors: [] }, name);
  assert.deepEqual(await look(ROCKS + EARS + CLASSIC.repeat(2), { names: BOTH }), { seen: SHOWN, errors: [] });
});

test('the classic script evaluated, or written into the page, says how to include it', async () => {
  const text = readFileSync(path.join(dist, 'cdn.js'), 'utf8').replace(/\n\/\/# sourceMappingURL.*/, '');
  const code = (way) => `<script type="module">const text = await (await fetch('/cdn.js')).text(); ${way}</script>`;
  const ways = {
    eval: code('(0, eval)(text)'),
    'direct eval': code('eval(text)'),
    function: code('new Function(text)()'),
    blob: code(
      "const script = document.createElement('script'); script.src = URL.createObjectURL(new Blob([text])); document.head.append(script)",
    ),
    'blob as a module': code("await import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })))"),
    'text of a script': code("const script = document.createElement('script'); script.textContent = text; document.head.append(script)"),
    'evaluated by a classic script':
      "<script>const request = new XMLHttpRequest(); request.open('GET', '/cdn.js', false); request.send(); eval(request.responseText)</script>",
    'in the page': `<script>${text.replaceAll('</script', '<\\/script')}</script>`,
    'in the page as a module': `<script type="module">${text.replaceAll('</script', '<\\/script')}</script>`,
  };
  for (const [name, script] of Object.entries(ways)) {
    const { seen } = await look(ROCKS + script);
    assert.match(seen[0], /^WorkerUnavailable: .*include it by its address/, name);
  }
});

test('an isolated page shows the element from its own server, whose files have the header, and from another origin', async () => {
  const header = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };
  assert.deepEqual(await look(ROCKS + EARS + MODULES, { names: BOTH, header }), { seen: SHOWN, errors: [] });
  const address = `${far.url.replace('localhost', '127.0.0.1')}cdn.js`;
  assert.deepEqual(await look(`${ROCKS}<script crossorigin src="${address}"></script>`, { header }), { seen: SHOWN.slice(1), errors: [] });
});
