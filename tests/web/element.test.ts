// The element without a browser: what its attributes mean, and that importing it on a server is silent.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ATTRIBUTES, readAttributes } from '../../www/rocks/attributes.ts';
import type { AttributeState } from '../../www/rocks/attributes.ts';
import { orbitCamera, parseOrbit } from '../../www/scene/camera/orbit.ts';
import { describeField } from '../../www/rocks/description.ts';
import type { Field } from '../../www/data/field.ts';
import { lookOf } from '../../www/rocks/look.ts';
import { ROCKS } from '../../www/rocks/table.ts';
import { isLook, isMade } from '../../www/table/row.ts';
import { presetColor, same } from '../../www/table/table.ts';
import { PARAMS, PRESETS } from '../../www/rocks/params.ts';
import type { ParamSpec } from '../../www/rocks/spec.ts';
import type { Layer } from '../../www/rocks/params.ts';
import { defaultLayer, defaultParams, encodeParams, presetParams, readValue, resolveParams, writeValue } from '../../www/rocks/request.ts';

function read(given: Record<string, string>): AttributeState {
  return readAttributes((name) => given[name] ?? null);
}

const DEFAULTS = {
  params: defaultParams(),
  preset: PRESETS[0].name,
  view: '3d',
  color: null,
  camera: null,
  orbit: null,
  fov: 36,
  quality: 'auto',
  samples: 64,
  theme: 'auto',
  interaction: 'cooperative',
  navigation: 'orbit',
  loading: 'eager',
  metresPerPixel: 0.01,
  notices: [],
};

test('absent attributes are the defaults, without a word', () => {
  assert.deepEqual(read({}), DEFAULTS);
});

test('every preset, view and colour can be named', () => {
  for (const { name } of PRESETS) assert.deepEqual(read({ preset: name }), { ...DEFAULTS, params: presetParams(name), preset: name });
  for (const view of ['3d', 'wireframe', 'diagrams', 'selection']) assert.deepEqual(read({ view }), { ...DEFAULTS, view });
  for (const color of ['layer', 'rock', 'plain', 'natural']) assert.deepEqual(read({ color }), { ...DEFAULTS, color });
});

test("an explicit colour is kept, the preset's own too; without one, or with a malformed one, it is the preset's", () => {
  assert.deepEqual(
    [read({ preset: 'riverbed' }).color, read({ preset: 'riverbed', color: 'natural' }).color, read({ color: 'layer' }).color],
    [null, 'natural', 'layer'],
  );
  assert.match(read({ preset: 'riverbed', color: 'Natural' }).notices[0]!.message, /using natural/);
  assert.deepEqual(
    PRESETS.map(({ name }) => presetColor(ROCKS, name)),
    PRESETS.map((preset) => ('natural' in preset ? 'natural' : 'layer')),
  );
});

test('a seed is any whole number of 32 bits', () => {
  for (const [text, seed] of [
    ['0', 0],
    ['7', 7],
    [' 42 ', 42],
    ['4294967295', 4294967295],
    ['+5', 5],
    ['-0', 0],
  ] as const) {
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
    [{ color: 'LAYER' }, ({ color }) => color, null],
    [{ color: 'LAYER', src: '#preset=riverbed&color=plain' }, ({ color }) => color, 'plain'],
    [{ packing: '1.5' }, ({ params }) => params.packing, 1],
    [{ packing: 'much' }, ({ params }) => params.packing, 0.7],
    [{ 'image-width': '0' }, ({ params }) => params.imageWidth, 1],
    [{ 'image-width': '800.5' }, ({ params }) => params.imageWidth, 1024],
    [{ border: 'Clip' }, ({ params }) => params.border, 'clip'],
    [{ radius: '90 thirty 10 x' }, ({ params }) => params.layers.map(({ radius }) => radius), [90, 30, 10, defaultLayer(3, 'px').radius]],
    [{ radius: '9 8 7 6 5 4 3 2 1' }, ({ params }) => params.layers.map(({ radius }) => radius), [9, 8, 7, 6, 5, 4, 3, 2]],
    [{ 'camera-orbit': '45 55 120%' }, ({ orbit }) => orbit, null],
    [{ 'camera-orbit': '45deg 55deg 0%' }, ({ orbit }) => orbit, null],
    [{ fov: 'wide' }, ({ fov }) => fov, 36],
    [{ fov: '4' }, ({ fov }) => fov, 5],
    [{ quality: 'best' }, ({ quality }) => quality, 'auto'],
    [{ samples: '16.5' }, ({ samples }) => samples, 64],
    [{ samples: '5000' }, ({ samples }) => samples, 4096],
    [{ interaction: 'sometimes' }, ({ interaction }) => interaction, 'cooperative'],
    [{ loading: '' }, ({ loading }) => loading, 'eager'],
    [{ 'metres-per-pixel': '0' }, ({ metresPerPixel }) => metresPerPixel, 0.01],
    [{ src: '{"packing": 7}' }, ({ params }) => params, defaultParams()],
    [{ src: '{"packing": ' }, ({ params }) => params, defaultParams()],
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
    ...DEFAULTS,
    params: { ...presetParams('conference-fig9a'), seed: 5 },
    preset: 'conference-fig9a',
    view: 'diagrams',
    color: 'plain',
    camera: { azimuth: 1, elevation: 0.5, distance: 200, target: [10, 20, 0] },
  });
  const replaced = read({ src, seed: '6', view: '3d', color: 'rock' });
  assert.deepEqual([replaced.params.seed, replaced.view, replaced.color], [6, '3d', 'rock']);
});

