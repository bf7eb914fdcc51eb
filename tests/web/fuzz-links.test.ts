// Any text at all is read as a link, as attributes and as parameters: it never throws anything but our error, and what is read can be written and read again.
import assert from 'node:assert/strict';
import { readAttributes, ATTRIBUTES } from '../../www/rocks/attributes.ts';
import { RockFieldError } from '../../www/base/errors.ts';
import { resolveParams } from '../../www/rocks/request.ts';
import { decodeLink, encodeLink } from '../../www/rocks/link.ts';
import { readWoodEarAttributes, WOOD_EAR_ATTRIBUTES } from '../../www/wood-ear/attributes.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../../www/wood-ear/link.ts';
import { ROCKS } from '../../www/rocks/table.ts';
import { WOOD_EARS } from '../../www/wood-ear/table.ts';
import { fuzz } from './fuzz.ts';
import type { Random } from './fuzz.ts';

const WORDS = [
  '&',
  '=',
  ',',
  '#',
  '?',
  '%',
  '%26',
  '%3D',
  '%25',
  '&amp;',
  '-',
  '+',
  '.',
  ' ',
  '\u200b',
  '\ufeff',
  ')',
  '>',
  '*',
  '"',
  '”',
  '、',
  '１',
  '[]',
  '{}',
  'null',
  'NaN',
  'Infinity',
  '1e309',
  '-1e309',
  '1e-400',
  '-0',
  '0x10',
  '9007199254740993',
  '4294967296',
  '-1',
  '0.5',
  '1'.repeat(310),
  'v=1',
  'preset=moraine',
  'seed=3',
  'ground=v%3D1',
  'camera=1,1,1,1,1,1',
  'id=0,1',
  'utm_source=x',
  'fbclid=y',
  '__proto__=1',
  'constructor=1',
  'toString',
  '\u0000',
  '\ud800',
  'https://example.org/',
  '../',
];
const LINKS = [
  'v=1&preset=riverbed&seed=7',
  'v=1&preset=journal-fig1&seed=42&r=90,30,12&a=0.2,0.24,0.5&n=-,40,-&id=2,5,9&view=wireframe&color=rock&camera=0.5,0.6,900,320,320,0',
  'v=1&preset=conference-fig1&u=relative&w=256&h=256&w1=0,0,1&h3=1,2,3',
  '?utm_source=x&fbclid=y#main',
  'https://example.org/page?id=42#v=1&preset=journal-fig1&r=90,30,12',
];
const WOOD_EAR_LINKS = [
  'v=1&preset=fallen-log&seed=4',
  encodeWoodEarLink({
    params: { ...WOOD_EARS.presetParams('wet-colony'), ground: 'v=1&preset=moraine&seed=3' },
    preset: 'wet-colony',
    view: '3d',
    color: null,
    camera: { azimuth: 1, elevation: 1, distance: 300, target: [1, 2, 3] },
  }),
  'v=1&preset=fallen-log&ground=v=1&preset=moraine&seed=3',
  ...LINKS,
];

fuzz({
  name: 'any text is a link to rocks, and reads the same once it was written again',
  cases: 4000,
  make: (random) => random.mutatedText(random.pick(LINKS), WORDS),
  check(text) {
    const { notices, ...read } = decodeLink(text);
    assertPlain(notices.map((notice) => notice.text));
    resolveParams({ ...read.params, preset: read.preset });
    const { notices: none, ...again } = decodeLink(encodeLink(read));
    assert.deepEqual(again, { ...read, camera: again.camera });
    assert.equal(again.camera === null, read.camera === null);
    assert.deepEqual(none, []);
  },
});

fuzz({
  name: 'any text is a link to a log, and reads the same once it was written again',
  cases: 2000,
  make: (random) => random.mutatedText(random.pick(WOOD_EAR_LINKS), WORDS),
  check(text) {
    const { notices, ...read } = decodeWoodEarLink(text);
    assertPlain(notices.map((notice) => notice.text));
    WOOD_EARS.resolve({ ...read.params, preset: read.preset });
    const { notices: none, ...again } = decodeWoodEarLink(encodeWoodEarLink(read));
    assert.deepEqual(again, { ...read, camera: again.camera });
    assert.equal(again.camera === null, read.camera === null);
    assert.deepEqual(none, []);
  },
});

