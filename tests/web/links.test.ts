// Links as they arrive: through chat programs, mail, HTML, analytics and hands. Old links give what they always gave.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PARAMS, PRESETS } from '../../www/rocks/params.ts';
import { presetParams } from '../../www/rocks/request.ts';
import { CAMERA_BOUNDS } from '../../www/table/camera-bounds.ts';
import { isLink } from '../../www/table/link.ts';
import { ROCKS } from '../../www/rocks/table.ts';
import { decodeLink, encodeLink } from '../../www/rocks/link.ts';
import { WOOD_EAR_PARAMS, WOOD_EAR_PRESETS } from '../../www/wood-ear/params.gen.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../../www/wood-ear/link.ts';
import { WOOD_EARS } from '../../www/wood-ear/table.ts';
import type { CameraState } from '../../www/base/view.ts';

const TABLES = [ROCKS, WOOD_EARS] as const;

test('what has no key of ours is no link', () => {
  for (const text of [
    '',
    '#',
    '?',
    '#main',
    '#/route',
    '#v=99',
    '#nonsense=1',
    '"#main"',
    '#:~:text=rocks',
    '?utm_source=x',
    '?fbclid=y',
    '?gclid=z',
    '?id=42',
    '?v=20240101',
    '?lang=ja#top',
    '?x',
    '?a1=1',
    '#__proto__',
    '?constructor=1',
  ]) {
    for (const table of TABLES) assert.equal(isLink<never>(table as never, text), false, text);
  }
});

test('whatever has one is a link, wherever it stands', () => {
  for (const text of [
    '#seed=7',
    '?seed=7',
    '#v=1&preset=nope',
    '?utm_source=x&seed=7',
    '?utm_source=x#seed=7',
    '#seed%3D7',
    '#v%3D1%26seed%3D7',
    'seed=7',
    '#view=wireframe',
  ]) {
    for (const table of TABLES) assert.equal(isLink<never>(table as never, text), true, text);
  }
});

test('with a link in the fragment the query is not looked at; without one the query is read', () => {
  const link = 'v=1&preset=journal-fig1&r=90,30,12';
  const { params } = decodeLink(`#${link}`);
  assert.equal(params.layers[2]?.radius, 12);
  for (const text of [
    `/?id=42#${link}`,
    `?seed=3&w=100#${link}`,
    `https://example.org/rocks/?utm_source=x&preset=scree#${link}`,
    `?${link}#main`,
    `?${link}&utm_source=x&fbclid=y#top`,
  ]) {
    const read = decodeLink(text);
    assert.deepEqual([read.params, read.preset, read.notices], [params, 'journal-fig1', []], text);
  }
});

test('a misspelt key beside keys of ours is told', () => {
  for (const text of ['?seed=3&nonsense=1', '#seed=3&nonsense=1', '?seed=3&utm_source=x&nonsense=1'])
    assert.deepEqual(
      decodeLink(text).notices.map(({ code, key }) => [code, key]),
      [['unknown-key', 'nonsense']],
      text,
    );
});

test('a link is read however often it was escaped, with escapes of HTML and of lists', () => {
  const link = 'v=1&preset=riverbed&seed=7&w=256';
  const { params } = decodeLink(`#${link}`);
  const once = encodeURIComponent(link);
  for (const text of [
    once,
    `#${once}`,
    `#${encodeURIComponent(once)}`,
    `#${link.replaceAll('&', '%26')}`,
    `?${once}`,
    `https://example.org/#${once}`,
    link.replaceAll('&', '&amp;'),
    `#${link.replaceAll('&', '&amp;amp;')}`,
  ]) {
    const read = decodeLink(text);
    assert.deepEqual([read.params, read.preset, read.notices], [params, 'riverbed', []], text);
  }
  assert.deepEqual(decodeLink('#preset=journal-fig1&r=90%2C30%2C12'), decodeLink('#preset=journal-fig1&r=90,30,12'));
});

test('what stands round a link and between its values is left out, at every key alike', () => {
  const pairs = [
    'preset=riverbed',
    'seed=7',
    'border=clip',
    'view=wireframe',
    'color=rock',
    'r=22,15,12',
    'camera=1,0.5,300,1,2,3',
    'id=4,5,6',
  ];
  const { notices, ...expected } = decodeLink(pairs.join('&'));
  assert.deepEqual(notices, []);
  for (const after of [
    ')',
    '>',
    ']',
    '*',
    '**',
    '_',
    '`',
    '"',
    '”',
    "'",
    '.',
    ',',
    ';',
    '!',
    '?',
    '…',
    '。',
    '」',
    '\u200b',
    '\ufeff',
    ' ',
    '\n',
    '%20',
    '%E2%80%8B',
    '%29',
    '%3E',
    '%22',
    '%C2%A0',
    '%0A',
    '\u00ad',
    ').',
  ]) {
    for (const [index] of pairs.entries()) {
      const moved = [...pairs.slice(index + 1), ...pairs.slice(0, index + 1)];
      assert.deepEqual(
        decodeLink(`https://example.org/#${moved.join('&')}${after}`),
        { ...expected, notices: [] },
        `${moved.join('&')}${after}`,
      );
    }
    // Between values too, where it is no separator of the address itself.
    if (!after.includes('?'))
      assert.deepEqual(
        decodeLink(`#${pairs.join(`${encodeURIComponent(decodeURIComponent(after))}&`)}`),
        { ...expected, notices: [] },
        after,
      );
  }
  for (const before of ['<', '(', '"', '\u200b', ' ', '**'])
    assert.deepEqual(decodeLink(`${before}https://example.org/#${pairs.join('&')}`), { ...expected, notices: [] }, before);
});

