/**
 * The sentences of the page and the panel, in English and Japanese. What a parameter is called and does stands in its table
 * (`params.gen.ts`), what may be wrong with a link in `notices.ts`.
 *
 * Vocabulary as in DESIGN: site 母点, cell セル, layer 層, seed シード, rock 岩.
 */

import { filled } from './filled.ts';
import type { Slots } from './filled.ts';
import type { Language, Preset, PRESETS, Words } from './params.ts';

export const LANGUAGES = ['en', 'ja'] as const satisfies readonly Language[];

/** Each language in itself. */
export const LANGUAGE_NAMES: Words = { en: 'English', ja: '日本語' };

/** The papers whose figures are presets, as the presets' names begin. */
export const PAPERS = ['journal', 'conference'] as const;
export type Paper = (typeof PAPERS)[number];

type NaturalName = Extract<(typeof PRESETS)[number], { natural: true }>['name'];

const NATURAL_NAMES: Record<NaturalName, Words> = {
  riverbed: { en: 'Riverbed', ja: '河原' },
  'beach-cobbles': { en: 'Beach cobbles', ja: '浜の丸石' },
  scree: { en: 'Scree', ja: 'ガレ場' },
  moraine: { en: 'Moraine', ja: 'モレーン' },
  'desert-pavement': { en: 'Desert pavement', ja: '砂漠の礫原' },
  'lava-field': { en: 'Lava field', ja: '溶岩原' },
  'dry-garden': { en: 'Dry garden', ja: '枯山水' },
  'forest-floor': { en: 'Forest floor', ja: '林床' },
  'quarry-rubble': { en: 'Quarry rubble', ja: '採石場の砕石' },
  shingle: { en: 'Shingle', ja: '砂利浜' },
};

