// Links: every row of the table goes there and back, and nothing that stands in a link can hurt.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createGenerator } from 'rock-field/core';
import { ROCKS } from '../../www/rocks/table.ts';
import { presetColor } from '../../www/table/table.ts';
import { MAX_LAYERS, PRESETS } from '../../www/rocks/params.ts';
import type { ParamSpec } from '../../www/rocks/spec.ts';
import type { Params, PresetName } from '../../www/rocks/params.ts';
import {
  FIELD_ROWS,
  LAYER_ROWS,
  boundsOf,
  defaultLayer,
  defaultParams,
  presetParams,
  readValue,
  resolveParams,
  writeValue,
} from '../../www/rocks/request.ts';
import { COLORS, MAX_LINK_LENGTH, VIEWS, decodeLink, encodeLink } from '../../www/rocks/link.ts';
import type { NoticeCode } from '../../www/rocks/link.ts';

const FIRST: PresetName = PRESETS[0].name;

/** Values of a row from end to end, with some that no short decimal hits. */
function samples(spec: ParamSpec, notation: Params['notation']): unknown[] {
  if (spec.kind === 'choice') return spec.choices.map(({ value }) => value);
  const { min, max, slider } = boundsOf(spec, notation);
  const numbers =
    spec.kind === 'real'
      ? [min, max, slider.min, slider.max, min + (max - min) / 3, min + (max - min) * 1e-9]
      : [min, max, min + 1, Math.floor(max / 3)];
  return spec.kind === 'optional-integer' ? [...numbers, null] : numbers;
}

function assertRoundTrip(params: Params, preset: PresetName): void {
  const link = encodeLink({ params, preset });
  const read = decodeLink(`#${link}`);
  assert.deepEqual(read.notices, [], link);
  assert.deepEqual(read.params, params, link);
  assert.equal(read.preset, preset);
  // What a link says, the element must take.
  assert.deepEqual(resolveParams(read.params), params);
}

function codes(link: string): NoticeCode[] {
  return decodeLink(link).notices.map(({ code }) => code);
}

for (const spec of FIELD_ROWS) {
  test(`${spec.url} (${spec.key}) survives a link, to the bit`, () => {
    for (const preset of [FIRST, 'conference-fig1'] as const) {
      for (const value of samples(spec, presetParams(preset).notation)) {
        const params = presetParams(preset);
        writeValue(params, spec, value);
        assertRoundTrip(params, preset);
      }
    }
  });
}

for (const spec of LAYER_ROWS) {
  test(`${spec.url} (${spec.key}${spec.component === null ? '' : `[${spec.component}]`}) survives a link, to the bit`, () => {
    for (const preset of [FIRST, 'conference-fig1'] as const) {
      const { notation } = presetParams(preset);
      for (const [index, value] of samples(spec, notation).entries()) {
        const params = presetParams(preset);
        const layer = params.layers[index % params.layers.length];
        assert.ok(layer);
        writeValue(layer, spec, value);
        assertRoundTrip(params, preset);
      }
    }
  });

  if (spec.kind === 'choice') {
    test(`${spec.url}: what is no word of it is the preset's, with one notice that names it`, () => {
      const words = spec.choices.map(({ value }) => value);
      const last = words.at(-1);
      for (const wrong of ['abc', '0', '', words[0]!.toUpperCase(), 'toString', '<b>']) {
        const { notices, params } = decodeLink(`#${spec.url}=${last},${encodeURIComponent(wrong)},${last}`);
        assert.deepEqual(
          notices.map(({ code, key }) => [code, key]),
          [['unknown-choice', spec.url]],
          wrong,
        );
        assert.deepEqual(
          params.layers.map((layer) => readValue(layer, spec)),
          [last, words[0], last],
        );
      }
    });
    continue;
  }

  test(`${spec.url}: what is no legal number is put right, with one notice that names it`, () => {
    const { min, max } = boundsOf(spec, 'px');
    const [a, b, c] = [min, max, max].map(String);
    for (const wrong of ['abc', 'NaN', 'Infinity', '', '0x10', '1e', '<b>']) {
      const read = decodeLink(`#${spec.url}=${a},${encodeURIComponent(wrong)},${c}`);
      assert.deepEqual(
        read.notices.map(({ code, key }) => [code, key]),
        [['not-a-number', spec.url]],
        wrong,
      );
      resolveParams(read.params);
    }
    for (const wrong of [max + 1, min - 1, 1e300, -1e300, '1e999']) {
      const read = decodeLink(`#${spec.url}=${a},${b},${wrong}`);
      assert.deepEqual(
        read.notices.map(({ code, key }) => [code, key]),
        [['clamped', spec.url]],
        String(wrong),
      );
      resolveParams(read.params);
    }
  });
}

