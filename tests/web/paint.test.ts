// A mask and painted strokes: as objects, as text, in links and attributes, and what the generator makes of them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createGenerator, generate, schema, strokesOfText, strokesToText } from 'rock-field/core';
import type { Mask, PaintedRequest, Stroke } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import type { Field } from '../../www/data/field.ts';
import { readAttributes } from '../../www/rocks/attributes.ts';
import { decodeLink, encodeLink, MAX_LINK_LENGTH } from '../../www/rocks/link.ts';
import { maskRows } from '../../www/rocks/mask.ts';
import { presetParams, resolveParams } from '../../www/rocks/request.ts';
import { strokeNumbers } from '../../www/rocks/stroke-numbers.ts';
import { isStrokes, MAX_STROKES_LENGTH } from '../../www/rocks/stroke-text.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../../www/wood-ear/link.ts';
import { mulberry32 } from '../../www/controls/mulberry32.ts';

const SMALL = {
  imageWidth: 160,
  imageHeight: 160,
  layers: [
    { radius: 16, areaFraction: 0.3 },
    { radius: 7, areaFraction: 1 },
  ],
} as const satisfies PaintedRequest;

const STROKES: Stroke[] = [
  { mode: 'erase', width: 0.25, points: [0.5, 0.5] },
  { mode: 'path', layer: null, width: 0.05, points: [-0.1, 0.25, 0.5, 0.75, 1.5, 0.625] },
  { mode: 'add', layer: 0, width: 1 / 4096, points: [0, 0, 16, -16, -16, 16] },
  { mode: 'restore', layer: 0xffff_ffff, width: 16, points: [0.125, 0.125] },
];

/** What text keeps of strokes. */
function kept(strokes: readonly Stroke[]): Stroke[] {
  const round = (value: number) => Math.floor(value * 4096 + 0.5) / 4096 + 0;
  return strokes.map(({ mode, layer, width, points }) => ({ mode, layer: layer ?? null, width: round(width), points: points.map(round) }));
}

/** Lines as a hand draws them: evenly, and bent. */
function handDrawn(count: number, points: number, seed: number): Stroke[] {
  const random = mulberry32(seed);
  return Array.from({ length: count }, () => {
    let [x, y, angle] = [random(), random(), 6.28 * random()];
    const line: number[] = [];
    for (let k = 0; k < points; k += 1) {
      line.push(x, y);
      angle += 0.3 * (random() - 0.5);
      const step = 0.01 * (0.9 + 0.2 * random());
      [x, y] = [x + step * Math.cos(angle), y + step * Math.sin(angle)];
    }
    return { mode: 'erase', layer: Math.floor(3 * random()), width: 0.05, points: line } satisfies Stroke;
  });
}

test('strokes are the same after text, and text after strokes', () => {
  const text = strokesToText(STROKES);
  assert.ok(isStrokes(text), text);
  assert.deepEqual(strokesOfText(text), kept(STROKES));
  assert.equal(strokesToText(strokesOfText(text)), text);
  assert.equal(strokesToText(text), text);
  for (let seed = 0; seed < 50; seed += 1) {
    const strokes = handDrawn(5, 1 + seed, seed);
    assert.deepEqual(strokesOfText(strokesToText(strokes)), kept(strokes));
  }
  assert.equal(strokesToText([]), '');
  assert.deepEqual(strokesOfText(''), []);
});

test('the generator is told of each stroke what it does, where, half its width, and its points', () => {
  const [erase, path] = STROKES as [Stroke, Stroke];
  assert.deepEqual(
    [...strokeNumbers(strokesToText([erase, path]))],
    [...[1, 0, 512, 1, 2048, 2048], ...[2, 0, 102.5, 3, -410, 1024, 2048, 3072, 6144, 2560]],
  );
  assert.deepEqual([...strokeNumbers('')], []);
});

test('a link with 20 strokes of 30 points has fewer than 2,000 characters', () => {
  const strokes = strokesToText(handDrawn(20, 30, 1));
  const link = encodeLink({ params: { ...presetParams('riverbed'), strokes }, preset: 'riverbed' });
  assert.ok(link.length < 2000, `${link.length} characters`);
  assert.equal(decodeLink(link).params.strokes, strokes);
});

test('strokes come through links as they are, alone, escaped, cut out of an address, and in a link in a link', () => {
  for (const strokes of [strokesToText(STROKES), strokesToText(handDrawn(20, 30, 2)), strokesToText(handDrawn(3, 700, 3))]) {
    const params = { ...presetParams('riverbed'), strokes };
    const link = encodeLink({ params, preset: 'riverbed', view: 'wireframe' });
    assert.ok(link.length < MAX_LINK_LENGTH);
    const address = new URL('https://rocks.example/');
    address.hash = link;
    for (const text of [link, address.href, `(${address.href}).`, encodeURIComponent(link)]) {
      const { params: read, notices } = decodeLink(text);
      assert.deepEqual([read, notices], [params, []]);
    }
    const onLog = decodeWoodEarLink('preset=fallen-log').params;
    const log = encodeWoodEarLink({ params: { ...onLog, ground: link }, preset: 'fallen-log', view: '3d', color: null, camera: null });
    const { ground } = decodeWoodEarLink(log).params;
    assert.equal(decodeLink(ground).params.strokes, strokes);
  }
});

