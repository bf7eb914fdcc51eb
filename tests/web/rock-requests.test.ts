import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import { MAX_LAYERS, PARAMS, PRESETS } from '../../www/rocks/params.ts';
import type { ParamSpec } from '../../www/rocks/spec.ts';
import type { Params } from '../../www/rocks/params.ts';
import {
  boundsOf,
  copyParams,
  defaultLayer,
  defaultParams,
  encodeParams,
  FIELD_ROWS,
  LAYER_ROWS,
  presetParams,
  readValue,
  resolveParams,
  writeValue,
} from '../../www/rocks/request.ts';
import { clampParams } from '../../www/rocks/controls/clamp.ts';

const NOTATIONS = ['px', 'relative'] as const;

/** Legal values of a row: both ends, the default, every word of a choice, none. */
function legalValues(spec: ParamSpec, notation: 'px' | 'relative'): unknown[] {
  if (spec.kind === 'choice') return spec.choices.map(({ value }) => value);
  const { min, max, default: fallback } = boundsOf(spec, notation);
  return [min, max, fallback, ...(spec.kind === 'optional-integer' ? [null] : [])];
}

function paramsIn(notation: 'px' | 'relative'): Params {
  return presetParams(notation === 'px' ? 'journal-fig1' : 'conference-fig1');
}

/** The position of a row of layer `k` (or of the field) in the flat list, by its documented formula. */
function position(spec: ParamSpec, k: number): number {
  if (spec.scope === 'field') return FIELD_ROWS.indexOf(spec);
  return FIELD_ROWS.length + 1 + k * (LAYER_ROWS.length + 1) + 1 + LAYER_ROWS.indexOf(spec);
}

function asFlat(spec: ParamSpec, value: unknown): number {
  if (spec.kind === 'choice') return spec.choices.findIndex((choice) => choice.value === value);
  return value === null ? NaN : (value as number);
}

/** The error's fields, or a failure when nothing is thrown. */
function errorOf(request: unknown): RockFieldError {
  try {
    resolveParams(request as Params);
  } catch (error) {
    assert(error instanceof RockFieldError, `${String(error)} is no RockFieldError`);
    return error;
  }
  return assert.fail(`accepted ${JSON.stringify(request)}`);
}

test('every legal value of every row survives a request and stands in its place of the flat list', () => {
  for (const notation of NOTATIONS) {
    for (const spec of PARAMS as readonly ParamSpec[]) {
      for (const value of legalValues(spec, notation)) {
        const params = paramsIn(spec.key === 'notation' ? (value as 'px') : notation);
        const k = spec.scope === 'layer' ? 1 : 0;
        const owner = spec.scope === 'layer' ? params.layers[k]! : params;
        writeValue(owner, spec, value);
        const resolved = resolveParams(params);
        assert.deepEqual(resolved, params, `${spec.url}=${String(value)}`);
        assert.equal(encodeParams(resolved)[position(spec, k)], asFlat(spec, value), `${spec.url}=${String(value)}`);
      }
    }
  }
});

test('the flat list is the field rows, the number of layers, then id and rows of each layer', () => {
  const flat = encodeParams({ ...defaultParams(), seed: 7, layers: [defaultLayer(5, 'px')] });
  assert.equal(flat.length, FIELD_ROWS.length + 1 + 1 + LAYER_ROWS.length);
  assert.equal(flat[0], 7);
  assert.equal(flat[FIELD_ROWS.length], 1);
  assert.equal(flat[FIELD_ROWS.length + 1], 5);
  const layer = [...flat.slice(FIELD_ROWS.length + 2)];
  assert.deepEqual(layer.slice(0, 9), [30, 0.25, NaN, 0, 6, 2, 5, 5, 3]);
  assert(
    layer.slice(9).every((value) => value === 0),
    'wear that no paper has',
  );
});

test('a value just outside its bounds, NaN or not whole is refused with key, value and bounds', () => {
  for (const notation of NOTATIONS) {
    for (const spec of PARAMS as readonly ParamSpec[]) {
      if (spec.kind === 'choice') continue;
      const { min, max } = boundsOf(spec, notation);
      const bad: [number, string][] = [
        [min - 1, 'OutOfRange'],
        [max + 1, 'OutOfRange'],
        [NaN, 'OutOfRange'],
        [Infinity, 'OutOfRange'],
      ];
      if (spec.kind !== 'real') bad.push([min + 0.5, 'NotAnInteger']);
      for (const [value, name] of bad) {
        const params = paramsIn(notation);
        writeValue(spec.scope === 'layer' ? params.layers[2]! : params, spec, value);
        const error = errorOf(params);
        const layer = spec.scope === 'layer' ? 2 : undefined;
        assert.deepEqual({ ...error }, { name, key: spec.key, layer, value, min, max, words: undefined });
        assert.match(error.message, new RegExp(spec.key));
        assert.match(error.message, new RegExp(String(value).replace(/[.+]/g, '\\$&')));
      }
    }
  }
});

