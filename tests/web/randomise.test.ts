// Randomise: near a natural preset, with at most twice its triangles, as the generators themselves count them; what is locked stays.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createGenerator, createWoodEarGenerator } from 'rock-field/core';
import { randomParams } from '../../www/rocks/controls/randomise.ts';
import { randomWoodEars } from '../../www/wood-ear/controls/randomise.ts';
import { ROCK_LATER } from '../../www/rocks/controls/deferred.ts';
import { RockStore } from '../../www/rocks/controls/store.ts';
import { PRESETS } from '../../www/rocks/params.ts';
import type { Preset } from '../../www/rocks/spec.ts';
import type { Params, PresetName } from '../../www/rocks/params.ts';
import { presetParams, resolveParams } from '../../www/rocks/request.ts';
import { decodeLink } from '../../www/rocks/link.ts';
import { colonyRequest, WOOD_EARS } from '../../www/wood-ear/table.ts';
import { WOOD_EAR_PRESETS } from '../../www/wood-ear/params.gen.ts';

const SEEDS = [1, 2, 3, 5, 8, 13, 21, 34];
const NATURAL = (PRESETS as readonly Preset[]).filter(({ natural }) => natural).map(({ name }) => name);
const NATURAL_WOOD_EARS = WOOD_EAR_PRESETS.filter((preset) => 'natural' in preset).map(({ name }) => name);

/** Where there is little of anything, a single large rock or wood ear more is much. */
function areNear(ratios: number[], name: string): void {
  const sorted = [...ratios].sort((a, b) => a - b);
  assert.ok(sorted[0]! > 0.4 && sorted.at(-1)! < 2, `${name}: ${sorted.map((ratio) => ratio.toFixed(2)).join(' ')}`);
  assert.ok(sorted.at(-1)! - sorted[0]! > 0.2, `${name}: always the same`);
}

test('every natural ground is varied around itself: again and again no farther away, with at most twice its triangles', async () => {
  const generator = await createGenerator();
  for (const name of NATURAL) {
    // A part of it; with all of it this takes minutes.
    const own = { ...presetParams(name), imageWidth: 240, imageHeight: 240 };
    const { triangles } = (await generator.generate(own)).stats;
    let params: Params = own;
    const ratios: number[] = [];
    for (const seed of SEEDS) {
      params = randomParams(params, { seed, preset: name });
      assert.deepEqual(resolveParams(params), params);
      assert.equal(params.layers.length, own.layers.length);
      ratios.push((await generator.generate(params)).stats.triangles / triangles);
    }
    areNear(ratios, name);
  }
  generator.dispose();
});

test('every natural colony is varied around itself: again and again no farther away, with at most twice its triangles', async () => {
  const generator = await createWoodEarGenerator();
  for (const name of NATURAL_WOOD_EARS) {
    const own = WOOD_EARS.presetParams(name);
    // Collisions change no triangle.
    const count = async (params: typeof own) => (await generator.generate({ ...colonyRequest(params), collisions: 'off' })).stats.triangles;
    const triangles = await count(own);
    let params = own;
    const ratios: number[] = [];
    for (const seed of SEEDS.slice(0, 5)) {
      params = randomWoodEars(params, { seed, preset: name });
      assert.deepEqual(WOOD_EARS.resolve(params), params);
      assert.deepEqual([params.ground, params.bases, params.log, params.collisions], [own.ground, own.bases, own.log, own.collisions]);
      ratios.push((await count(params)) / triangles);
    }
    areNear(ratios, name);
  }
  generator.dispose();
});

test('a natural ground is varied alike in the other notation', () => {
  for (const seed of SEEDS) {
    const [px, relative] = (['px', 'relative'] as const).map((notation) =>
      randomParams({ ...presetParams('moraine'), notation }, { seed, preset: 'moraine' }),
    );
    const unit = px!.imageWidth / 100;
    for (const [k, layer] of px!.layers.entries()) {
      const other = relative!.layers[k]!;
      assert.ok(
        Math.abs((other.radius * unit) / layer.radius - 1) < 0.08 &&
          Math.abs((other.height[0] * other.radius * unit) / layer.height[0] - 1) < 0.2,
        `${seed} ${k}: ${other.radius * unit} ${layer.radius} ${other.height[0] * other.radius * unit} ${layer.height[0]}`,
      );
    }
  }
});

for (const preset of ['moraine', 'journal-fig1'] as const satisfies readonly PresetName[]) {
  test(`${preset}: a locked radius is kept, and heights and tapers go with it`, () => {
    const own = {
      ...presetParams(preset),
      layers: [
        { ...presetParams(preset).layers[0]!, radius: 17 },
        { ...presetParams(preset).layers[1]!, radius: 5 },
      ],
    };
    for (const seed of SEEDS) {
      const { layers } = randomParams(own, { seed, preset, lock: ['radius'] });
      assert.deepEqual(
        layers.map(({ radius }) => radius),
        [17, 5],
      );
      for (const { radius, height } of layers)
        assert.ok(height[0] + height[1] + height[2] < 2 * radius, `no stalagmites: ${height} on ${radius}`);
    }
  });

  test(`${preset}: with the lock beside the radius, Randomise keeps height and taper`, async () => {
    const store = new RockStore(decodeLink(`#preset=${preset}`), { language: 'en', theme: 'auto' }, ROCK_LATER);
    const shapes = () => store.params.layers.map(({ taper, height }) => [taper, height]);
    const before = shapes();
    const random = async (...given: Parameters<typeof randomParams>) => randomParams(...given);
    store.setKeepsShape(true);
    for (const seed of SEEDS) {
      await store.randomise(random, seed);
      assert.deepEqual(shapes().slice(0, before.length), before.slice(0, shapes().length));
      store.undo();
    }
    store.setKeepsShape(false);
    await store.randomise(random, 4);
    assert.notDeepEqual(shapes(), before);
  });
}
