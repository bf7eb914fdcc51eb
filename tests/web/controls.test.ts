// What the panel computes: slider places, notations, random fields, the store.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createGenerator } from 'rock-field/core';
import { embedCode, panelAddress } from '../../www/controls/clipboard.ts';
import { inNotation } from '../../www/rocks/controls/notation.ts';
import { randomParams } from '../../www/rocks/controls/randomise.ts';
import { sliderScale } from '../../www/controls/slider-scale.ts';
import { ROCK_LATER } from '../../www/rocks/controls/deferred.ts';
import { RockStore } from '../../www/rocks/controls/store.ts';
import type { Edition } from '../../www/table/table.ts';
import type { Rocks } from '../../www/rocks/table.ts';
import { History } from '../../www/base/history.ts';
import { MAX_LAYERS, PARAMS, PRESETS } from '../../www/rocks/params.ts';
import type { Notation } from '../../www/table/row.ts';
import type { ParamSpec } from '../../www/rocks/spec.ts';
import type { Layer, Params } from '../../www/rocks/params.ts';
import { boundsOf, defaultParams, presetParams, resolveParams } from '../../www/rocks/request.ts';
import { decodeLink } from '../../www/rocks/link.ts';
import { hashField } from '../e2e/golden.mjs';

const SLIDERS: readonly ParamSpec[] = PARAMS.filter(({ kind, key }) => kind !== 'choice' && key !== 'seed');

function store(link = ''): RockStore {
  return new RockStore(decodeLink(link), { language: 'en', theme: 'auto' }, ROCK_LATER);
}

/** As `Params::layer_in_px` has it: the same operations in the same order. */
function inPx({ layers, notation, imageWidth }: Params): Layer[] {
  if (notation === 'px') return layers;
  const unit = imageWidth / 100;
  return layers.map((layer) => {
    const radius = layer.radius * unit;
    return {
      ...layer,
      radius,
      taper: layer.taper.map((c) => c * unit) as Layer['taper'],
      height: layer.height.map((c) => c * radius) as Layer['height'],
      detail: layer.detail / unit,
    };
  });
}

for (const spec of SLIDERS) {
  for (const notation of ['px', 'relative'] as const satisfies readonly Notation[]) {
    test(`${spec.url} in ${notation}: an arrow key gets from end to end of the slider, every step to another value`, () => {
      const { min, max, step, positionOf, valueAt } = sliderScale(boundsOf(spec, notation));
      const { slider } = boundsOf(spec, notation);
      assert.ok(Math.abs(valueAt(min, slider.max) - slider.min) < 1e-9 && Math.abs(valueAt(max, slider.min) - slider.max) < 1e-9);
      let value = slider.min;
      for (let presses = 0; value < slider.max; presses += 1) {
        assert.ok(presses < 3000, `stuck at ${value}`);
        // As the browser does it: the slider stands on its step nearest to the value.
        const at = min + Math.round((positionOf(value) - min) / step) * step;
        const next = valueAt(Math.min(max, Number((at + step).toFixed(6))), value);
        assert.ok(next > value, `${value} → ${next}`);
        value = next;
      }
    });
  }
}

test('logarithmic sliders stop at powers of two', () => {
  for (const spec of SLIDERS.filter(({ key }) => key === 'imageWidth' || key === 'radius')) {
    const { positionOf, valueAt } = sliderScale(spec);
    for (const value of [16, 32, 64, 128, 256, 512]) assert.equal(valueAt(Math.round(positionOf(value)), 0), value);
  }
});

test('another notation, the same rocks, to the last bit or the one before', () => {
  for (const { name } of PRESETS) {
    for (const imageWidth of [1024, 1000, 777, 4001]) {
      const params = { ...presetParams(name), imageWidth };
      const other = inNotation(params, params.notation === 'px' ? 'relative' : 'px');
      assert.equal(other.clamped, false);
      resolveParams(other.params);
      for (const [index, layer] of inPx(other.params).entries()) {
        const original = inPx(params)[index];
        assert.ok(original);
        const numbers = ({ radius, taper, height, detail }: Layer) => [radius, ...taper, ...height, detail];
        numbers(layer).forEach((value, at) => {
          const wanted = numbers(original)[at] ?? NaN;
          assert.ok(Math.abs(value - wanted) <= Math.abs(wanted) * 4e-16, `${name} ${imageWidth}: ${value} for ${wanted}`);
        });
      }
    }
  }
  assert.deepEqual(inNotation(inNotation(defaultParams(), 'relative').params, 'px').params, defaultParams());
});

test('the generator makes the same field of a conference figure and of what the panel turns it into', async () => {
  const generator = await createGenerator();
  const relative = PRESETS.map(({ name }) => presetParams(name)).filter(({ notation }) => notation === 'relative');
  assert.ok(relative.length > 0);
  for (const params of relative) {
    const small = { ...params, imageWidth: 211, imageHeight: 150 };
    const moved = inNotation(small, 'px');
    assert.equal(moved.clamped, false);
    // In Rust that is `Params::layer_in_px`.
    const [wanted, found] = [await generator.generate(small), await generator.generate(moved.params)];
    assert.equal(await hashField(found), await hashField(wanted));
    assert.deepEqual(
      found.layers.map(({ radius }) => radius),
      wanted.layers.map(({ radius }) => radius),
    );
  }
  generator.dispose();
});

test('a notation in which a value has no room says so', () => {
  const params = presetParams('conference-fig1');
  params.layers[0]!.height[0] = 400;
  const { params: moved, clamped } = inNotation(params, 'px');
  assert.ok(clamped);
  resolveParams(moved);
});