test('a choice of a layer is a word of the table, in a request as in clamping', () => {
  const error = errorOf({ layers: [{}, { material: 'cheese' }] });
  assert.deepEqual([error.name, error.key, error.layer, error.value], ['OutOfRange', 'material', 1, 'cheese']);
  assert.match(error.message, /granite or basalt/);
  assert.equal(errorOf({ layers: [{ material: 1 }] }).name, 'WrongType');
  assert.equal(resolveParams({ layers: [{ material: 'slate' }] }).layers[0]!.material, 'slate');
  const params = presetParams('lava-field');
  params.layers[1]!.material = 'cheese' as 'slate';
  const { params: clamped, changes } = clampParams(params);
  assert.deepEqual(changes, [{ key: 'material', layer: 1, component: null, from: 'cheese', to: 'mixed' }]);
  assert.deepEqual(
    clamped.layers.map(({ material }) => material),
    params.layers.map((_, index) => (index === 1 ? 'mixed' : 'basalt')),
  );
});

test('a natural preset is worn, and has what it says of the field', () => {
  for (const preset of PRESETS.filter((candidate) => 'natural' in candidate)) {
    const { layers, ...field } = presetParams(preset.name);
    assert(
      layers.some(({ weathering, detail }) => weathering > 0 && detail > 0),
      preset.name,
    );
    for (const [key, value] of Object.entries(preset.fields))
      assert.equal(field[key as keyof typeof field], value, `${preset.name} ${key}`);
  }
});

test('what is no value of the parameter at all is refused by name', () => {
  assert.equal(errorOf({ seed: '7' }).name, 'WrongType');
  assert.equal(errorOf({ border: 3 }).name, 'WrongType');
  assert.deepEqual([errorOf({ border: 'wrap' }).name, errorOf({ border: 'wrap' }).key], ['OutOfRange', 'border']);
  assert.deepEqual([errorOf({ sead: 1 }).name, errorOf({ sead: 1 }).key], ['UnknownKey', 'sead']);
  assert.deepEqual([errorOf({ layers: [{ radios: 1 }] }).name, errorOf({ layers: [{ radios: 1 }] }).layer], ['UnknownKey', 0]);
  assert.equal(errorOf({ layers: 3 }).name, 'WrongType');
  assert.equal(errorOf({ layers: [null] }).name, 'WrongType');
  assert.equal(errorOf({ layers: [{ taper: 3 }] }).name, 'WrongType');
  assert.equal(errorOf({ layers: [{ height: [1, 2] }] }).name, 'WrongType');
  assert.equal(errorOf({ preset: 'nobody' }).name, 'UnknownPreset');
  assert.equal(errorOf({ preset: 3 }).name, 'WrongType');
  assert.equal(errorOf(null).name, 'MalformedRequest');
  assert.equal(errorOf([]).name, 'MalformedRequest');
  assert.equal(errorOf('journal-fig1').name, 'MalformedRequest');
  const tooMany = errorOf({ layers: Array.from({ length: MAX_LAYERS + 1 }, () => ({})) });
  assert.deepEqual([tooMany.name, tooMany.value, tooMany.max], ['TooManyLayers', MAX_LAYERS + 1, MAX_LAYERS]);
  assert.deepEqual(
    [errorOf({ layers: [{ id: 3 }, { id: 3 }] }).name, errorOf({ layers: [{ id: 3 }, { id: 3 }] }).value],
    ['DuplicateLayerId', 3],
  );
  assert.equal(errorOf({ layers: [{}, { id: 0 }] }).name, 'DuplicateLayerId');
});

test('keys inherited from a prototype, and hostile ones, are no parameters', () => {
  assert.equal(errorOf(JSON.parse('{"__proto__": {"seed": 1}}')).key, '__proto__');
  assert.equal(errorOf({ constructor: 1 }).key, 'constructor');
  assert.equal(resolveParams(Object.create({ seed: 5 })).seed, 0);
});

test('a preset fills everything and each key given replaces it', () => {
  const params = resolveParams({ preset: 'conference-fig11c', seed: 42, imageWidth: 300 });
  assert.deepEqual(params, { ...presetParams('conference-fig11c'), seed: 42, imageWidth: 300 });
  assert.deepEqual(resolveParams(), defaultParams());
  assert.deepEqual(resolveParams({ seed: undefined }), defaultParams());
});

