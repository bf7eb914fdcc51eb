// Every attribute there is: absent, valid, malformed, each changed while a run is under way. A new one without a row here fails.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { tables } from '../../scripts/tables.mjs';
import { launch, pageOf } from './browser.mjs';

const { PARAMS, attributeOf } = await tables();

/** Attributes that are no parameters: `[valid, malformed]`; what is only there or not cannot be malformed. */
const OTHERS = {
  src: ['#v=1&preset=journal-fig12a&w=200&h=150', '{ "seed": '],
  preset: ['riverbed', 'journal-fig99'],
  view: ['diagrams', 'sideways'],
  color: ['natural', 'LAYER'],
  quality: ['low', 'best'],
  theme: ['dark', 'sepia'],
  'camera-orbit': ['45deg 55deg 120%', '45 55'],
  interaction: ['always', 'sometimes'],
  loading: ['lazy', 'late'],
  'metres-per-pixel': ['0.05', '-1'],
  poster: ['data:,', null],
  disabled: ['', null],
  'auto-rotate': ['', null],
  controls: ['', null],
};

/** Of the three layers of the default preset, for what belongs to a layer. */
function parameterRow(spec) {
  const repeat = (word) => (spec.scope === 'layer' ? [word, word, word].join(' ') : word);
  if (spec.kind === 'choice') return [repeat(spec.choices.at(-1).value), repeat('nonsense')];
  // Quick to generate; of all others any value but the default does.
  const quick = { seed: '7', radius: '40', imageWidth: '320', imageHeight: '240', packing: '0.5', cellCount: '5' };
  return [repeat(quick[spec.key] ?? String(spec.default === spec.slider.min ? spec.slider.max : spec.slider.min)), repeat('much')];
}

const ROWS = { ...Object.fromEntries(PARAMS.map((spec) => [attributeOf(spec), parameterRow(spec)])), ...OTHERS };

/** @type {import('./browser.mjs').Session} */
let session;
/** One for all rows: they take an element each. */
let opened;

before(async () => {
  const html =
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>attributes</title><link rel="icon" href="data:,"><script type="module" src="/rock-field.js"></script>';
  session = await launch({ intercept: pageOf('attributes.html', () => html) });
  opened = await session.open('attributes.html');
});

after(() => session?.close());

test('every attribute of the element has a row, and every row an attribute', async () => {
  const observed = await opened.page.evaluate(() =>
    customElements
      .whenDefined('rock-field')
      .then((element) => /** @type {typeof HTMLElement & { observedAttributes: string[] }} */ (element).observedAttributes),
  );
  assert.deepEqual(Object.keys(ROWS).sort(), [...observed].sort());
});

for (const [name, [valid, malformed]] of Object.entries(ROWS)) {
  test(`${name}: absent without a word, valid taken, malformed its default and one warning that names it, all during a run`, async () => {
    const { page, errors, warnings } = opened;
    warnings.length = 0;
    const seen = await page.evaluate(
      async ([name, valid, malformed]) => {
        await customElements.whenDefined('rock-field');
        const element = document.createElement('rock-field');
        const heard = [];
        element.addEventListener('notice', ({ detail }) => heard.push(`notice ${detail.message}`));
        element.addEventListener('error', ({ detail }) => heard.push(`error ${detail.error.message}`));
        element.setAttribute('backend', 'null');
        // Small, but where the size itself is asked about.
        for (const side of ['image-width', 'image-height']) if (side !== name) element.setAttribute(side, '256');
        document.body.append(element);
        const state = () =>
          JSON.stringify([
            element.params,
            element.view,
            element.color,
            element.quality,
            element.theme,
            element.cameraOrbit === valid,
            element.interaction,
            element.metresPerPixel,
          ]);
        const during = async (change) => {
          element.generate().catch(() => {});
          change();
          await element.getField();
          return { state: state(), heard: heard.splice(0) };
        };
        const absent = await during(() => {});
        const taken = await during(() => element.setAttribute(name, valid));
        const wrong = malformed === null ? null : await during(() => element.setAttribute(name, malformed));
        const gone = await during(() => element.removeAttribute(name));
        element.remove();
        return { absent, taken, wrong, gone };
      },
      [name, valid, malformed],
    );
    const { absent, taken, wrong, gone } = seen;
    assert.deepEqual([absent.heard, taken.heard, gone.heard], [[], [], []]);
    assert.equal(gone.state, absent.state, 'taken away it is not as if it had never been there');
    if (wrong) {
      if (name !== 'loading') assert.notEqual(taken.state, absent.state, `${valid} changes nothing`);
      assert.equal(wrong.state, absent.state, 'malformed it is not its default');
      assert.equal(wrong.heard.length, 1, wrong.heard.join('; '));
      assert.match(wrong.heard[0], new RegExp(`^notice ${name}: `));
    }
    assert.equal(warnings.filter((text) => text.includes('<rock-field>')).length, wrong ? 1 : 0);
    assert.deepEqual(errors, []);
  });
}
