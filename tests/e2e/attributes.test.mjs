// Every attribute there is: absent, valid, malformed, each changed while a run is under way. A new one without a row here fails.
/** @import { Opened } from './browser.mjs' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { tables } from '../../scripts/lib/tables.mjs';
import { launch, pageOf } from './browser.mjs';

const { PARAMS, WOOD_EARS, attributeOf } = await tables();

/**
 * Attributes that are no parameters, of either element: `[valid, malformed, taken for]`, the last where a malformed one is not its
 * default; what is only there or not cannot be malformed.
 */
const COMMON = {
  view: ['wireframe', 'sideways'],
  color: ['natural', 'LAYER'],
  quality: ['low', 'best'],
  samples: ['0', 'many'],
  theme: ['dark', 'sepia'],
  'camera-orbit': ['45deg 55deg 120%', '45 55'],
  fov: ['60', '1e3', '120'],
  interaction: ['always', 'sometimes'],
  navigation: ['walk', 'fly'],
  loading: ['lazy', 'late'],
  'metres-per-pixel': ['0.05', '-1'],
  poster: ['data:,', null],
  disabled: ['', null],
  'auto-rotate': ['', null],
  controls: ['', null],
};

/**
 * Attributes by element. `quick` are values of parameters that are soon generated, of all others any value but the default is; `small` are the
 * attributes of an element that is, but for the one that is asked about.
 */
const ELEMENTS = {
  'rock-field': {
    rows: PARAMS,
    quick: { seed: '7', radius: '40', imageWidth: '320', imageHeight: '240', packing: '0.5', cellCount: '5' },
    small: { 'image-width': '256', 'image-height': '256' },
    own: {
      src: ['#v=1&preset=journal-fig12a&w=200&h=150', '{ "seed": '],
      preset: ['riverbed', 'journal-fig99'],
      strokes: ['BAggCggEggE', 'BAAg'],
    },
  },
  'wood-ear-log': {
    rows: WOOD_EARS.rows,
    quick: { seed: '7', density: '4', logLength: '60', logSpacing: '5' },
    small: { density: '2', 'log-length': '100', 'log-spacing': '6', ground: 'none' },
    own: {
      src: ['#v=1&preset=thesis-minimum&d=3', '{ "seed": '],
      preset: ['thesis-fig4-2', 'thesis-fig99'],
      bases: ['0 -20 20, 30 -20 20 30', '0 -20'],
      // Of a link, what is wrong gives way and what is right is taken.
      ground: ['v=1&preset=journal-fig1&r=200&a=0.3', 'v=1&preset=nowhere&seed=4', 'v=1&preset=journal-fig1&seed=4'],
      editable: ['', null],
    },
  },
};

/** Of the three layers of the default preset, for what belongs to a layer. */
function parameterRow(spec, quick) {
  const repeat = (word) => (spec.scope === 'layer' ? [word, word, word].join(' ') : word);
  if (spec.kind === 'choice') return [repeat(spec.choices.at(-1).value), repeat('nonsense')];
  return [repeat(quick[spec.key] ?? String(spec.default === spec.slider.min ? spec.slider.max : spec.slider.min)), repeat('much')];
}

const rowsOf = ({ rows, quick, own }) => ({
  ...Object.fromEntries(rows.map((spec) => [attributeOf(spec), parameterRow(spec, quick)])),
  ...COMMON,
  ...own,
});

/** @type {import('./browser.mjs').Session} */
let session;
/**
 * One for all rows: they take an element each.
 *
 * @type {Opened}
 */
let opened;

before(async () => {
  const html =
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>attributes</title><link rel="icon" href="data:,"><script type="module" src="/rock-field.js"></script><script type="module" src="/wood-ear-log.js"></script>';
  session = await launch({ intercept: pageOf('attributes.html', () => html) });
  opened = await session.open('attributes.html');
});

after(() => session?.close());

for (const [tag, { small, ...about }] of Object.entries(ELEMENTS)) {
  const rows = rowsOf(about);

  test(`${tag}: every attribute has a row, and every row an attribute`, async () => {
    const observed = await opened.page.evaluate(async (name) => {
      const element = await customElements.whenDefined(name);
      return /** @type {typeof HTMLElement & { observedAttributes: string[] }} */ (element).observedAttributes;
    }, tag);
    assert.deepEqual(Object.keys(rows).sort(), [...observed].sort());
  });

  for (const [name, [valid, malformed, takenFor = null]] of Object.entries(rows)) {
    test(`${tag} ${name}: absent without a word, valid taken, malformed its default and one warning that names it, all during a run`, async () => {
      const { page, errors, warnings } = opened;
      warnings.length = 0;
      const attributes = Object.entries(small).filter(([other]) => other !== name);
      const { absent, taken, wrong, like, gone } = await page.evaluate(changes, { tag, name, valid, malformed, takenFor, attributes });
      assert.deepEqual([absent.heard, taken.heard, gone.heard], [[], [], []]);
      assert.equal(gone.state, absent.state, 'taken away it is not as if it had never been there');
      if (wrong) {
        if (name !== 'loading') assert.notEqual(taken.state, absent.state, `${valid} changes nothing`);
        assert.equal(wrong.state, like.state, `malformed it is not ${takenFor ?? 'its default'}`);
        assert.equal(wrong.heard.length, 1, wrong.heard.join('; '));
        assert.match(wrong.heard[0], new RegExp(`^notice ${name}: `));
      }
      assert.equal(warnings.filter((text) => text.includes(`<${tag}>`)).length, wrong ? 1 : 0);
      assert.deepEqual(errors, []);
    });
  }
}

/** In the page: what an element says and is while an attribute is absent, valid, malformed and gone again, each set while a run is under way. */
async function changes({ tag, name, valid, malformed, takenFor, attributes }) {
  const element = /** @type {typeof a} */ (document.createElement(tag));
  const heard = [];
  element.addEventListener('notice', ({ detail }) => heard.push(`notice ${detail.message}`));
  element.addEventListener('error', ({ detail }) => heard.push(`error ${detail.error.message}`));
  element.setAttribute('backend', 'null');
  for (const [other, value] of attributes) element.setAttribute(other, value);
  document.body.append(element);
  const state = () =>
    JSON.stringify([
      element.params,
      element.view,
      element.color,
      element.quality,
      element.samples,
      element.theme,
      element.cameraOrbit === valid,
      element.fov,
      element.interaction,
      element.navigation,
      element.metresPerPixel,
    ]);
  const during = async (change) => {
    element.generate().catch(() => {});
    change();
    await (element.getField ?? element.getColony).call(element);
    return { state: state(), heard: heard.splice(0) };
  };
  const absent = await during(() => {});
  const taken = await during(() => element.setAttribute(name, valid));
  const wrong = malformed === null ? null : await during(() => element.setAttribute(name, malformed));
  const like = takenFor === null ? absent : await during(() => element.setAttribute(name, takenFor));
  const gone = await during(() => element.removeAttribute(name));
  element.remove();
  return { absent, taken, wrong, like, gone };
}