test('every row of the table has an attribute, which replaces what the preset says and nothing else', () => {
  assert.deepEqual(read({ packing: '0.5', darts: 'attempts', 'image-height': '300' }), {
    ...DEFAULTS,
    params: { ...defaultParams(), packing: 0.5, darts: 'attempts', imageHeight: 300 },
  });
  const [a, b] = defaultParams().layers as [Layer, Layer, Layer];
  const state = read({ radius: '40, 20', 'taper-rock': '1 2', 'cell-count': '- 7' });
  const wanted = [
    { ...a, radius: 40, taper: [a.taper[0], 1, a.taper[2]], cellCount: null },
    { ...b, radius: 20, taper: [b.taper[0], 2, b.taper[2]], cellCount: 7 },
  ];
  assert.deepEqual([state.params.layers, state.notices], [wanted, []]);
  assert.deepEqual(read({ radius: '' }).params.layers, []);
  assert.equal(read({ radius: '1 2 3 4' }).params.layers.length, 4);
});

test("a choice of a layer is a list of words; a word that is none is the preset's, with one notice that names it", () => {
  const materials = (given: Record<string, string>) => read(given).params.layers.map(({ material }) => material);
  assert.deepEqual(materials({ material: 'granite slate, basalt' }), ['granite', 'slate', 'basalt']);
  assert.deepEqual(materials({ material: 'granite Slate x', preset: 'lava-field' }), ['granite', 'basalt', 'basalt']);
  assert.deepEqual(
    read({ material: 'granite Slate x' }).notices.map(({ attribute }) => attribute),
    ['material'],
  );
  assert.deepEqual(read({ material: '' }).params.layers, []);
});

test('a list of another length than the first is left out, with one notice that names it', () => {
  const { params, notices } = read({ radius: '50 20', 'area-fraction': '0.1 0.2 0.3' });
  assert.deepEqual(
    params.layers.map(({ radius, areaFraction }) => [radius, areaFraction]),
    defaultParams()
      .layers.slice(0, 2)
      .map(({ areaFraction }, k) => [[50, 20][k], areaFraction]),
  );
  assert.deepEqual(
    notices.map(({ attribute }) => attribute),
    ['area-fraction'],
  );
});

test('src may be parameters as JSON', () => {
  const { params, notices } = read({ src: '{ "preset": "conference-fig9a", "seed": 3, "layers": [{ "radius": 4 }] }', seed: '4' });
  assert.deepEqual([params, notices], [{ ...resolveParams({ preset: 'conference-fig9a', seed: 4, layers: [{ radius: 4 }] }) }, []]);
});

test('camera-orbit is azimuth, angle from above and distance, each perhaps auto', () => {
  const near = (a: number, b: number) => assert(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);
  const { orbit } = read({ 'camera-orbit': '-90deg 0.5rad 120%' });
  near(orbit!.azimuth!, -Math.PI / 2);
  near(orbit!.elevation!, Math.PI / 2 - 0.5);
  assert.deepEqual(orbit!.distance, { value: 120, unit: '%' });
  assert.deepEqual(read({ 'camera-orbit': 'auto auto 12m' }).orbit, { azimuth: null, elevation: null, distance: { value: 12, unit: 'm' } });
});

