/** What may be wrong with a link, in English and Japanese. Apart from the page's sentences, since an element reads links too. */

import { filled } from './filled.ts';
import type { Language, Words } from './params.ts';
import type { Notice } from './url-codec.ts';

/** What is wrong in a link; `{key}` names it. */
const NOTICES: Record<Notice['code'], Words> = {
  'too-long': {
    en: 'The link has {given} characters; only the first {used} were read.',
    ja: 'リンクが {given} 文字あります。最初の {used} 文字だけを読み込みました。',
  },
  'unknown-key': { en: 'The link has something unknown in it, which was ignored: {key}.', ja: 'リンク内の不明な項目を無視しました：{key}' },
  'unknown-version': { en: 'The link is of version {given}, which this page does not know; it was read as version {used}.', ja: 'リンクのバージョン {given} は不明です。バージョン {used} として読み込みました。' },
  'unknown-preset': { en: 'There is no preset “{given}”; {used} is shown.', ja: 'プリセット「{given}」はありません。{used} を表示しています。' },
  'unknown-choice': { en: '{key}: “{given}” is not a choice; {used} is used.', ja: '{key}：「{given}」は選べません。{used} を使います。' },
  'not-a-number': { en: '{key}: “{given}” is not a number; the preset’s value {used} is used.', ja: '{key}：「{given}」は数値ではありません。プリセットの値 {used} を使います。' },
  clamped: { en: '{key}: {given} is not allowed ({min} to {max}); {used} is used.', ja: '{key}：{given} は使えません（{min} 〜 {max}）。{used} を使います。' },
  repeated: { en: '{key} stands more than once in the link; the first one counts.', ja: '{key} がリンク内に複数あります。最初のものを使います。' },
  'unequal-lists': { en: 'The link’s lists of layers differ in length ({given}); the preset’s layers are shown.', ja: 'リンク内の層の数が一致しません（{given}）。プリセットの層を表示しています。' },
  'too-many-layers': { en: 'The link has {given} layers ({key}); the first {used} are shown.', ja: 'リンクに {given} 層あります（{key}）。最初の {used} 層を表示しています。' },
  'bad-ids': { en: 'The layers’ ids ({given}) have to be different whole numbers; {used} is used.', ja: '層の id（{given}）は互いに異なる整数でなければなりません。{used} を使います。' },
  'bad-camera': { en: 'camera: “{given}” is not a camera position; the whole field is shown.', ja: 'camera：「{given}」はカメラ位置ではありません。全体を表示しています。' },
};

export function noticeText(language: Language, notice: Omit<Notice, 'text'>): string {
  const { key, given, used, min, max } = notice;
  return filled(NOTICES[notice.code][language], { key, given, used, min, max });
}
