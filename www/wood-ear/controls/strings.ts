/** The sentences of the wood ears' page and panel, in English and Japanese; as in `controls/strings.ts`. Vocabulary as in the thesis: 基点, 群生, 含水率, シワの密度, サイズ. */

import { filled } from '../../base/filled.ts';
import type { Slots } from '../../base/filled.ts';
import type { Language, Words } from '../../base/language.ts';
import type { WoodEarStage } from '../session.ts';
import type { WOOD_EAR_PRESETS } from '../params.gen.ts';

type NaturalName = Extract<(typeof WOOD_EAR_PRESETS)[number], { natural: true }>['name'];

export const WOOD_EAR_STRINGS = {
  presetHelp: {
    en: 'Colonies as they are found, and the figures of the thesis. The seed stays.',
    ja: '自然の群生と、論文の図。シードは変わりません。',
  },
  shareHelp: { en: 'Copies a link that shows exactly this log.', ja: 'まったく同じ丸太を表示するリンクをコピーします。' },
  embedHelp: {
    en: 'Two lines of HTML that show this log on any page.',
    ja: 'どのページにもこの丸太を表示できる、2行のHTMLをコピーします。',
  },
  natural: { en: 'As they are found', ja: '自然の群生' },
  thesis: { en: 'Figures of the thesis (2012)', ja: '論文の図（2012）' },
  'wet-colony': { en: 'Wet colony', ja: '湿った群生' },
  'dry-colony': { en: 'Dry colony', ja: '乾いた群生' },
  'wrinkled-colony': { en: 'Wrinkled colony', ja: 'シワの多い群生' },
  'fallen-log': { en: 'Fallen log', ja: '倒木' },
  'thesis-default': { en: 'Default settings', ja: '初期設定' },
  'thesis-minimum': { en: 'Minimum settings', ja: '最小設定' },
  'thesis-maximum': { en: 'Maximum settings', ja: '最大設定' },
  figure: { en: 'Fig. {n}', ja: '図{n}' },

  colony: { en: 'Colony', ja: '群生' },
  bases: { en: 'Bases', ja: '基点' },
  base: { en: 'Base {n}', ja: '基点 {n}' },
  addBase: { en: 'Add base', ja: '基点を追加' },
  removeBase: { en: 'Remove base {n}', ja: '基点 {n} を削除' },
  basesHint: { en: 'Click the log to place one, drag its ring to move it.', ja: '丸太をクリックで追加、輪をドラッグで移動。' },
  rangeOf: { en: 'Range', ja: '範囲' },
  rangeHelp: {
    en: 'How far this base spreads: as the whole colony, or a range of its own.',
    ja: 'この基点の広がり：群生全体の範囲か、独自の範囲。',
  },
  ofColony: { en: 'Colony’s', ja: '群生と同じ' },
  ownRange: { en: 'Its own', ja: '独自' },
  form: { en: 'Form', ja: '形' },
  log: { en: 'Log', ja: '丸太' },
  logFile: { en: 'Open a GLB or OBJ file', ja: 'GLB・OBJ ファイルを開く' },
  removeLogFile: { en: 'Back to the grown log', ja: '生成した丸太に戻す' },
  logFileNote: { en: 'This log is from a file. It is in no link.', ja: 'ファイルの丸太です。リンクには含まれません。' },
  logLeftOut: {
    en: 'The log from your file is not in it; it shows a grown log.',
    ja: 'ファイルの丸太は含まれず、生成した丸太が表示されます。',
  },
  ground: { en: 'Ground', ja: '地面' },
  groundHelp: { en: 'The rocks that the log lies on; none grows through it.', ja: '丸太が載る地面。岩は丸太を貫きません。' },
  bare: { en: 'Bare soil', ja: '土のみ' },
  ownGround: { en: 'From a link', ja: 'リンクの地面' },
  groundSeed: { en: 'Other rocks', ja: '別の岩' },
  openGround: { en: 'Edit these rocks', ja: 'この岩を編集' },

  summary: { en: '{ears} · {triangles} triangles · {crossing} crossing', ja: '{ears}・三角形 {triangles}・交差 {crossing}' },
  ears: { en: '{n} wood ears', ja: 'キクラゲ {n} 個' },
  oneEar: { en: '1 wood ear', ja: 'キクラゲ 1 個' },
  individuals: { en: 'Wood ears', ja: 'キクラゲ' },
  crossing: { en: 'Crossing pairs', ja: '交差する組' },
  kept: { en: 'Radius kept', ja: '残った半径' },
  keptHelp: { en: 'median · tenth percentile, after collisions', ja: '衝突後の中央値・10パーセンタイル' },
  rocks: { en: 'Rocks', ja: '岩' },
  thesisLeaves: {
    en: 'The thesis’s rule leaves these pairs crossing; “Pressed” leaves none.',
    ja: '論文の方法ではこれらの組が交差したまま残ります。「押し合い」では残りません。',
  },
  usePressed: { en: 'Use Pressed', ja: '「押し合い」を使う' },
  'stage-log': { en: 'Log', ja: '丸太' },
  'stage-spawn': { en: 'Places', ja: '発生位置' },
  'stage-deform': { en: 'Forms', ja: '変形' },
  'stage-collide': { en: 'Collisions', ja: '衝突' },
  'stage-mesh': { en: 'Mesh', ja: 'メッシュ' },
} as const satisfies Record<string, Words> & Record<`stage-${WoodEarStage}` | NaturalName, Words>;

export type WoodEarStringKey = keyof typeof WOOD_EAR_STRINGS;

export function woodEarText(language: Language, key: WoodEarStringKey, slots: Slots = {}): string {
  return filled(WOOD_EAR_STRINGS[key][language], slots);
}

/** `Wet colony`; of a figure `Fig. 4.10`. */
export function woodEarPresetName(language: Language, name: string): string {
  if (name in WOOD_EAR_STRINGS) return woodEarText(language, name as WoodEarStringKey);
  return woodEarText(language, 'figure', { n: name.replace(/^thesis-fig/, '').replace('-', '.') });
}