test('every row is either of the rocks or of the look, and an edit of it is of that alone', () => {
  for (const spec of PARAMS as readonly ParamSpec[]) {
    const [before, after] = [presetParams('riverbed'), presetParams('riverbed')];
    const [owner, old] = spec.scope === 'field' ? [after, before] : [after.layers[1]!, before.layers[1]!];
    const others = spec.kind === 'choice' ? spec.choices.map(({ value }) => value) : [spec.min, spec.max];
    writeValue(
      owner,
      spec,
      others.find((value) => value !== readValue(old, spec)),
    );
    const isSeen = spec.stage === 'look';
    assert.deepEqual([same(ROCKS, before, after, isMade), same(ROCKS, before, after, isLook)], [isSeen, !isSeen], spec.url);
    assert.equal(JSON.stringify(lookOf(before)) === JSON.stringify(lookOf(after)), !isSeen, spec.url);
    assert.notDeepEqual(encodeParams(before), encodeParams(after));
  }
});

test('layers of other ids, or another number, are other rocks', () => {
  const [one, other] = [defaultParams(), defaultParams()];
  other.layers[1]!.id = 9;
  assert.equal(same(ROCKS, one, other, isMade), false);
  assert.equal(same(ROCKS, one, { ...one, layers: one.layers.slice(1) }, isMade), false);
});

test('the look is every row of it, with the material of each layer by id', () => {
  const params = presetParams('lava-field');
  const { variation, wetness, moss, dust, snow, water, ground, sunAzimuth, sunElevation } = params;
  const place = (key: string, word: string) =>
    (PARAMS as readonly ParamSpec[]).find((row) => row.key === key)!.choices.findIndex(({ value }) => value === word);
  assert.deepEqual(lookOf(params), {
    variation,
    wetness,
    moss,
    dust,
    snow,
    water,
    ground: place('ground', ground),
    sunAzimuth,
    sunElevation,
    layers: params.layers.map(({ id }) => ({ id, material: place('material', 'basalt') })),
  });
});

test('an orbit looks at the middle of the field from where it says', () => {
  const framing = { azimuth: 0.5, elevation: 0.6, distance: 1000, target: [500, 520, 0] as [number, number, number] };
  const orbit = (text: string) => orbitCamera(framing, parseOrbit(text)!, [500, 500], 0.01);
  assert.deepEqual(orbit('auto auto auto'), framing);
  assert.deepEqual(orbit('auto auto 50%'), { ...framing, distance: 500 });
  assert.deepEqual(orbit('auto auto 3m').distance, 300);
  const { target, elevation } = orbit('1rad 90deg 100%');
  assert.deepEqual([target, elevation.toFixed(4)], [[500, 500, 0], ((5 * Math.PI) / 180).toFixed(4)]);
});

test('what a field shows is a sentence in the language of the page', () => {
  // A square cell of 100 px, selected, beside a larger one that is not.
  const cellVertices = Float32Array.of(0, 0, 100, 0, 100, 100, 0, 100, 0, 0, 300, 0, 300, 300, 0, 300);
  const layer = { cellStarts: Uint32Array.of(0, 4, 8), cellVertices, selected: Uint32Array.of(0) };
  const field = (rocks: number) =>
    ({ layers: [layer, layer, { ...layer, selected: new Uint32Array() }], stats: { rocks, coveredFraction: 0.844 } }) as unknown as Field;
  assert.equal(describeField(field(3100), 0.01, 'en'), '3,100 rocks in two sizes, largest 1.1 m, 84% covered');
  assert.equal(describeField(field(3100), 0.001, 'ja'), '2種類の大きさの岩3,100個、最大11 cm、被覆率84%');
  assert.equal(describeField(field(0), 0.01, 'en'), 'No rocks');
});

test('importing the element on a server is silent and defines nothing', async (t) => {
  const said = ['log', 'info', 'warn', 'error'].map((name) => t.mock.method(console, name as 'log', () => {}));
  const { RockFieldElement } = await import('../../www/entries/rock-field.ts');
  assert.equal(typeof RockFieldElement, 'function');
  for (const name of ATTRIBUTES) assert(RockFieldElement.observedAttributes.includes(name), name);
  assert.doesNotThrow(() => new RockFieldElement());
  assert(said.every(({ mock }) => mock.callCount() === 0));
  assert.equal((globalThis as { customElements?: unknown }).customElements, undefined);
});