test('layers replace the whole list, with the defaults of the notation in force for what is missing', () => {
  for (const [preset, notation] of [
    ['journal-fig1', 'px'],
    ['conference-fig1', 'relative'],
  ] as const) {
    const { layers } = resolveParams({ preset, layers: [{ radius: 12 }, { id: 9, cellCount: 4 }] });
    assert.deepEqual(layers, [
      { ...defaultLayer(0, notation), radius: 12 },
      { ...defaultLayer(9, notation), cellCount: 4 },
    ]);
  }
  assert.deepEqual(resolveParams({ layers: [] }).layers, []);
});

test('neither request nor preset shares anything with the result', () => {
  const request = { layers: [{ taper: [1, 2, 3] as [number, number, number] }] };
  const params = resolveParams(request);
  params.layers[0]!.taper[0] = 99;
  assert.equal(request.layers[0]!.taper[0], 1);
  defaultParams().layers[0]!.height[0] = 99;
  assert.equal(defaultParams().layers[0]!.height[0], 14);
});

test('all presets are legal and say what the papers print', () => {
  const data = JSON.parse(readFileSync(new URL('../data/presets.json', import.meta.url), 'utf8'));
  let checked = 0;
  for (const { presets } of Object.values(data) as { presets: Record<string, Record<string, number[]>> }[]) {
    for (const [figure, row] of Object.entries(presets)) {
      const found = PRESETS.map(({ name }) => presetParams(name)).find(
        ({ layers }, index) =>
          PRESETS[index]!.name.endsWith(`-${figure}`) &&
          layers.every(({ radius }, k) => radius === row['r']![k]) &&
          layers.length === row['r']!.length,
      );
      assert(found, figure);
      assert.deepEqual(resolveParams(found), found);
      assert.deepEqual(
        found.layers.map(({ areaFraction }) => areaFraction),
        row['A_s'],
      );
      for (const [part, index] of [
        ['1', 0],
        ['2', 1],
        ['3', 2],
      ] as const) {
        assert.deepEqual(
          found.layers.map(({ taper }) => taper[index]),
          row[`c_w${part}`],
        );
        assert.deepEqual(
          found.layers.map(({ height }) => height[index]),
          row[`c_h${part}`],
        );
      }
      checked += 1;
    }
  }
  assert.equal(checked, PRESETS.filter((preset) => !('natural' in preset)).length);
});

test('clamping leaves legal parameters alone and says so', () => {
  for (const { name } of PRESETS) {
    const { params, changes } = clampParams(presetParams(name));
    assert.deepEqual(params, presetParams(name));
    assert.deepEqual(changes, []);
  }
});

test('clamping moves every number into its bounds, whatever it was, and lists it', () => {
  for (const notation of NOTATIONS) {
    for (const spec of PARAMS as readonly ParamSpec[]) {
      for (const wrong of [-1e12, 1e12, NaN, Infinity, undefined, 'text', {}]) {
        const params = copyParams(paramsIn(notation));
        writeValue(spec.scope === 'layer' ? params.layers[1]! : params, spec, wrong);
        const { params: clamped, changes } = clampParams(params);
        assert.deepEqual(resolveParams(clamped), clamped, `${spec.url}=${String(wrong)}`);
        const change = changes.find(({ key, component }) => key === spec.key && component === spec.component);
        assert(change && Object.is(change.from, wrong), `${spec.url}=${String(wrong)} is not listed`);
        assert.deepEqual(readValue(spec.scope === 'layer' ? clamped.layers[1]! : clamped, spec), change.to);
      }
    }
  }
});

test('clamping makes surplus layers, repeated ids and missing lists legal', () => {
  const many = { ...defaultParams(), layers: Array.from({ length: MAX_LAYERS + 3 }, () => defaultLayer(2, 'px')) };
  const { params, changes } = clampParams(many);
  assert.deepEqual(
    params.layers.map(({ id }) => id),
    [2, 0, 1, 3, 4, 5, 6, 7],
  );
  assert(changes.some(({ key, from, to }) => key === 'layers' && from === MAX_LAYERS + 3 && to === MAX_LAYERS));
  assert.deepEqual(clampParams({ ...defaultParams(), layers: 'none' as unknown as [] }).params.layers, []);
  assert.deepEqual(clampParams({ ...defaultParams(), layers: [null as never] }).params.layers, [defaultLayer(0, 'px')]);
});
