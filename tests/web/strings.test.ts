// The catalogue: both languages say everything, and say it with the same slots.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LAYER_ROWS } from '../../www/rocks/request.ts';
import { LABELS_JA } from '../../www/controls/labels.ja.gen.ts';
import { PARAM_DOCS } from '../../www/rocks/param-docs.gen.ts';
import { PARAMS, PRESETS } from '../../www/rocks/params.ts';
import { WOOD_EAR_DOCS } from '../../www/wood-ear/param-docs.gen.ts';
import { WOOD_EAR_PARAMS } from '../../www/wood-ear/params.gen.ts';
import { japaneseNotice } from '../../www/table/notices.ja.ts';
import { noticeText } from '../../www/table/notices.ts';
import { presetLabel } from '../../www/rocks/controls/preset-groups.ts';
import { LATER, errorText } from '../../www/controls/strings-later.ts';
import { STRINGS_JA } from '../../www/controls/strings.ja.ts';
import { STRINGS } from '../../www/controls/strings.en.ts';
import { presetName } from '../../www/rocks/words.ts';
import { LANGUAGES, labelOf, loadJapanese, pickLanguage, translate } from '../../www/controls/strings.ts';
import type { StringKey } from '../../www/controls/strings.en.ts';
import { WOOD_EAR_STRINGS } from '../../www/wood-ear/controls/strings.ts';
import type { ErrorInfo } from '../../www/base/errors.ts';
import type { Words } from '../../www/base/language.ts';
import { decodeLink } from '../../www/rocks/link.ts';

const slots = (text: string) => [...text.matchAll(/\{\w+\}/g)].map(([slot]) => slot).sort();

test('every string exists in both languages, with the same slots', () => {
  const catalogue = Object.entries(STRINGS).map(([key, en]): [string, Words] => [key, { en, ja: STRINGS_JA[key as StringKey] }]);
  for (const [key, words] of [...catalogue, ...Object.entries({ ...LATER, ...WOOD_EAR_STRINGS })]) {
    for (const language of LANGUAGES) assert.ok(words[language].trim(), `${key} ${language}`);
    assert.deepEqual(slots(words.ja), slots(words.en), key);
  }
});

test('every parameter has a label and a sentence in both languages', () => {
  for (const [rows, docs] of [
    [PARAMS, PARAM_DOCS],
    [WOOD_EAR_PARAMS, WOOD_EAR_DOCS],
  ] as const) {
    for (const { url, label, choices } of rows) {
      for (const language of LANGUAGES) assert.ok(docs[url]?.[language], url);
      for (const words of [label, ...choices.map((choice) => choice.label)]) assert.ok(words && LABELS_JA[words], `${url}: ${words}`);
    }
  }
});

test('what is not there in Japanese yet is English', async () => {
  const said = () => [translate('ja', 'layer', { n: 3 }), labelOf('ja', 'Seed')];
  assert.deepEqual(said(), ['Layer 3', 'Seed']);
  await loadJapanese();
  assert.deepEqual(said(), ['層 3', 'シード']);
});

test('slots are filled, and no slot is left open', async () => {
  await loadJapanese();
  assert.equal(translate('en', 'layer', { n: 3 }), 'Layer 3');
  assert.equal(translate('ja', 'layer', { n: 3 }), '層 3');
  const links = [
    '#v=2',
    '#preset=x',
    '#u=x',
    '#w=x',
    '#w=0',
    '#seed=1&seed=2',
    '#r=1&a=1,2',
    '#r=1,1,1,1,1,1,1,1,1',
    '#id=1,1,1',
    '#camera=x',
    '#zzz=1',
    `#${'x'.repeat(2e5)}`,
  ];
  const seen = new Set<string>();
  for (const notice of links.flatMap((link) => decodeLink(link).notices)) {
    seen.add(notice.code);
    assert.equal(notice.text, noticeText(notice));
    for (const text of [notice.text, japaneseNotice(notice)]) assert.doesNotMatch(text, /[{}]|undefined/);
    assert.match(japaneseNotice(notice), /[ぁ-ん]/);
  }
  assert.equal(seen.size, 12);
});

test('errors are put into words; an unknown one shows its own message', () => {
  const budget: ErrorInfo = { name: 'OverBudget', key: 'radius', value: 3 * 2 ** 30, min: 0, max: 1.5 * 2 ** 30, message: 'too big' };
  assert.match(errorText('en', budget), /3072 MiB.*1536 MiB/);
  assert.match(errorText('ja', budget), /3072 MiB.*1536 MiB/);
  // The list of names is closed, but a file of another version may be answering.
  const unknown = 'SomethingNew' as never;
  assert.equal(errorText('ja', { name: unknown, message: 'as it is' }), 'as it is');
});

test('no sentence has two places', () => {
  assert.deepEqual(
    Object.keys(LATER).filter((key) => key in STRINGS),
    [],
  );
});

test('each preset has a name of its own in both languages', () => {
  for (const language of LANGUAGES) assert.equal(new Set(PRESETS.map((preset) => presetName(language, preset))).size, PRESETS.length);
  assert.deepEqual(
    [presetName('en', { name: 'riverbed' }), presetName('ja', { name: 'riverbed' }), presetName('en', { name: 'journal-fig12a' })],
    ['Riverbed', '河原', 'Journal (2011), Fig. 12 (a)'],
  );
  for (const preset of PRESETS)
    assert.notEqual(presetName('en', preset), presetName('ja', preset), `${preset.name} has no name in Japanese`);
});

test('each preset of a paper has a name of its own', () => {
  const columns = LAYER_ROWS.filter(({ kind }) => kind !== 'optional-integer').map(({ label }) => label.split(' ').at(-1) ?? '');
  for (const paper of ['journal', 'conference']) {
    const names = PRESETS.filter(({ name }) => name.startsWith(paper)).map((preset) => presetLabel('en', preset, columns));
    assert.equal(new Set(names).size, names.length);
    for (const name of names) assert.match(name, /^Fig\.\u00a0\d+(\u00a0\([a-f]\))? – ./);
  }
});

test('the language follows the browser', () => {
  assert.equal(pickLanguage(['ja-JP', 'en']), 'ja');
  assert.equal(pickLanguage(['de', 'ja']), 'ja');
  assert.equal(pickLanguage(['en-GB', 'ja']), 'en');
  assert.equal(pickLanguage(['fr']), 'en');
  assert.equal(pickLanguage([]), 'en');
});
