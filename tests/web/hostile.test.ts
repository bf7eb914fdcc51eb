// Values from code that are nothing anybody expects: each is refused by an error of ours that names it, and nothing has changed.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createGenerator, createWoodEarGenerator, generate, growWoodEar } from 'rock-field/core';
import { checkChoice } from '../../www/element/attribute-reader.ts';
import { checkCamera } from '../../www/table/camera-bounds.ts';
import { parseOrbit } from '../../www/scene/camera/orbit.ts';
import { readAttributes } from '../../www/rocks/attributes.ts';
import { ERRORS } from '../../www/base/error-list.ts';
import { errorInfo } from '../../www/base/errors.ts';
import type { RockFieldError } from '../../www/base/errors.ts';
import { LAYER_ROWS, presetParams, resolveParams } from '../../www/rocks/request.ts';
import { errorText } from '../../www/controls/strings-later.ts';
import type { Params } from '../../www/rocks/params.ts';
import { RowProperties } from '../../www/element/parameter-properties.ts';
import { writeAttribute } from '../../www/element/reflected-properties.ts';
import { ROCKS } from '../../www/rocks/table.ts';
import { readWoodEarAttributes } from '../../www/wood-ear/attributes.ts';
import { WOOD_EARS } from '../../www/wood-ear/table.ts';

const throwing = {
  toString() {
    throw new Error('no text');
  },
  toJSON() {
    throw new Error('no JSON');
  },
};
const circular: Record<string, unknown> = {};
circular['self'] = circular;
const NOTHING_EXPECTED: readonly unknown[] = [
  Object.create(null),
  throwing,
  circular,
  Symbol('s'),
  10n,
  () => 1,
  /x/,
  new Date(NaN),
  new Map(),
  Object.create(null, {
    seed: {
      get() {
        return 1;
      },
    },
  }),
];