test('a link of the time when `detail` was a number of cuts shows rocks that are cut as often', async () => {
  const generator = await createGenerator();
  for (const [cuts, notation] of [
    [1, 'px'],
    [2, 'relative'],
    [3, 'px'],
  ] as const) {
    const [radii, heights] = notation === 'px' ? ['40,9', '12,3'] : ['13,3', '0.3,0.3'];
    const { params, notices } = decodeLink(
      `#v=1&preset=journal-fig1&w=300&h=300&u=${notation}&r=${radii}&a=0.4,0.4&h1=${heights}&h2=0,0&h3=0,0&de=${cuts},0`,
    );
    assert.deepEqual(notices, []);
    assert.equal(params.layers[1]!.detail, 0);
    const { rockLayer, rockStarts, vertexStarts } = await generator.generate(params);
    let [same, all] = [0, 0];
    rockLayer.forEach((layer, rock) => {
      const triangles = (rockStarts[rock + 1]! - rockStarts[rock]!) / 3;
      const rim = 2 * (vertexStarts[rock + 1]! - vertexStarts[rock]!) - triangles - 2;
      // A cell of n corners has 3n − 2 triangles before they are cut, and then n·2^cuts corners.
      const expected = layer === 0 ? cuts : 0;
      same += Number(triangles === ((3 * rim) / 2 ** expected - 2) * 4 ** expected);
      all += 1;
    });
    assert.ok(all > 20 && same > 0.9 * all, `${same} of ${all} with ${cuts} in ${notation}`);
  }
  generator.dispose();
});

test('a number of cuts that is wrong is told, and gives way to `detail`', () => {
  const detail = (link: string) => decodeLink(link).params.layers.map((layer) => layer.detail);
  assert.deepEqual(detail('#preset=journal-fig11a&de=0'), [0]);
  assert.deepEqual(detail('#preset=journal-fig11a&de=3&dt=20'), [20]);
  assert.deepEqual(detail('#preset=journal-fig11a&de=9'), detail('#preset=journal-fig11a&de=3'));
  assert.deepEqual(codes('#preset=journal-fig11a&de=9'), ['clamped']);
  assert.deepEqual(codes('#preset=journal-fig11a&de=x'), ['not-a-number']);
  assert.deepEqual(codes('#preset=journal-fig1&de=1,1&r=90,30,10'), ['unequal-lists']);
});

test('every preset is a short link', () => {
  for (const { name } of PRESETS) {
    assertRoundTrip(presetParams(name), name);
    assert.equal(encodeLink({ params: presetParams(name), preset: name }), `v=1&preset=${name}`);
  }
});

test('only what differs from the preset is in the link', () => {
  const params = { ...defaultParams(), seed: 42 };
  assert.equal(encodeLink({ params }), `v=1&preset=${FIRST}&seed=42`);
  const [first] = params.layers;
  assert.ok(first);
  first.radius = 60;
  assert.equal(encodeLink({ params }), `v=1&preset=${FIRST}&seed=42&r=60,30,10`);
});

