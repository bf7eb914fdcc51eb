// The element without a browser: what its attributes mean, and that importing it on a server is silent.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ATTRIBUTES, readAttributes } from '../../www/element-attributes.ts';
import type { AttributeState } from '../../www/element-attributes.ts';
import { PRESETS } from '../../www/params.ts';
import { defaultParams, presetParams, resolveParams } from '../../www/params-flat.ts';

function read(given: Partial<Record<(typeof ATTRIBUTES)[number], string>>): AttributeState {
  return readAttributes((name) => given[name] ?? null);
}

const DEFAULTS = { params: defaultParams(), view: '3d', color: 'layer', camera: null, notices: [] };

test('absent attributes are the defaults, without a word', () => {
  assert.deepEqual(read({}), DEFAULTS);
});

test('every preset, view and colour can be named', () => {
  for (const { name } of PRESETS) assert.deepEqual(read({ preset: name }), { ...DEFAULTS, params: presetParams(name) });
  for (const view of ['3d', 'wireframe', 'diagrams', 'selection']) assert.deepEqual(read({ view }), { ...DEFAULTS, view });
  for (const color of ['layer', 'rock', 'plain']) assert.deepEqual(read({ color }), { ...DEFAULTS, color });
});

test('a seed is any whole number of 32 bits', () => {
  for (const [text, seed] of [['0', 0], ['7', 7], [' 42 ', 42], ['4294967295', 4294967295], ['+5', 5], ['-0', 0]] as const) {
    const { params, notices } = read({ seed: text });
    assert.deepEqual([params.seed, notices], [seed, []], text);
  }
});

test('a malformed attribute is its default, or the nearest legal value, and exactly one notice that names it', () => {
  const cases: [Parameters<typeof read>[0], (state: AttributeState) => unknown, unknown][] = [
    [{ seed: 'seven' }, ({ params }) => params.seed, 0],
    [{ seed: '' }, ({ params }) => params.seed, 0],
    [{ seed: '1.5' }, ({ params }) => params.seed, 0],
    [{ seed: 'NaN' }, ({ params }) => params.seed, 0],
    [{ seed: '-1' }, ({ params }) => params.seed, 0],
    [{ seed: '99999999999999999999' }, ({ params }) => params.seed, 4294967295],
    [{ preset: 'journal-fig99' }, ({ params }) => params, defaultParams()],
    [{ preset: '' }, ({ params }) => params, defaultParams()],
    [{ preset: 'toString' }, ({ params }) => params, defaultParams()],
    [{ view: '4d' }, ({ view }) => view, '3d'],
    [{ color: 'LAYER' }, ({ color }) => color, 'layer'],
    [{ src: '#v=1&cd=7' }, ({ params }) => params.packing, 1],
    [{ src: '#nobody=7' }, ({ params }) => params, defaultParams()],
    [{ src: `#${'x'.repeat(200_000)}` }, ({ params }) => params, defaultParams()],
  ];
  for (const [given, value, wanted] of cases) {
    const state = read(given);
    const [name] = Object.keys(given);
    const text = JSON.stringify(given).slice(0, 60);
    assert.deepEqual(value(state), wanted, text);
    assert.equal(state.notices.length, 1, text);
    assert.equal(state.notices[0]!.attribute, name, text);
    assert(state.notices[0]!.message.startsWith(`${name}: `) && state.notices[0]!.message.length < 250, text);
    assert.deepEqual(resolveParams(state.params), state.params, text);
  }
});

test('src fills everything, and every other attribute but the preset replaces what it says', () => {
  const src = '#v=1&preset=conference-fig9a&seed=5&view=diagrams&color=plain&camera=1,0.5,200,10,20,0';
  const state = read({ src, preset: 'journal-fig11c' });
  assert.deepEqual(state, {
    params: { ...presetParams('conference-fig9a'), seed: 5 },
    view: 'diagrams',
    color: 'plain',
    camera: { azimuth: 1, elevation: 0.5, distance: 200, target: [10, 20, 0] },
    notices: [],
  });
  const replaced = read({ src, seed: '6', view: '3d', color: 'rock' });
  assert.deepEqual([replaced.params.seed, replaced.view, replaced.color], [6, '3d', 'rock']);
});

test('importing the element on a server is silent and defines nothing', async (t) => {
  const said = ['log', 'info', 'warn', 'error'].map((name) => t.mock.method(console, name as 'log', () => {}));
  const { RockFieldElement } = await import('../../www/rock-field.ts');
  assert.equal(typeof RockFieldElement, 'function');
  assert.deepEqual(RockFieldElement.observedAttributes, ATTRIBUTES);
  assert.doesNotThrow(() => new RockFieldElement());
  assert(said.every(({ mock }) => mock.callCount() === 0));
  assert.equal((globalThis as { customElements?: unknown }).customElements, undefined);
});
