// As Jest and Vitest have it: a document of jsdom's or happy-dom's in Node. The elements can be made, set and asked, say nothing and draw nothing.
import assert from 'node:assert/strict';
import { inspect } from 'node:util';

const said = [];
for (const method of ['log', 'warn', 'error']) console[method] = (...words) => said.push(inspect(words));
for (const event of ['uncaughtException', 'unhandledRejection']) process.on(event, (thrown) => said.push(inspect(thrown)));

const window = process.argv[2] === 'jsdom' ? await jsdom() : new (await import('happy-dom')).Window({ url: 'http://localhost/' });

async function jsdom() {
  const { JSDOM, VirtualConsole } = await import('jsdom');
  const virtualConsole = new VirtualConsole();
  virtualConsole.on('jsdomError', (error) => said.push(inspect(error)));
  return new JSDOM('<!doctype html>', { url: 'http://localhost/', pretendToBeVisual: true, virtualConsole }).window;
}

for (const name of Object.getOwnPropertyNames(window)) if (!(name in globalThis)) globalThis[name] = window[name];
// Node has its own of these.
for (const name of ['Event', 'CustomEvent', 'EventTarget']) globalThis[name] = window[name];

await import('rock-field');
await import('rock-field/wood-ear-log');
for (const name of ['rock-field', 'wood-ear-log']) {
  document.body.innerHTML = `<${name} seed="7" theme="dark" controls="open" poster="x.png"></${name}>`;
  const element = document.body.firstElementChild;
  assert.deepEqual([element.seed, element.theme, element.backend], [7, 'dark', null]);
  element.seed = 9;
  element.setAttribute('view', 'wireframe');
  assert.deepEqual([element.params.seed, element.view], [9, 'wireframe']);
  for (const call of ['generate', 'toBlob']) await assert.rejects(element[call](), { name: 'NotConnected' });
  element.remove();
  document.body.append(element);
}
// Longer than an element out of the document waits before it lets go of everything.
await new Promise((resolve) => setTimeout(resolve, 1200));
assert.deepEqual(said, []);
process.exit();