test('layers can be fewer, more, none, and keep their ids', () => {
  const params = defaultParams();
  for (let count = 0; count <= MAX_LAYERS; count += 1) {
    const layers = Array.from({ length: count }, (_, index) => params.layers[index] ?? defaultLayer(index, 'px'));
    assertRoundTrip({ ...params, layers }, FIRST);
    assertRoundTrip({ ...params, layers: layers.map((layer, index) => ({ ...layer, id: 4_294_967_295 - 7 * index })) }, FIRST);
  }
  assert.deepEqual(decodeLink('#r=').params.layers, []);
  const [, , third] = params.layers;
  assert.ok(third);
  assert.match(encodeLink({ params: { ...params, layers: [third] } }), /&id=2$/);
  third.cellCount = 40;
  assert.match(encodeLink({ params }), /&n=-,-,40$/);
});

test('view, colour and camera are in the link only when changed', () => {
  const params = defaultParams();
  const camera = { azimuth: 0.123456, elevation: 0.6, distance: 1234.56, target: [512, 512.04, 0] as [number, number, number] };
  assert.equal(encodeLink({ params, view: VIEWS[0], color: null, camera: null }), `v=1&preset=${FIRST}`);
  assert.equal(encodeLink({ params, camera, defaultCamera: camera }), `v=1&preset=${FIRST}`);
  const link = encodeLink({ params, view: 'selection', color: 'plain', camera });
  const read = decodeLink(link);
  assert.deepEqual([read.view, read.color, read.notices], ['selection', 'plain', []]);
  assert.deepEqual(read.camera, { azimuth: 0.1235, elevation: 0.6, distance: 1234.6, target: [512, 512, 0] });
  assert.equal(encodeLink(read), link);
  assert.equal(encodeLink({ params, camera: { ...camera, fov: 36 } }), encodeLink({ params, camera }));
  const wide = encodeLink({ params, camera: { ...camera, fov: 64.5 } });
  assert.deepEqual(decodeLink(wide).camera, { ...read.camera, fov: 64.5 });
  assert.match(wide, /&camera=0\.1235,0\.6,1234\.6,512,512,0,64\.5$/);
});

test("a colour is in the link only when it is not the preset's own", () => {
  for (const { name } of PRESETS) {
    const params = presetParams(name);
    for (const color of COLORS) {
      const link = encodeLink({ params, preset: name, color });
      const isOwn = color === presetColor(ROCKS, name);
      assert.equal(link.includes('color='), !isOwn, link);
      assert.equal(decodeLink(link).color, isOwn ? null : color);
      assert.deepEqual(decodeLink(`#preset=${name}&color=${color}`).notices, []);
    }
  }
  assert.match(decodeLink('#preset=riverbed&color=green').notices[0]!.text, /using natural/);
  assert.deepEqual([decodeLink('#seed=7').color, decodeLink('#seed=7&color=rock').color], [null, 'rock']);
});

test('a link is found after #, after ?, in an address and on its own', () => {
  const link = 'v=1&preset=journal-fig12b&seed=7';
  for (const text of [
    link,
    `#${link}`,
    `?${link}`,
    `https://example.org/rocks/?${link}`,
    `https://example.org/#${link}`,
    `./#${link}`,
    ` #${link} `,
  ]) {
    const { preset, params, notices } = decodeLink(text);
    assert.deepEqual([preset, params.seed, notices], ['journal-fig12b', 7, []], text);
  }
  assert.equal(decodeLink(`#${link.replaceAll('&', '&amp;')}`).params.seed, 7);
  assert.equal(decodeLink('#r=90%2C30%2C12').params.layers[2]?.radius, 12);
  for (const empty of ['', '#', '?', 'https://example.org/']) assert.deepEqual(decodeLink(empty).params, defaultParams());
});

