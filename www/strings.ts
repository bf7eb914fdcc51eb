/**
 * Every sentence of the page and the panel, in English and Japanese. What a parameter is called and does stands in its table
 * (`params.gen.ts`), what may be wrong with a link in `notices.ts`.
 *
 * Vocabulary as in DESIGN: site 母点, cell セル, layer 層, seed シード, rock 岩.
 */

import type { ErrorInfo } from './errors.ts';
import { filled } from './notices.ts';
import type { Slots } from './notices.ts';
import type { Language, Preset, Words } from './params.ts';

export const LANGUAGES = ['en', 'ja'] as const satisfies readonly Language[];

/** Each language in itself. */
export const LANGUAGE_NAMES: Words = { en: 'English', ja: '日本語' };

/** `{…}` is filled in by `translate`. */
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
  copied: { en: 'Link copied', ja: 'リンクをコピーしました' },
  embedCopied: { en: 'Embed code copied', ja: '埋め込みコードをコピーしました' },
  copyByHand: { en: 'The browser does not let this page copy. Copy the text here:', ja: 'ブラウザがコピーを許可していません。ここからコピーしてください：' },

  preset: { en: 'Preset', ja: 'プリセット' },
  presetHelp: { en: 'The figures of the two papers, as in their Table 1. The seed stays.', ja: '2つの論文の表1にある図。シードは変わりません。' },
  edited: { en: 'edited', ja: '変更あり' },
  journal: { en: 'Journal (2011)', ja: '論文誌（2011）' },
  conference: { en: 'Conference (2010)', ja: '会議（2010）' },
  previousSeed: { en: 'Previous seed', ja: '前のシード' },
  nextSeed: { en: 'Next seed', ja: '次のシード' },
  freshSeed: { en: 'Fresh random seed', ja: '新しい乱数シード' },

  layers: { en: 'Layers', ja: '層' },
  ground: { en: 'Ground and method', ja: '地面と手法' },
  statistics: { en: 'Statistics', ja: '統計' },
  page: { en: 'Page', ja: 'ページ' },
  layerCount: { en: '{n} layers', ja: '{n} 層' },
  layer: { en: 'Layer {n}', ja: '層 {n}' },
  addLayer: { en: 'Add layer', ja: '層を追加' },
  removeLayer: { en: 'Remove layer {n}', ja: '層 {n} を削除' },
  duplicateLayer: { en: 'Duplicate layer {n}', ja: '層 {n} を複製' },
  noLayers: { en: 'No layers: bare ground. Add one to grow rocks.', ja: '層がありません（地面のみ）。層を追加すると岩が生成されます。' },
  stopBy: { en: 'Fill by', ja: '配置の基準' },
  stopByHelp: { en: 'Grant cells until an area is filled, or until there is a number of rocks.', ja: '面積率に達するまで、または岩の個数に達するまでセルを割り当てます。' },
  byArea: { en: 'Area', ja: '面積' },
  byCount: { en: 'Count', ja: '個数' },
  taper: { en: 'Taper', ja: '幅' },
  height: { en: 'Height', ja: '高さ' },
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
  rocks: { en: 'Rocks', ja: '岩' },
  triangles: { en: 'Triangles', ja: '三角形' },
  covered: { en: 'Ground covered', ja: '被覆率' },
  sites: { en: 'Sites', ja: '母点' },
  ofTarget: { en: 'of N_p', ja: '／ N_p' },
  asked: { en: 'A_s asked', ja: 'A_s 要求' },
  reached: { en: 'Reached', ja: '達成' },
  sitesSaturated: { en: 'No free pixel was left', ja: '空き画素がなくなりました' },
  cellsSaturated: { en: 'Ran out of free cells', ja: '空きセルがなくなりました' },
  saturatedKey: { en: '● saturated: no free pixel (sites) or no free cell (area) was left.', ja: '● 飽和：空き画素（母点）または空きセル（面積）がなくなりました。' },
  saturated: { en: 'saturated', ja: '飽和' },
  time: { en: 'Time, ms', ja: '時間（ms）' },
  total: { en: 'Total', ja: '合計' },
  cached: { en: 'A dash: taken from the cache.', ja: '「–」はキャッシュから再利用。' },
  backend: { en: 'Drawn with', ja: '描画' },
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

  keysPicture: { en: 'In the picture', ja: '画像の操作' },
  keysPage: { en: 'Anywhere on the page', ja: 'ページ全体' },
  orbit: { en: 'Orbit', ja: '回転' },
  orbitBy: { en: 'drag, one finger, or arrow keys', ja: 'ドラッグ、1本指、矢印キー' },
  pan: { en: 'Pan', ja: '移動' },
  panBy: { en: 'right drag, two fingers, or Shift + arrow keys', ja: '右ドラッグ、2本指、Shift + 矢印キー' },
  zoom: { en: 'Zoom', ja: '拡大・縮小' },
  zoomBy: { en: 'wheel, pinch, or + and −', ja: 'ホイール、ピンチ、+ と −' },
  frameBy: { en: 'F or double-click', ja: 'F またはダブルクリック' },
  viewsBy: { en: '1, 2, 3, 4', ja: '1、2、3、4' },
  seeds: { en: 'Previous, next seed', ja: '前・次のシード' },
  seedsBy: { en: '[ and ]', ja: '[ と ]' },
  helpBy: { en: '?', ja: '?' },
  sliders: { en: 'Sliders', ja: 'スライダー' },
  slidersBy: { en: 'arrow keys, Page Up, Page Down, Home, End', ja: '矢印キー、Page Up、Page Down、Home、End' },
  undoBy: { en: 'Ctrl + Z or ⌘ Z', ja: 'Ctrl + Z または ⌘ Z' },
  redoBy: { en: 'Shift + Ctrl + Z or Shift + ⌘ Z', ja: 'Shift + Ctrl + Z または Shift + ⌘ Z' },

  clampedInField: { en: 'Allowed: {min} to {max}.', ja: '{min} 〜 {max} の範囲で入力してください。' },
  notANumber: { en: 'A number from {min} to {max}, please.', ja: '{min} 〜 {max} の数値を入力してください。' },
  notationClamped: { en: 'Some values are past the bounds of the new notation and were moved to them.', ja: '新しい単位系の範囲を超える値は、範囲の端に変更されました。' },
  lostPicture: { en: 'The graphics device was lost; the picture is back.', ja: '描画デバイスが失われましたが、画像を復元しました。' },
  pageFailed: { en: 'Something on this page failed: {message}', ja: 'ページでエラーが発生しました：{message}' },
} as const satisfies Record<string, Words>;