test('without strokes a link says nothing of them, and no parameters have any', () => {
  const params = presetParams('riverbed');
  assert.equal(encodeLink({ params, preset: 'riverbed' }), 'v=1&preset=riverbed');
  for (const strokes of ['', undefined]) {
    assert.ok(!('strokes' in resolveParams({ preset: 'riverbed', strokes })));
    assert.ok(!('strokes' in decodeLink(`preset=riverbed${strokes === '' ? '&strokes=' : ''}`).params));
  }
});

const MALFORMED = [
  'A',
  'AAAA',
  'EAEAA',
  'AAEAAA',
  'AAEAg',
  'AAEAA.',
  '.AAEAA',
  'AAEAA..AAEAA',
  'AAE AA',
  'AAEAé',
  `AAEA${'g'.repeat(7)}A`,
  '1,2,3',
];

test('text that is no strokes is refused: by requests with an error, in links and attributes with one notice', () => {
  for (const text of MALFORMED) {
    assert.ok(!isStrokes(text), text);
    assert.throws(() => resolveParams({ strokes: text }), { name: 'WrongType', key: 'strokes' });
    const { params, notices } = decodeLink(`preset=riverbed&strokes=${text}`);
    assert.ok(isStrokes(params.strokes ?? ''));
    // What surrounds a link is no part of it.
    if (!/^\.|\.$/.test(text))
      assert.deepEqual(
        notices.map(({ code, key }) => `${code} ${key}`),
        ['bad-strokes strokes'],
        text,
      );
    const read = readAttributes((name) => (name === 'strokes' ? text : null));
    assert.equal(read.params.strokes, undefined);
    assert.deepEqual(
      read.notices.map(({ attribute }) => attribute),
      ['strokes'],
    );
  }
  const long = `${'AAEAA.'.repeat(2048)}AAEAA`;
  assert.throws(() => resolveParams({ strokes: long }), {
    name: 'OutOfRange',
    key: 'strokes',
    value: long.length,
    min: 0,
    max: MAX_STROKES_LENGTH,
  });
});

test('the attribute replaces what the source says, and takes it away where it is empty', () => {
  const [one, other] = [strokesToText(STROKES.slice(0, 1)), strokesToText(STROKES.slice(1))];
  const read = (attributes: Record<string, string>) => readAttributes((name) => attributes[name] ?? null).params.strokes;
  assert.equal(read({ src: `strokes=${one}` }), one);
  assert.equal(read({ src: `strokes=${one}`, strokes: other }), other);
  assert.equal(read({ src: `strokes=${one}`, strokes: '' }), undefined);
  assert.equal(read({ src: JSON.stringify({ strokes: other }) }), other);
});

test('strokes that are wrong are errors with the key, the value and the bounds', () => {
  const good = STROKES[0]!;
  const cases: [unknown, object][] = [
    [5, { name: 'WrongType', key: 'strokes' }],
    [[5], { name: 'WrongType', key: 'strokes' }],
    [[null], { name: 'WrongType', key: 'strokes' }],
    [[{ ...good, mode: 'paint' }], { name: 'WrongType', key: 'mode', value: 'paint' }],
    [[{ ...good, color: 1 }], { name: 'UnknownKey', key: 'color' }],
    [[{ ...good, layer: 0.5 }], { name: 'NotAnInteger', key: 'layer', value: 0.5 }],
    [[{ ...good, layer: -1 }], { name: 'OutOfRange', key: 'layer', value: -1, min: 0, max: 0xffff_ffff }],
    [[{ ...good, width: 0 }], { name: 'OutOfRange', key: 'width', value: 0, min: 1 / 4096, max: 16 }],
    [[{ ...good, width: Number.NaN }], { name: 'OutOfRange', key: 'width' }],
    [[{ ...good, points: [] }], { name: 'WrongType', key: 'points' }],
    [[{ ...good, points: [1, 2, 3] }], { name: 'WrongType', key: 'points' }],
    [[{ ...good, points: [1, 17] }], { name: 'OutOfRange', key: 'points', value: 17, min: -16, max: 16 }],
    [[{ ...good, points: [1, '2'] }], { name: 'WrongType', key: 'points', value: '2' }],
  ];
  for (const [strokes, error] of cases) assert.throws(() => strokesToText(strokes as Stroke[]), error, JSON.stringify(strokes));
  assert.throws(() => strokesToText([good, { ...good, width: 20 }]), /width of stroke 1 is 20/);
  const many = Array.from({ length: 10_000 }, () => good);
  assert.throws(() => strokesToText(many), { name: 'OutOfRange', key: 'strokes', min: 0, max: MAX_STROKES_LENGTH });
  const points = Array.from({ length: 20_000 }, (_, k) => k / 20_000);
  assert.throws(() => strokesToText([{ ...good, points }]), { name: 'OutOfRange', key: 'strokes', min: 0, max: MAX_STROKES_LENGTH });
});

