/** What may be wrong with a link, in Japanese; see `notices.ts`. */

import { filled } from '../base/filled.ts';
import type { Notice } from './notices.ts';

const NOTICES: Record<Notice['code'], string> = {
  'too-long': 'リンクが {given} 文字あります。最初の {used} 文字だけを読み込みました。',
  'unknown-key': 'リンク内の不明な項目を無視しました：{key}',
  'unknown-version': 'リンクのバージョン {given} は不明です。バージョン {used} として読み込みました。',
  'unknown-preset': 'プリセット「{given}」はありません。{used} を表示しています。',
  'unknown-choice': '{key}：「{given}」は選べません。{used} を使います。',
  'not-a-number': '{key}：「{given}」は数値ではありません。プリセットの値 {used} を使います。',
  clamped: '{key}：{given} は使えません。{min} 〜 {max} の範囲で指定してください。{used} を使います。',
  'not-whole': '{key}：{given} は整数でなければなりません。{used} を使います。',
  repeated: '{key} がリンク内に複数あります。最初のものを使います。',
  'unequal-lists': 'リンク内のリストが一致しません（{given}）。プリセットの値を使います。',
  'too-many-layers': 'リンクに {given} 層あります（{key}）。最初の {used} 層を表示しています。',
  'too-many-bases': 'リンクに基点が {given} 個あります（{key}）。最初の {used} 個を使います。',
  'bad-ids': '層の id（{given}）は互いに異なる整数でなければなりません。{used} を使います。',
  'bad-camera': 'camera：「{given}」はカメラ位置ではありません。全体を表示しています。',
  'bad-strokes': 'strokes：「{given}」は読み取れません。塗りなしで表示しています。',
};

export function japaneseNotice({ code, key, given, used, min, max }: Notice): string {
  return filled(NOTICES[code], { key, given, used, min, max });
}
