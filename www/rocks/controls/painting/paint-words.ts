/** The words of painting on the ground. */

import { filled } from '../../../base/filled.ts';
import type { Slots } from '../../../base/filled.ts';
import type { Language, Words } from '../../../base/language.ts';

export const PAINT_WORDS = {
  heading: { en: 'Paint', ja: 'ペイント' },
  help: {
    en: 'Paint on the ground where rocks are to be, where none are, or a path that stays free. Links have the strokes.',
    ja: '岩を増やす場所、なくす場所、空けておく道を地面に描きます。描いた線はリンクに含まれます。',
  },
  one: { en: '1 stroke', ja: '線 1 本' },
  many: { en: '{n} strokes', ja: '線 {n} 本' },
  begin: { en: 'Paint on the ground', ja: '地面に描く' },
  end: { en: 'Done', ja: '終了' },
  clear: { en: 'Remove all strokes', ja: '線をすべて消す' },
  bar: { en: 'Brush', ja: 'ブラシ' },
  mode: { en: 'What the brush does', ja: 'ブラシの働き' },
  'mode-add': { en: 'Add', ja: '増やす' },
  'mode-erase': { en: 'Erase', ja: '消す' },
  'mode-path': { en: 'Path', ja: '道' },
  'mode-restore': { en: 'Restore', ja: '戻す' },
  'help-add': { en: 'Every cell below the brush becomes a rock.', ja: 'ブラシの下のセルがすべて岩になります。' },
  'help-erase': { en: 'No rock stands below the brush.', ja: 'ブラシの下に岩を置きません。' },
  'help-path': { en: 'No rock reaches into the path.', ja: '道に岩がかからないようにします。' },
  'help-restore': { en: 'As if nothing had been painted there.', ja: '何も描いていない状態に戻します。' },
  layer: { en: 'Layer', ja: '層' },
  allLayers: { en: 'All layers', ja: 'すべての層' },
  width: { en: 'Width', ja: '太さ' },
  keys: {
    en: 'Drag to paint. Keys: arrows move the brush, Space puts it down and lifts it, [ and ] change its width, Esc ends.',
    ja: 'ドラッグで描きます。矢印キーで移動、スペースで描き始め・終わり、[ と ] で太さ、Esc で終了。',
  },
  down: { en: 'The brush is down.', ja: 'ブラシを下ろしました。' },
  up: { en: 'The brush is up.', ja: 'ブラシを上げました。' },
  mask: { en: 'Mask …', ja: 'マスク…' },
  maskHelp: {
    en: 'A picture says how dense the rocks stand where: white as the layers ask, black not at all. You can also drop it on the page.',
    ja: '画像の明るさで岩の密度を決めます。白は層の設定どおり、黒は岩なしです。ページへのドロップもできます。',
  },
  drop: {
    en: 'Drop a picture or file made here: its scene comes back. Any other picture is a mask for the rocks.',
    ja: 'ここで作った画像やファイルならそのシーンに戻り、ほかの画像なら岩のマスクになります',
  },
  maskRemove: { en: 'Remove the mask', ja: 'マスクを外す' },
  maskLeftOut: { en: 'The link does not hold the mask.', ja: 'マスクはリンクに含まれません。' },
  maskSet: { en: '{file} has no scene in it: it is the mask now', ja: '{file} にシーンはないため、マスクとして使います' },
} as const satisfies Record<string, Words>;

export type PaintKey = keyof typeof PAINT_WORDS;

export function paintWords(language: Language, key: PaintKey, slots: Slots = {}): string {
  return filled(PAINT_WORDS[key][language], slots);
}