/** Where the rocks stand, in px. */
function places({ layers }: Field): string[] {
  return layers.flatMap(({ sites, selected, id }) => [...selected].map((site) => `${id}: ${sites[2 * site]}, ${sites[2 * site + 1]}`));
}

test('what is painted is generated, as objects and as text, and by a generator that has made others before', async () => {
  const generator = await createGenerator();
  try {
    const free = await generator.generate(SMALL);
    const strokes: Stroke[] = [{ mode: 'erase', width: 0.5, points: [0.25, 0.25] }];
    const painted = await generator.generate({ ...SMALL, strokes });
    const far = (place: string) => {
      const [, x = 0, y = 0] = /: (.*), (.*)/.exec(place)!.map(Number);
      return Math.hypot(x - 40, y - 40) > 40;
    };
    assert.ok(painted.stats.rocks > 0 && painted.stats.rocks < free.stats.rocks);
    assert.ok(places(painted).every(far) && !places(free).every(far));
    assert.deepEqual(painted, { ...(await generate({ ...SMALL, strokes: strokesToText(strokes) })), stats: painted.stats });
    assert.deepEqual(places(await generator.generate(SMALL)), places(free));
  } finally {
    generator.dispose();
  }
});

test('a mask is grey or colours, of 8 or 16 bits, its rows from the top, and alpha multiplies', async () => {
  const free = places(await generate(SMALL));
  const of = async (mask: Mask) => places(await generate({ ...SMALL, mask }));
  assert.deepEqual(await of({ width: 1, height: 1, data: Uint8Array.of(255) }), free);
  assert.deepEqual(await of({ width: 1, height: 1, data: Uint16Array.of(65_535) }), free);
  assert.deepEqual(await of({ width: 1, height: 1, data: Uint8ClampedArray.of(255, 255, 255, 255) }), free);
  assert.deepEqual(await of({ width: 1, height: 1, data: Uint8ClampedArray.of(255, 255, 255, 0) }), []);
  // White above, black below, each as large as half the image.
  const data = new Uint8Array(2 * 160);
  data.fill(255, 0, 160);
  const above = await of({ width: 2, height: 160, data });
  assert.ok(above.length > 0 && above.every((place) => Number(place.split(', ')[1]) > 79));
  assert.deepEqual([...maskRows({ width: 3, height: 1, data: Uint16Array.of(0, 32_768, 65_535) }, 2 ** 20).rows], [0, 128, 255]);
  const colours = Uint8Array.of(255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128);
  assert.deepEqual([...maskRows({ width: 4, height: 1, data: colours }, 2 ** 20).rows], [54, 182, 18, 128]);
});

test('a mask that is wrong is an error before anything is made, and a large one is refused before it is copied', async () => {
  const one = Uint8Array.of(1);
  const cases: [unknown, object][] = [
    [5, { name: 'WrongType', key: 'mask' }],
    [
      { width: 0, height: 1, data: one },
      { name: 'OutOfRange', key: 'mask', value: 0, min: 1, max: 16_384 },
    ],
    [
      { width: 16_385, height: 1, data: one },
      { name: 'OutOfRange', key: 'mask', value: 16_385 },
    ],
    [
      { width: 1.5, height: 1, data: one },
      { name: 'NotAnInteger', key: 'mask' },
    ],
    [
      { width: 1, height: 1, data: [1] },
      { name: 'WrongType', key: 'mask' },
    ],
    [
      { width: 1, height: 1, data: new Float32Array(1) },
      { name: 'WrongType', key: 'mask' },
    ],
    [
      { width: 2, height: 1, data: one },
      { name: 'MalformedRequest', key: 'mask', value: 1, min: 2, max: 8 },
    ],
    [
      { width: 1, height: 1, data: new Uint16Array(4) },
      { name: 'MalformedRequest', key: 'mask' },
    ],
  ];
  for (const [mask, error] of cases) await assert.rejects(generate({ ...SMALL, mask: mask as Mask }), error);
  const mask = { width: 2000, height: 2000, data: new Uint8Array(4_000_000) };
  await assert.rejects(generate({ ...SMALL, mask }, { maxBytes: 15_000_000 }), { name: 'OverBudget', key: 'mask', max: 15_000_000 });
  assert.equal((await generate({ ...SMALL, mask }, { maxBytes: 40_000_000 })).stats.rocks, 0);
});

test('an exported scene has what is painted, and brings its strokes back', async () => {
  const strokes: Stroke[] = [{ mode: 'path', width: 0.25, points: [0, 0.5, 1, 0.5] }];
  const { bytes } = await exportScene({ ...SMALL, strokes }, { format: 'glb' });
  const text = new TextDecoder().decode(bytes);
  assert.ok(text.includes(strokesToText(strokes)));
  const none = { width: 1, height: 1, data: Uint8Array.of(0) };
  const { bytes: empty } = await exportScene({ ...SMALL, mask: none }, { format: 'glb' });
  assert.ok(empty.length < bytes.length / 2);
});

test('the schema knows strokes', () => {
  const { strokes } = (schema as { properties: Record<string, { anyOf: object[] }> }).properties;
  assert.equal(strokes!.anyOf.length, 2);
});
