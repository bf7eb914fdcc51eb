/**
 * What the element itself says when it fails, in Japanese, by the English message: `{…}` stands for what differs, which may be a message
 * of the list again. A test looks that no failure of a file, a worker or a renderer is missing.
 */

import { filled } from './filled.ts';

const FAILURES: Readonly<Record<string, string>> = {
  // generator/pool-worker.ts, wood-ear/log-file/client.ts, rocks/export-client.ts, wood-ear/export-client.ts
  "the generator's worker could not be started: {reason}": '生成用のワーカーを起動できませんでした：{reason}',
  "the generator's worker could not be started; its file is missing, or blocked by a Content-Security-Policy or by Cross-Origin-Embedder-Policy, which it must be served with too":
    '生成用のワーカーを起動できませんでした。ファイルがないか、Content-Security-Policy または Cross-Origin-Embedder-Policy によって遮断されています（後者はワーカーのファイルにも必要です）',
  'the worker that reads log files could not be started: {reason}': '丸太ファイルを読み込むワーカーを起動できませんでした：{reason}',
  'the worker that reads log files could not be started (wood-ear-file-worker.js is missing or blocked)':
    '丸太ファイルを読み込むワーカーを起動できませんでした（wood-ear-file-worker.js がないか、遮断されています）',
  'the worker that writes files could not be started: {reason}': 'ファイルを書き出すワーカーを起動できませんでした：{reason}',
  'the worker that writes files could not be started (wood-ear-export-worker.js is missing or blocked)':
    'ファイルを書き出すワーカーを起動できませんでした（wood-ear-export-worker.js がないか、遮断されています）',
  'the worker that writes files could not be started (export-worker.js is missing or blocked)':
    'ファイルを書き出すワーカーを起動できませんでした（export-worker.js がないか、遮断されています）',
  'its script does not arrive; check the connection': 'スクリプトが届きません。接続を確認してください',
  'its script does not arrive': 'スクリプトが届きません',
  'it does not arrive': '届きません',
  'its script says nothing; is it the right file?': 'スクリプトが応答しません。正しいファイルか確認してください',
  'its answer could not be read': '応答を読み取れませんでした',
  'the server answered {status}': 'サーバーの応答は {status} です',
  "the page's Content-Security-Policy must allow the policy: trusted-types rock-field":
    'ページの Content-Security-Policy で trusted-types rock-field を許可してください',
  'the generator stopped without an answer, twice; try smaller settings':
    '生成プログラムが 2 回続けて応答なく停止しました。設定を小さくしてお試しください',
  'the generator failed ({reason}); please report this with its link':
    '生成プログラムでエラーが発生しました（{reason}）。リンクを添えてご報告ください',
  // base/wasm-file.ts, generator/wasm.ts
  '{file} could not be fetched: {reason}': '{file} を取得できませんでした：{reason}',
  '{file} could not be fetched; check the connection': '{file} を取得できませんでした。接続を確認してください',
  '{file} stopped arriving after {bytes} bytes; check the connection':
    '{file} の受信が {bytes} バイトで止まりました。接続を確認してください',
  '{file} is not a wasm file: the server sent something without a type instead':
    '{file} は wasm ファイルではありません：種類の不明なデータが届きました',
  '{file} is not a wasm file: the server sent {type} instead': '{file} は wasm ファイルではありません：代わりに {type} が届きました',
  "{file} may not be compiled: a Content-Security-Policy must allow 'wasm-unsafe-eval'":
    "{file} をコンパイルできません：Content-Security-Policy で 'wasm-unsafe-eval' を許可してください",
  '{file} could not be started: the file is damaged, or this browser is too old for it':
    '{file} を開始できませんでした：ファイルが壊れているか、ブラウザが古すぎます',
  "the generator's wasm could not be read: {reason}": '生成プログラムの wasm を読み取れませんでした：{reason}',
  // base/errors.ts
  'a script could not be fetched ({reason}); reload the page':
    'スクリプトを取得できませんでした（{reason}）。ページを再読み込みしてください',
  // scene/renderer-keeper.ts, scene/drawn-element.ts, scene/picture.ts
  'The rocks cannot be drawn here. {reason}': 'ここでは描画できません。{reason}',
  'the picture could not be made: {reason}': '画像を作成できませんでした：{reason}',
  'the picture could not be drawn: {reason}': '画像を描画できませんでした：{reason}',
  'the result could not be shown: {reason}': '結果を表示できませんでした：{reason}',
  'the view could not be shown: {reason}': '表示を切り替えられませんでした：{reason}',
};

const PATTERNS = Object.entries(FAILURES).map(([english, japanese]) => ({
  pattern: new RegExp(`^${english.replace(/[.*+?^$()|[\]\\]/g, '\\$&').replace(/\{(\w+)\}/g, '(?<$1>.+)')}$`, 's'),
  japanese,
}));

/** The message in Japanese; one that is not in the list stays as it is. */
export function japaneseFailure(message: string): string {
  for (const { pattern, japanese } of PATTERNS) {
    const groups = pattern.exec(message)?.groups;
    if (groups || pattern.test(message))
      return filled(japanese, { ...groups, ...(groups?.['reason'] && { reason: japaneseFailure(groups['reason']) }) });
  }
  return message;
}