/** What is on the page from the start, or may be at any moment; the rest is in `strings-later.ts`. `{…}` is filled in by `translate`. */
export const STRINGS = {
  title: { en: 'rock-field', ja: 'rock-field' },
  skip: { en: 'Skip to the controls', ja: '設定へ移動' },
  picture: { en: 'Picture', ja: '画像' },
  controls: { en: 'Controls', ja: '設定' },

  undo: { en: 'Undo', ja: '元に戻す' },
  redo: { en: 'Redo', ja: 'やり直す' },
  reset: { en: 'Reset to the preset', ja: 'プリセットに戻す' },
  randomise: { en: 'Randomise', ja: 'ランダムに変更' },
  share: { en: 'Share', ja: '共有' },
  shareHelp: { en: 'Copies a link that shows exactly these rocks.', ja: 'まったく同じ岩を表示するリンクをコピーします。' },
  shareSettingsHelp: { en: 'Copies a link that holds these settings.', ja: 'この設定を含むリンクをコピーします。' },
  embed: { en: 'Copy embed code', ja: '埋め込みコードをコピー' },
  embedHelp: { en: 'Two lines of HTML that show these rocks on any page.', ja: 'どのページにもこの岩を表示できる、2行のHTMLをコピーします。' },
  docs: { en: 'Docs', ja: 'ドキュメント' },
  docsHelp: { en: 'How to put these rocks on a page of yours, with live examples.', ja: 'この岩を自分のページに埋め込む方法（英語）。' },
  help: { en: 'Keys and gestures', ja: 'キーとジェスチャー' },
  close: { en: 'Close', ja: '閉じる' },
  dismiss: { en: 'Dismiss', ja: '閉じる' },
  cancel: { en: 'Cancel', ja: '中止' },

  preset: { en: 'Preset', ja: 'プリセット' },
  presetHelp: { en: 'Natural grounds, and the figures of the two papers as in their Table 1. The seed stays.', ja: '自然の地面と、2つの論文の表1にある図。シードは変わりません。' },
  edited: { en: 'edited', ja: '変更あり' },
  journal: { en: 'Journal (2011)', ja: '論文誌（2011）' },
  conference: { en: 'Conference (2010)', ja: '会議（2010）' },
  previousSeed: { en: 'Previous seed', ja: '前のシード' },
  nextSeed: { en: 'Next seed', ja: '次のシード' },
  freshSeed: { en: 'Fresh random seed', ja: '新しい乱数シード' },

  look: { en: 'Look', ja: '見た目' },
  layers: { en: 'Layers', ja: '層' },
  ground: { en: 'Ground and method', ja: '地面と手法' },
  statistics: { en: 'Statistics', ja: '統計' },
  page: { en: 'Page', ja: 'ページ' },
  layer: { en: 'Layer {n}', ja: '層 {n}' },
  addLayer: { en: 'Add layer', ja: '層を追加' },
  removeLayer: { en: 'Remove layer {n}', ja: '層 {n} を削除' },
  duplicateLayer: { en: 'Duplicate layer {n}', ja: '層 {n} を複製' },
  noLayers: { en: 'No layers: bare ground. Add one to grow rocks.', ja: '層がありません（地面のみ）。層を追加すると岩が生成されます。' },
  stopBy: { en: 'Fill by', ja: '配置の基準' },
  stopByHelp: { en: 'Grant cells until an area is filled, or until there is a number of rocks.', ja: '面積率に達するまで、または岩の個数に達するまでセルを割り当てます。' },
  byArea: { en: 'Area', ja: '面積' },
  byCount: { en: 'Count', ja: '個数' },
  shape: { en: 'Taper and height', ja: '幅と高さ' },
  wear: { en: 'Wear', ja: '風化と埋まり' },
  oneRock: { en: '1 rock', ja: '岩 1 個' },
  someRocks: { en: '{n} rocks', ja: '岩 {n} 個' },

  view: { en: 'View', ja: '表示' },
  'view-3d': { en: '3D', ja: '3D' },
  'view-wireframe': { en: 'Wireframe', ja: 'ワイヤー' },
  'view-diagrams': { en: 'Diagrams', ja: '分割図' },
  'view-selection': { en: 'Selection', ja: '選択図' },
  color: { en: 'Colour', ja: '配色' },
  'color-layer': { en: 'Layer', ja: '層' },
  'color-rock': { en: 'Rock', ja: '岩' },
  'color-plain': { en: 'Plain', ja: '単色' },
  'color-natural': { en: 'Natural', ja: '自然' },
  frameAll: { en: 'Frame all', ja: '全体を表示' },
  fullScreen: { en: 'Full screen', ja: '全画面表示' },
  leaveFullScreen: { en: 'Leave full screen', ja: '全画面表示を終了' },
  language: { en: 'Language', ja: '言語' },
  theme: { en: 'Theme', ja: 'テーマ' },
  'theme-auto': { en: 'Auto', ja: '自動' },
  'theme-light': { en: 'Light', ja: 'ライト' },
  'theme-dark': { en: 'Dark', ja: 'ダーク' },

  summary: { en: '{rocks} · {triangles} triangles · {covered} covered', ja: '{rocks}・三角形 {triangles}・被覆率 {covered}' },
  notYet: { en: 'Waiting for the first field …', ja: '最初の生成を待っています…' },
  'stage-sites': { en: 'Sites', ja: '母点' },
  'stage-cells': { en: 'Cells', ja: 'セル' },
  'stage-selection': { en: 'Selection', ja: '選択' },
  'stage-shape': { en: 'Shape', ja: '形状' },
  'stage-mesh': { en: 'Mesh', ja: 'メッシュ' },
  working: { en: 'Generating: {stage}, {percent}', ja: '生成中：{stage}、{percent}' },
  cancelled: { en: 'Cancelled: back to the settings of this picture.', ja: '中止しました。この画像の設定に戻りました。' },
  helpHint: { en: 'Point at a control to read what it does. Press ? for the keys.', ja: '項目を指すと説明が表示されます。? でキー一覧。' },
  helpHintShort: { en: 'Point at a control to read what it does.', ja: '項目を指すと説明が表示されます。' },

  clampedInField: { en: 'Allowed: {min} to {max}.', ja: '{min} 〜 {max} の範囲で入力してください。' },
  notANumber: { en: 'A number from {min} to {max}, please.', ja: '{min} 〜 {max} の数値を入力してください。' },
  lostPicture: { en: 'The graphics device was lost; the picture is back.', ja: '描画デバイスが失われましたが、画像を復元しました。' },
  pageFailed: { en: 'Something on this page failed: {message}', ja: 'ページでエラーが発生しました：{message}' },
} as const satisfies Record<string, Words>;

export type StringKey = keyof typeof STRINGS;

export function translate(language: Language, key: StringKey, slots: Slots = {}): string {
  return filled(STRINGS[key][language], slots);
}

/** `Riverbed`; of a figure `Journal (2011), Fig. 11 (a)`. */
export function presetName(language: Language, { name }: Pick<Preset, 'name'>): string {
  const natural = NATURAL_NAMES[name as NaturalName] as Words | undefined;
  return natural?.[language] ?? `${translate(language, paperOf(name))}${language === 'ja' ? '、' : ', '}${figureOf(name)}`;
}

/** The paper of a preset that is a figure. */
export function paperOf(name: string): Paper {
  return PAPERS.find((paper) => name.startsWith(paper)) ?? PAPERS[0];
}

/** `journal-fig11a` → `Fig. 11 (a)`. */
export function figureOf(name: string): string {
  const [, number = '', part = ''] = /fig(\d+)([a-z]?)$/.exec(name) ?? [];
  return `Fig. ${number}${part && ` (${part})`}`;
}

/** English or Japanese, whichever the list of preferred languages names first; English for all others. */
export function pickLanguage(preferred: readonly string[]): Language {
  const found = preferred.map((tag) => LANGUAGES.find((language) => tag.toLowerCase().split('-')[0] === language)).find(Boolean);
  return found ?? 'en';
}