/** Attributes as a list of `name=value`, a line each. */
function attributes(random: Random, names: readonly string[], links: readonly string[]): string {
  const value = () =>
    random.pick([
      random.pick(WORDS),
      random.mutatedText(random.pick(links), WORDS),
      random.mutatedText('90 30, 10', WORDS),
      random.mutatedText('45deg 55deg 120%', WORDS),
      random.mutatedText('{"seed":7,"layers":[{"radius":30}]}', WORDS),
    ]);
  return random.several(4, () => `${random.pick(names)}=${value().replaceAll('\n', ' ')}`).join('\n');
}

function getter(text: string): (name: string) => string | null {
  const pairs = new Map(text.split('\n').map((line) => [line.split('=', 1)[0] ?? '', line.slice(line.indexOf('=') + 1)]));
  return (name) => pairs.get(name) ?? null;
}

for (const [element, names, links, read, table] of [
  ['rocks', [...ATTRIBUTES], LINKS, readAttributes, ROCKS],
  [
    'a log',
    ['src', 'preset', 'bases', 'ground', 'camera-orbit', 'color', ...WOOD_EAR_ATTRIBUTES.keys()],
    WOOD_EAR_LINKS,
    readWoodEarAttributes,
    WOOD_EARS,
  ],
] as const) {
  fuzz({
    name: `any attributes give ${element} that can be generated`,
    cases: 2000,
    make: (random) => attributes(random, names, links),
    check(text) {
      const { params, notices, orbit, metresPerPixel } = read(getter(text));
      table.resolve(params);
      assertPlain(notices.map(({ message }) => message));
      assert.ok(metresPerPixel > 0 && metresPerPixel <= 1000);
      for (const angle of [orbit?.azimuth ?? 0, orbit?.elevation ?? 0, orbit?.distance?.value ?? 1]) assert.ok(Number.isFinite(angle));
    },
  });
}

const JSONS = [
  '{"preset":"journal-fig1","seed":7,"layers":[{"radius":30,"areaFraction":0.5,"taper":[1,2,3]},{"id":4,"cellCount":null}]}',
  '{"notation":"relative","imageWidth":256,"layers":[]}',
  '{"preset":"fallen-log","log":{"length":200},"bases":[{"position":[0,0,20],"range":null}],"ground":""}',
  '{"log":{"positions":[0,0,0,1,0,0,0,1,0],"indices":[0,1,2]}}',
];
const TOKENS = [
  'null',
  'true',
  '-1',
  '1e999',
  '"x"',
  '[]',
  '{}',
  '[1,2,3]',
  ',',
  ':',
  '"__proto__":{"seed":1}',
  '"seed":',
  '"layers":',
  '"bases":[null]',
  '"log":',
  '"toString":1',
  '\\u0000',
];

for (const [what, resolve] of [
  ['rocks', resolveParams],
  ['a log', (request: object) => WOOD_EARS.resolve(request)],
] as const) {
  fuzz({
    name: `any JSON is parameters of ${what}, or an error of ours`,
    cases: 4000,
    make: (random) => random.mutatedText(random.pick(JSONS), TOKENS),
    check(text) {
      let request: unknown;
      try {
        request = JSON.parse(text);
      } catch {
        return;
      }
      try {
        resolve(request as object);
      } catch (thrown) {
        assert.ok(thrown instanceof RockFieldError, String(thrown));
        assertPlain([thrown.message]);
      }
    },
  });
}

/** Messages are short, in one line, and without gaps. */
function assertPlain(messages: readonly string[]): void {
  for (const message of messages) {
    assert.ok(message.length < 400, message);
    assert.doesNotMatch(message, /undefined|\[object|\n|\{(key|given|used|min|max)\}/);
  }
}