test('full-width digits and commas are digits and commas', () => {
  assert.deepEqual(
    decodeLink(`#preset=journal-fig1&r=${encodeURIComponent('９０，３０，１２')}&seed=７`),
    decodeLink('#preset=journal-fig1&r=90,30,12&seed=7'),
  );
});

const GROUND = encodeLink({ params: { ...presetParams('moraine'), seed: 3, wetness: 0.5 }, preset: 'moraine' });
const COLONY = { ...WOOD_EARS.presetParams('fallen-log'), seed: 11, ground: GROUND };
const CAMERA: CameraState = { azimuth: 1, elevation: 0.5, distance: 300, target: [1, 2, 3] };
const SCENE = { params: COLONY, preset: 'fallen-log', view: 'wireframe', color: 'plain', camera: CAMERA } as const;
/** As links were written before nested ones had a form of their own. */
const OLD = `v=1&preset=fallen-log&seed=11&ground=${encodeURIComponent(GROUND)}&view=wireframe&color=plain&camera=1,0.5,300,1,2,3`;

test('a link in a link survives any number of escapes more, and one less', () => {
  const link = encodeWoodEarLink(SCENE);
  assert.match(link, /&ground=v\.1_preset\.moraine_seed\.3_\w+\.0\.5&/);
  const forms = [link, OLD];
  for (const form of forms) {
    const versions = [
      form,
      encodeURIComponent(form),
      encodeURIComponent(encodeURIComponent(form)),
      decodeURIComponent(form),
      form.replaceAll('%', '%25'),
      form.replaceAll('&', '&amp;'),
      encodeURI(form),
      form.replaceAll('.', '%2E').replaceAll('_', '%5F'),
    ];
    for (const text of versions) {
      for (const address of [text, `#${text}`, `?${text}`, `https://example.org/wood-ear.html#${text}`])
        assert.deepEqual(decodeWoodEarLink(address), { ...SCENE, notices: [] }, address);
    }
  }
});

test("the seed of rocks is not the colony's, where the escapes of a link in a link were undone", () => {
  const { params, notices } = decodeWoodEarLink('#v=1&preset=fallen-log&ground=v=1&preset=moraine&seed=3');
  assert.deepEqual([params.seed, params.ground, notices], [0, 'v=1&preset=moraine&seed=3', []]);
});

test('no word of a link has a character that the form of nested links means something by', () => {
  const words = [...PARAMS, ...WOOD_EAR_PARAMS].flatMap(({ url, choices }) => [url, ...choices.map(({ value }) => value)]);
  for (const word of [...words, ...[...PRESETS, ...WOOD_EAR_PRESETS].map(({ name }) => name)]) assert.match(word, /^[a-z\d-]+$/);
});

test("a list without one readable value leaves the preset's own, with a notice", () => {
  for (const wrong of ['abc', 'foo,bar', '?', ',', 'NaN']) {
    for (const { url, kind } of ROCKS.itemRows) {
      const { params, notices } = decodeLink(`#preset=riverbed&seed=7&${url}=${wrong}`);
      // A mark at the end is none of the value; without it the list is empty.
      if (/^[?,]$/.test(wrong)) continue;
      assert.deepEqual(params, { ...presetParams('riverbed'), seed: 7 }, `${url}=${wrong}`);
      assert.deepEqual(
        notices.map(({ code, key }) => [code, key]),
        [[kind === 'choice' ? 'unknown-choice' : 'not-a-number', url]],
      );
    }
  }
  const { params } = decodeLink('#preset=journal-fig1&r=1,2,3,4&a=foo');
  assert.deepEqual(
    params.layers.map(({ radius }) => radius),
    [1, 2, 3, 4],
  );
  assert.deepEqual(decodeWoodEarLink('#x=foo').params.bases, WOOD_EARS.presetParams('thesis-default').bases);
});

test('every camera within its bounds is read from the link it is written to', () => {
  const at = (share: number): CameraState => {
    const [azimuth, elevation, distance, x, y, z] = CAMERA_BOUNDS.map(({ min, max }) => min + share * (max - min)) as [
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    return { azimuth, elevation, distance, target: [x, y, z] };
  };
  for (const share of [0, 1e-9, 0.123, 0.5, 1 - 1e-9, 1]) {
    const camera = at(share);
    const read = decodeLink(encodeLink({ params: presetParams('riverbed'), preset: 'riverbed', camera }));
    assert.deepEqual(read.notices, []);
    assert.ok(read.camera);
    for (const [given, found] of [
      [camera.azimuth, read.camera.azimuth],
      [camera.elevation, read.camera.elevation],
    ] as const)
      assert.ok(Math.abs(given - found) <= 1e-4);
    assert.ok(Math.abs(camera.distance - read.camera.distance) <= 0.1);
  }
  // By hand a camera goes back to 250,000 px, and a rock may be looked at from nowhere.
  for (const distance of [1e-300, 0.04, 250_000])
    assert.ok(
      decodeLink(encodeLink({ params: presetParams('riverbed'), preset: 'riverbed', camera: { ...CAMERA, distance } })).camera,
      String(distance),
    );
});

test('a camera that is none is the whole field, with a notice', () => {
  for (const camera of [
    'NaN,1,1,1,1,1',
    '1,1,Infinity,1,1,1',
    '1,1,-5,1,1,1',
    '1,1,0,1,1,1',
    '1,1,0.01,1,1,1',
    '1,9,5,1,1,1',
    '1e309,1,1,1,1,1',
    '1,1,1,1,1',
    '1,1,1,1,1,1,1',
    '1,1,1,1,1,1,121',
    '1,1,1,1,1,1,40,1',
  ]) {
    const read = decodeLink(`#preset=riverbed&camera=${camera}`);
    assert.deepEqual([read.camera, read.notices.map(({ code }) => code)], [null, ['bad-camera']], camera);
  }
});