export type StringKey = keyof typeof STRINGS;

/** Errors of the element that a person at the page can read and act on; any other shows its own English message. */
const ERRORS: Record<string, Words> = {
  OutOfRange: { en: '{value} is not allowed; it has to lie in {min} to {max}.', ja: '{value} は使えません。{min} 〜 {max} の範囲で指定してください。' },
  NotAnInteger: { en: '{value} has to be a whole number.', ja: '{value} は整数でなければなりません。' },
  TooManyLayers: { en: 'At most {max} layers.', ja: '層は {max} 個までです。' },
  OverBudget: {
    en: 'This field would need about {valueMiB} MiB of memory; this device’s budget is {maxMiB} MiB. Change this value; the picture stays until then.',
    ja: 'この設定には約 {valueMiB} MiB のメモリが必要です（上限 {maxMiB} MiB）。この値を変更してください。それまで画像は変わりません。',
  },
  WasmUnavailable: {
    en: 'The generator could not be loaded. Check the connection, then reload the page.',
    ja: '生成プログラムを読み込めませんでした。接続を確認して、ページを再読み込みしてください。',
  },
  WorkerUnavailable: {
    en: 'The browser refused to start the generator’s worker. Reload the page, or try another browser.',
    ja: 'ブラウザが生成用ワーカーを起動できませんでした。再読み込みするか、別のブラウザをお試しください。',
  },
  WorkerLost: { en: 'The generator stopped and was started again. Change a value to try once more.', ja: '生成プログラムが停止したため再起動しました。値を変更すると再実行します。' },
};

export function translate(language: Language, key: StringKey, slots: Slots = {}): string {
  return filled(STRINGS[key][language], slots);
}

export function errorText(language: Language, error: ErrorInfo): string {
  const words = ERRORS[error.name];
  if (!words) return error.message;
  const mebibytes = (bytes: unknown) => (typeof bytes === 'number' ? Math.ceil(bytes / 2 ** 20) : '?');
  const { min, max } = error;
  return filled(words[language], { value: String(error.value), min, max, valueMiB: mebibytes(error.value), maxMiB: mebibytes(max) });
}

/** `journal-fig11a` → `Fig. 11 (a)`, with what sets it apart: `r 90 · c_h1 45`, or the layers' areas. */
export function presetLabel(language: Language, preset: Preset, columns: readonly string[]): string {
  const [, number = '', part = ''] = /fig(\d+)([a-z]?)$/.exec(preset.name) ?? [];
  const { layers } = preset;
  const figure = `Fig. ${number}${part && ` (${part})`}`;
  const areas = layers.map(([, area = 0]) => Math.round(100 * area)).join(' / ');
  if (layers.length > 1) return `${figure} – ${translate(language, 'layerCount', { n: layers.length })} · ${areas} %`;
  const [only = []] = layers;
  // The area is 0.5 in all of them.
  const numbers = only.flatMap((value, index) => (index !== 1 && value !== 0 ? [`${columns[index]} ${value}`] : []));
  return `${figure} – ${numbers.join(' · ')}`;
}

/** English or Japanese, whichever the list of preferred languages names first; English for all others. */
export function pickLanguage(preferred: readonly string[]): Language {
  const found = preferred.map((tag) => LANGUAGES.find((language) => tag.toLowerCase().split('-')[0] === language)).find(Boolean);
  return found ?? 'en';
}