test('what a link gets wrong is said once, and the rest of it holds', () => {
  const cases: [string, NoticeCode[]][] = [
    ['#seed=3&nonsense=1', ['unknown-key']],
    ['#seed=3&a1=1&b1=2&c1=3&d1=4&e1=5', ['unknown-key']],
    ['#seed=3&v=99', ['unknown-version']],
    ['#seed=3&preset=nope', ['unknown-preset']],
    ['#seed=3&u=furlongs', ['unknown-choice']],
    ['#seed=3&view=inside-out', ['unknown-choice']],
    ['#seed=3&w=abc', ['not-a-number']],
    ['#seed=3&w=NaN', ['not-a-number']],
    ['#seed=3&w=0', ['clamped']],
    ['#seed=3&w=10.5', ['not-whole']],
    ['#seed=3&w=-0.5', ['clamped']],
    ['#seed=3&seed=4', ['repeated']],
    ['#seed=3&r=1,2,3&a=1,2', ['unequal-lists']],
    [`#seed=3&r=${Array(9).fill(20).join(',')}`, ['too-many-layers']],
    ['#seed=3&id=1,1,2', ['bad-ids']],
    ['#seed=3&id=1,-2,x', ['bad-ids']],
    ['#seed=3&camera=1,2', ['bad-camera']],
    ['#seed=3&camera=1,1,NaN,0,0,0', ['bad-camera']],
    ['#seed=3&%E0%A4%A=1', ['unknown-key']],
  ];
  for (const [link, expected] of cases) {
    assert.deepEqual(codes(link), expected, link);
    const { params } = decodeLink(link);
    assert.equal(params.seed, 3, link);
    resolveParams(params);
  }
  assert.equal(decodeLink(`#r=${Array(9).fill(20).join(',')}`).params.layers.length, MAX_LAYERS);
  assert.deepEqual(decodeLink('#r=1,2,3&a=1,2').params, defaultParams());
});

test('a link of 200 kB is cut between two pairs', () => {
  for (const long of [`#seed=3&${'x=1&'.repeat(50_000)}`, `#seed=3&w=${'9'.repeat(200_000)}`, `#seed=3&r=${'1,'.repeat(100_000)}`]) {
    // What comes after the cut is not read.
    const { params, notices } = decodeLink(`${long}&h=77`);
    assert.equal(params.imageHeight, 1024);
    assert.equal(params.seed, 3);
    assert.equal(params.imageWidth, 1024);
    assert.ok(notices.some(({ code }) => code === 'too-long'));
    assert.ok(notices.length <= 3);
  }
  const honest = Array.from({ length: MAX_LAYERS }, (_, id) => ({
    ...defaultLayer(4e9 + id, 'px'),
    radius: 1 + Math.PI * id,
    taper: [Math.E, Math.PI, 1 / 3] as [number, number, number],
  }));
  assert.ok(encodeLink({ params: { ...defaultParams(), layers: honest } }).length < MAX_LINK_LENGTH / 4);
});

test('notices repeat little of the link, in one line', () => {
  const [notice] = decodeLink(`#preset=${encodeURIComponent('<img src=x onerror=alert(1)>\n\u202e'.repeat(100))}`).notices;
  assert.ok(notice);
  assert.ok(notice.given.length < 40 && notice.text.length < 200);
  assert.doesNotMatch(notice.text, /[\n\u202e]/);
});

test('no text makes reading throw, and what is read is legal', () => {
  // A linear congruence is random enough to shuffle characters that mean something here.
  const letters = '#?&=,.-+%0123456789eEabcdnrwhvu<>"\'\\/:\u0000é岩';
  const keys = ['v', 'preset', 'seed', 'camera', 'id', 'view', ...FIELD_ROWS.map(({ url }) => url), ...LAYER_ROWS.map(({ url }) => url)];
  let state = 1;
  const next = (below: number) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
  for (let round = 0; round < 5000; round += 1) {
    const pairs = Array.from({ length: next(5) }, () => {
      const value = Array.from({ length: next(12) }, () => letters[next(letters.length)]).join('');
      return `${keys[next(keys.length)]}=${value}`;
    });
    const text = `${'#?'[next(3)] ?? ''}${pairs.join('&')}`;
    const { params, preset } = decodeLink(text);
    assert.deepEqual(resolveParams(params), params, text);
    assert.deepEqual(decodeLink(encodeLink({ params, preset })).params, params, text);
  }
});