test('random fields are legal, and bounded in number', () => {
  for (let seed = 0; seed < 500; seed += 1) {
    for (const base of [
      defaultParams(),
      presetParams('conference-fig1'),
      { ...defaultParams(), imageWidth: 8192, imageHeight: 8192 },
      { ...defaultParams(), imageWidth: 1, imageHeight: 16 },
    ]) {
      const params = randomParams(base, { seed: seed * 8_589_934, preset: 'journal-fig1' });
      assert.deepEqual(resolveParams(params), params);
      assert.ok(params.layers.length >= 1 && params.layers.length <= 4);
      const [width, height] = [base.imageWidth, base.imageHeight];
      for (const { radius } of inPx(params)) assert.ok((width * height) / (radius * radius) < 60_000);
    }
  }
});

test('a random field keeps the wear and the look of what it was drawn from', () => {
  const base = presetParams('lava-field');
  for (const [preset, seed] of (['lava-field', 'journal-fig1'] as const).flatMap((name) =>
    Array.from({ length: 25 }, (_, index) => [name, index] as const),
  )) {
    const { layers, ...field } = randomParams(base, { seed, preset });
    assert.deepEqual([field.border, field.ground, field.sunElevation], [base.border, base.ground, base.sunElevation]);
    for (const [index, { material, weathering, detail, cellCount }] of layers.entries()) {
      const like = base.layers[index]!;
      assert.deepEqual([material, weathering, detail, cellCount], [like.material, like.weathering, like.detail, null]);
    }
  }
});

test('layers come and go, with ids that are never taken over', async () => {
  const page = store();
  page.removeItem(1);
  page.duplicateLayer(0);
  assert.deepEqual(
    page.params.layers.map(({ id }) => id),
    [0, 3, 2],
  );
  while (page.params.layers.length < MAX_LAYERS) await page.addLayer();
  await page.addLayer();
  page.duplicateLayer(0);
  assert.equal(page.params.layers.length, MAX_LAYERS);
  assert.equal(new Set(page.params.layers.map(({ id }) => id)).size, MAX_LAYERS);
  resolveParams(page.params);
  for (let index = 0; index < MAX_LAYERS; index += 1) page.removeItem(0);
  assert.deepEqual(page.params.layers, []);
  await page.addLayer();
  resolveParams(page.params);
});

test('a layer that is added is worn like the last, and of its stone', async () => {
  const page = store('#preset=lava-field&r=60,20');
  await page.addLayer();
  const [, last, added] = page.params.layers;
  assert.deepEqual([added!.weathering, added!.roughness, added!.material], [last!.weathering, last!.roughness, last!.material]);
  assert.ok(added!.radius < last!.radius);
});

test('the seed goes round, a preset and reset keep it', () => {
  const page = store('#seed=0');
  page.setSeed(-1);
  assert.equal(page.params.seed, 4_294_967_295);
  page.setSeed(4_294_967_296);
  assert.equal(page.params.seed, 0);
  page.setSeed(5);
  page.choosePreset('journal-fig12a');
  assert.deepEqual(page.params, { ...presetParams('journal-fig12a'), seed: 5 });
  page.reset();
  assert.deepEqual(page.params, { ...presetParams('journal-fig12a'), seed: 5 });
});

test('the colour follows the preset until one is chosen that is not its own', () => {
  const page = store('#preset=riverbed');
  assert.equal(page.color, 'natural');
  page.choosePreset('journal-fig1');
  assert.equal(page.color, 'layer');
  page.setColor('layer');
  page.undo();
  assert.equal(page.color, 'natural', "the preset's own is no choice");
  page.setColor('plain');
  page.choosePreset('scree');
  assert.equal(page.color, 'plain');
  page.setColor('natural');
  page.choosePreset('journal-fig12a');
  assert.equal(page.color, 'layer');
});

test('the same value again is no step of undo', () => {
  const page = store('#seed=4');
  page.setSeed(4);
  page.setParam(SLIDERS.find(({ key }) => key === 'packing')!, null, page.params.packing);
  page.choosePreset(page.preset);
  assert.equal(page.canUndo, false);
});

test('the embed code is safe HTML', () => {
  const code = embedCode('rock-field', 'v=1&preset=journal-fig1&seed=3', 'https://example.org/rocks/?x="><script>#seed=1');
  assert.match(code, /<script async crossorigin src="https:\/\/example\.org\/rocks\/cdn\.js"><\/script>/);
  assert.match(code, /src="#v=1&amp;preset=journal-fig1&amp;seed=3"/);
});

test('a script to embed is known beside the panel on a server, and nowhere that a bundler put it', () => {
  assert.match(
    embedCode('rock-field', '', panelAddress('https://example.org/a/panel-7GQ2XW3B.js')!),
    /"https:\/\/example\.org\/a\/cdn\.js"/,
  );
  for (const address of [
    'https://example.org/assets/panel-7GQ2XW3B-a1b2.js',
    'file:///home/me/node_modules/rock-field/dist/panel-7GQ2XW3B.js',
  ])
    assert.equal(panelAddress(address), null);
});

test('a store on the history of an element makes its steps there, and sees those of others', () => {
  const link = decodeLink('seed=1');
  const history = new History<Edition<Rocks>>({ params: link.params, preset: link.preset });
  const shared = new RockStore(link, { language: 'en', theme: 'auto' }, ROCK_LATER, history);
  shared.setSeed(2);
  history.record({ params: { ...history.present.params, seed: 3 }, preset: link.preset });
  assert.equal(shared.params.seed, 3);
  shared.undo();
  assert.equal(history.present.params.seed, 2);
  assert.ok(history.undo());
  assert.deepEqual([shared.canUndo, shared.params.seed], [false, 1]);
});