const isOurs = (thrown: unknown): boolean => {
  // By its names: the built package has a class of its own.
  assert.ok(thrown instanceof Error && 'key' in thrown && thrown.name in ERRORS, String((thrown as Error)?.stack ?? typeof thrown));
  assert.ok(thrown.message.length < 200 && !/undefined of|\[object/.test(thrown.message), thrown.message);
  for (const language of ['en', 'ja'] as const) assert.equal(typeof errorText(language, errorInfo(thrown)), 'string');
  return true;
};

test('no value of a parameter makes anything but an error of ours', () => {
  for (const value of NOTHING_EXPECTED) {
    for (const key of Object.keys(presetParams('riverbed'))) assert.throws(() => resolveParams({ [key]: value }), isOurs, key);
    for (const key of LAYER_ROWS.map((row) => row.key)) assert.throws(() => resolveParams({ layers: [{ [key]: value }] }), isOurs, key);
    for (const key of Object.keys(WOOD_EARS.presetParams('fallen-log')).filter((name) => name !== 'mesh')) {
      if (key === 'log' && Object.keys(Object(value)).length === 0) continue; // an empty log is the preset's
      assert.throws(() => WOOD_EARS.resolve({ [key]: value }), isOurs, key);
    }
    for (const key of ['position', 'range']) assert.throws(() => WOOD_EARS.resolve({ bases: [{ [key]: value } as object] }), isOurs, key);
    assert.throws(() => checkChoice('view', value as string, ['3d']), isOurs);
    assert.throws(() => checkCamera(value), isOurs);
    assert.throws(() => checkCamera({ azimuth: 0, elevation: 0, distance: value, target: [0, 0, 0] }), isOurs);
  }
  for (const value of [Object.create(null), throwing]) assert.throws(() => writeAttribute({} as HTMLElement, 'src', value), isOurs);
});

test('holes in a list are what is missing, and are named', () => {
  const isHole = ({ name, layer }: RockFieldError) => name === 'WrongType' && layer === 0;
  assert.throws(() => resolveParams({ layers: new Array(3) }), isHole);
  assert.throws(() => WOOD_EARS.resolve({ bases: new Array(3) }), isHole);
  assert.throws(() => resolveParams({ layers: [{ taper: new Array(3) as [number, number, number] }] }), isHole);
  assert.throws(() => WOOD_EARS.resolve({ bases: [{ position: new Array(3) as [number, number, number] }] }), isHole);
  assert.throws(() => resolveParams({ layers: new Array(4e9) }), { name: 'TooManyLayers' });
});

test('what is missing is called missing', () => {
  assert.throws(() => WOOD_EARS.resolve({ log: { positions: [] } as never }), {
    name: 'WrongType',
    message: /^indices\b.* is missing; it must be a list/,
  });
  assert.throws(() => resolveParams({ layers: [{ taper: new Array(3) as [number, number, number] }] }), {
    name: 'WrongType',
    message: /is missing; it must be a number$/,
  });
});

test('typed arrays are lists of numbers', () => {
  const taper = Float32Array.of(1, 2, 3) as unknown as [number, number, number];
  assert.deepEqual(resolveParams({ layers: [{ taper }] }).layers[0]?.taper, [1, 2, 3]);
  const position = Float64Array.of(1, 2, 30) as unknown as [number, number, number];
  assert.deepEqual(WOOD_EARS.resolve({ bases: [{ position }] }).bases[0]?.position, [1, 2, 30]);
  assert.deepEqual(checkCamera({ azimuth: 0, elevation: 1, distance: 9, target: Float32Array.of(1, 2, 3) }), {
    azimuth: 0,
    elevation: 1,
    distance: 9,
    target: [1, 2, 3],
  });
  assert.throws(() => resolveParams({ layers: [{ taper: new DataView(new ArrayBuffer(3)) as never }] }), { name: 'WrongType' });
  assert.throws(() => resolveParams({ layers: [{ taper: BigInt64Array.of(1n, 2n, 3n) as never }] }), { name: 'WrongType' });
});

test('a property of an element that is a list takes typed arrays, and holds numbers', () => {
  const properties = new RowProperties(ROCKS, ROCKS.itemRows);
  const element = { params: presetParams('journal-fig1') } as unknown as HTMLElement & {
    params: Params;
    radius: unknown;
    taperRock: unknown;
  };
  properties.define(element);
  element.radius = Float32Array.of(40, 20);
  element.taperRock = Uint8Array.of(1, 2);
  assert.deepEqual(
    element.params.layers.map(({ radius, taper }) => [radius, taper[1]]),
    [
      [40, 1],
      [20, 2],
    ],
  );
  assert.deepEqual(
    [element.radius, element.taperRock],
    [
      [40, 20],
      [1, 2],
    ],
  );
  assert.throws(() => (element.radius = new DataView(new ArrayBuffer(8))), { name: 'WrongType', key: 'radius' });
  assert.deepEqual(element.radius, [40, 20]);
});

test('options of both generators name themselves, and nothing runs', async () => {
  const [rocks, ears] = [await createGenerator(), await createWoodEarGenerator()];
  const small = { imageWidth: 64, imageHeight: 64 };
  for (const [key, value] of [
    ['signal', 5],
    ['signal', null],
    ['signal', {}],
    ['onProgress', 5],
    ['onProgress', 'x'],
    ['maxBytes', NaN],
    ['maxBytes', -1],
    ['maxBytes', '9'],
    ['maxBytes', Object.create(null)],
  ] as const) {
    const options = { [key]: value };
    for (const run of [
      () => rocks.generate(small, options),
      () => generate(small, options),
      () => ears.generate({}, options),
      () => growWoodEar({}, options),
    ]) {
      await assert.rejects(run, (thrown: RockFieldError) => isOurs(thrown) && thrown.key === key, `${key} ${typeof value}`);
    }
  }
  for (const options of [null, 5, 'x', []])
    await assert.rejects(rocks.generate(small, options as never), { name: 'WrongType', key: 'options' });
  assert.ok((await rocks.generate(small, { maxBytes: Infinity })).stats.rocks >= 0);
  rocks.dispose();
  ears.dispose();
});

test('a camera from code is whole and within its bounds', () => {
  const good = { azimuth: 0.5, elevation: 0.6, distance: 900, target: [1, 2, 3] };
  assert.deepEqual(checkCamera(good), good);
  assert.equal(checkCamera(null), null);
  assert.equal(checkCamera(undefined), null);
  const wrong: [string, object][] = [
    ['target', { azimuth: 0 }],
    ['azimuth', { ...good, azimuth: undefined }],
    ['azimuth', { ...good, azimuth: NaN }],
    ['elevation', { ...good, elevation: Infinity }],
    ['distance', { ...good, distance: -5 }],
    ['distance', { ...good, distance: 0 }],
    ['distance', { ...good, distance: 1e9 }],
    ['distance', { ...good, distance: '9' }],
    ['target', { ...good, target: [1, 2] }],
    ['target', { ...good, target: [1, NaN, 3] }],
    ['target', { ...good, target: new Array(3) }],
    ['camera', []],
  ];
  for (const [key, camera] of wrong)
    assert.throws(
      () => checkCamera(camera),
      (thrown: RockFieldError) => isOurs(thrown) && thrown.key === key,
      JSON.stringify(camera),
    );
  assert.throws(() => checkCamera({ ...good, distance: -5 }), { name: 'OutOfRange', value: -5, min: 0.1, max: 1e6 });
});

test('an orbit of 310 digits is none', () => {
  const digits = '1'.repeat(310);
  for (const orbit of [
    `${digits}deg auto auto`,
    `auto ${digits}rad auto`,
    `auto auto ${digits}px`,
    `auto auto ${digits}%`,
    `${'1'.repeat(30)}deg auto auto`,
  ]) {
    assert.equal(parseOrbit(orbit), null);
    const { notices } = readAttributes((name) => (name === 'camera-orbit' ? orbit : null));
    assert.deepEqual(
      notices.map(({ attribute }) => attribute),
      ['camera-orbit'],
    );
  }
  assert.ok(parseOrbit('45deg 55deg 120%') && parseOrbit('-720deg auto 3m'));
});

test("an attribute of layers without one readable value leaves the preset's own layers, with one notice", () => {
  for (const preset of ['journal-fig1', 'riverbed'] as const) {
    for (const [name, value] of [
      ['radius', 'foo'],
      ['radius', ''],
      ['area-fraction', 'x y'],
      ['material', 'cheese'],
      ['taper-base', 'NaN'],
      ['cell-count', 'none'],
    ]) {
      const { params, notices } = readAttributes((attribute) => ({ preset, [name!]: value! })[attribute] ?? null);
      if (value === '') continue; // none at all
      assert.deepEqual(params, presetParams(preset), `${name}="${value}"`);
      assert.deepEqual(
        notices.map(({ attribute }) => attribute),
        [name],
      );
    }
  }
});

test('JSON in src that is wrong leaves the preset it names, with one notice', () => {
  for (const src of [
    '{"preset":"moraine","layers":[{"radius":"foo"}]}',
    '{"preset":"moraine","seed":-1}',
    '{"preset":"moraine","packing":{"toString":1}}',
    '{"preset":"moraine","layers":[null]}',
  ]) {
    const { params, preset, notices } = readAttributes((name) => (name === 'src' ? src : null));
    assert.deepEqual([params, preset], [presetParams('moraine'), 'moraine'], src);
    assert.equal(notices.length, 1);
    assert.match(notices[0]!.message, /showing moraine$/);
  }
  const log = readWoodEarAttributes((name) => (name === 'src' ? '{"preset":"wet-colony","moisture":"foo"}' : null));
  assert.deepEqual([log.params, log.preset, log.notices.length], [WOOD_EARS.presetParams('wet-colony'), 'wet-colony', 1]);
  for (const src of ['{', '{"preset":5}', '{"preset":"nope"}'])
    assert.deepEqual(readAttributes((name) => (name === 'src' ? src : null)).params, presetParams('journal-fig1'));
});
