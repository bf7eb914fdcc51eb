/** The sentences of what comes later: errors, the statistics, the presets to choose from, the keys. As in `strings.ts`. */

import type { ErrorInfo, ErrorName } from '../base/errors.ts';
import { japaneseFailure } from '../base/failures.ja.ts';
import { filled } from '../base/filled.ts';
import type { Slots } from '../base/filled.ts';
import { shown } from '../table/param-checks.ts';
import type { Language, Words } from '../base/language.ts';

export const LATER = {
  keepShape: { en: 'Keep height and taper when the radius changes', ja: '半径を変えても幅と高さを保つ' },
  stopBy: { en: 'Fill by', ja: '配置の基準' },
  stopByHelp: {
    en: 'Grant cells until an area is filled, or until there is a number of rocks.',
    ja: '面積率に達するまで、または岩の個数に達するまでセルを割り当てます。',
  },
  byArea: { en: 'Area', ja: '面積' },
  byCount: { en: 'Count', ja: '個数' },
  docsHelp: { en: 'How to put these rocks on a page of yours, with live examples.', ja: 'この岩を自分のページに埋め込む方法（英語）。' },
  pageFailed: { en: 'Something on this page failed: {message}', ja: 'ページでエラーが発生しました：{message}' },
  layerCount: { en: '{n} layers', ja: '{n} 層' },
  natural: { en: 'Natural grounds', ja: '自然の地面' },
  copied: { en: 'Link copied', ja: 'リンクをコピーしました' },
  embedCopied: { en: 'Embed code copied', ja: '埋め込みコードをコピーしました' },
  copyByHand: {
    en: 'The browser does not let this page copy. Copy the text here:',
    ja: 'ブラウザがコピーを許可していません。ここからコピーしてください：',
  },
  export: { en: 'Export', ja: '書き出す' },
  exportHelp: {
    en: 'Save the scene as a file for Blender, Unreal, Unity, Godot, three.js or a 3D printer.',
    ja: 'Blender、Unreal、Unity、Godot、three.js、3D プリンター用のファイルとして保存します。',
  },
  exportFor: { en: 'For', ja: '用途' },
  'target-gltf': { en: 'Any program (glTF)', ja: '汎用（glTF）' },
  'target-print': { en: '3D printing', ja: '3D プリント' },
  exportContent: { en: 'Save', ja: '保存するもの' },
  'content-meshes': { en: 'Meshes', ja: 'メッシュ' },
  'content-points': { en: 'Points', ja: '点群' },
  'content-maps': { en: 'Maps', ja: 'マップ' },
  exportMap: { en: 'Map', ja: 'マップ' },
  'map-height': { en: 'Heights', ja: '高さ' },
  'map-normal': { en: 'Normals', ja: '法線' },
  'map-id': { en: 'Numbers of the rocks (ID)', ja: '岩の番号（ID）' },
  'map-cover': { en: 'Where rocks are (mask)', ja: '岩の範囲（マスク）' },
  'map-contact': { en: 'Foot of the rocks (mask for grass)', ja: '岩の足元（草よけマスク）' },
  'map-splat': { en: 'Rock, gravel, foot, ground (splat)', ja: '岩・砂利・足元・地面（スプラット）' },
  'map-all': { en: 'All of them, and points', ja: 'すべてのマップと点群' },
  exportUse: { en: 'Use', ja: '使い道' },
  'samples-centres': { en: 'Texture', ja: 'テクスチャ' },
  'samples-corners': { en: 'Landscape', ja: '地形' },
  exportSide: { en: 'Pixels', ja: 'ピクセル' },
  sideOfField: { en: 'As the image', ja: '画像と同じ' },
  exportMesh: { en: 'Rocks as', ja: '岩の形式' },
  'mesh-rocks': { en: 'Objects', ja: '個別' },
  'mesh-kit': { en: 'Copies of a few', ja: '少数の複製' },
  'mesh-one': { en: 'A mesh per layer', ja: '層ごとに結合' },
  exportEars: { en: 'Wood ears as', ja: 'キクラゲの形式' },
  'mesh-one-colony': { en: 'A mesh per colony', ja: '群生ごとに結合' },
  exportSurfaces: { en: 'Surfaces', ja: '面' },
  'surfaces-grown': { en: 'As grown', ja: 'そのまま' },
  exportFormat: { en: 'File', ja: 'ファイル形式' },
  exportBottom: { en: 'Undersides', ja: '底面' },
  'bottom-open': { en: 'Open', ja: 'なし' },
  'bottom-closed': { en: 'Closed', ja: '閉じる' },
  exportBelow: { en: 'Below ground', ja: '地面の下' },
  'below-kept': { en: 'Kept', ja: '残す' },
  'below-cut': { en: 'Cut off', ja: '切り取る' },
  cutBelow: { en: 'Cut off below ground', ja: '地面の下を切り取る' },
  exportTextures: { en: 'Textures', ja: 'テクスチャ' },
  'textures-none': { en: 'None', ja: 'なし' },
  exportTexels: { en: 'The textures have {texels} texels per metre.', ja: 'テクスチャの解像度は 1 m あたり {texels} テクセルです。' },
  exportGround: { en: 'Ground', ja: '地面' },
  'ground-none': { en: 'None', ja: 'なし' },
  'ground-cut': { en: 'Between the rocks', ja: '岩の間だけ' },
  'ground-whole': { en: 'Under them too', ja: '岩の下も' },
  exportParts: { en: 'Split', ja: '分割' },
  'parts-one': { en: 'No', ja: 'しない' },
  'parts-many': { en: '{n} files in a ZIP', ja: '{n} ファイル（ZIP）' },
  splitInto: { en: 'Split into {n} files', ja: '{n} ファイルに分割' },
  noLevels: { en: 'One LOD level', ja: 'LOD を 1 段に' },
  exportWriting: { en: 'Writing the file …', ja: 'ファイルを作成しています…' },
  exportLods: { en: 'LOD levels', ja: 'LOD の段数' },
  exportLevels: { en: 'Triangles of the levels: {triangles}', ja: '各詳細度の三角形：{triangles} 枚' },
  exportHulls: { en: '{n} convex hulls for physics, {triangles} triangles', ja: '物理演算用の凸包 {n} 個、三角形 {triangles} 枚' },
  exportFigures: {
    en: '{name}: {size}, {objects} objects, {triangles} triangles',
    ja: '{name}：{size}、オブジェクト {objects} 個、三角形 {triangles} 枚',
  },
  pictureHelp: {
    en: 'Save what is shown as a postcard, or as a picture of any size, with the ground or without.',
    ja: '表示中のシーンを、ポストカードや任意の大きさの画像（地面なしも可）として保存します。',
  },
  pictureKind: { en: 'Kind of picture', ja: '画像の種類' },
  'picture-postcard': { en: 'Postcard', ja: 'ポストカード' },
  'picture-picture': { en: 'Picture', ja: '画像' },
  'picture-cutout': { en: 'No ground', ja: '地面なし' },
  pictureSize: { en: 'Longer side', ja: '長辺' },
  pictureSamples: { en: 'Samples of light', ja: '光のサンプル数' },
  'samples-none': { en: 'None: as on the screen', ja: 'なし：画面と同じ' },
  'samples-16': { en: '16: soft shade', ja: '16：柔らかい陰影' },
  'samples-64': { en: '64: for print', ja: '64：印刷用' },
  'samples-256': { en: '256: finest, takes minutes', ja: '256：最高品質（数分かかります）' },
  pictureAperture: { en: 'Depth of field', ja: '被写界深度' },
  'aperture-none': { en: 'None: all is sharp', ja: 'なし：全体にピントが合う' },
  'aperture-8': { en: 'f/8: the distance a little soft', ja: 'f/8：遠くがわずかにぼける' },
  'aperture-2.8': { en: 'f/2.8: as a bright lens', ja: 'f/2.8：明るいレンズ' },
  'aperture-1.2': { en: 'f/1.2: as the brightest', ja: 'f/1.2：最も明るいレンズ' },
  'aperture-0.4': { en: 'f/0.4: as of a miniature', ja: 'f/0.4：ミニチュア風' },
  'size-screen': { en: 'As on the screen', ja: '画面と同じ' },
  'size-3840': { en: '3,840 pixels', ja: '3,840 ピクセル' },
  'size-7680': { en: '7,680 pixels', ja: '7,680 ピクセル' },
  'size-16384': { en: '16,384 pixels', ja: '16,384 ピクセル' },
  postcardSeed: { en: 'Seed {seed}', ja: 'シード {seed}' },
  postcardNote: {
    en: 'Its code opens the scene on a telephone. Dropped on this page, the file brings it back.',
    ja: 'コードを読み取るとスマートフォンでシーンが開きます。ファイルをこのページにドロップしても復元できます。',
  },
  pictureNote: {
    en: 'Dropped on this page, the file brings its scene back.',
    ja: 'ファイルをこのページにドロップすると、シーンを復元できます。',
  },
  shareFile: { en: 'Share …', ja: '共有…' },
  openFile: { en: 'Open', ja: '開く' },
  openFileHelp: {
    en: 'Brings back the scene of a picture or file that was saved here. You can also drop it on the page, or paste it.',
    ja: 'ここで保存した画像やファイルから、そのシーンを復元します。ページへのドロップや貼り付けもできます。',
  },
  dropFile: {
    en: 'Drop a picture or file made here: its scene comes back',
    ja: 'ここで作った画像やファイルをドロップすると、そのシーンに戻ります',
  },
  sceneBack: { en: 'The scene of {file} is back', ja: '{file} のシーンを復元しました' },
  scenePasted: { en: 'The pasted scene is shown', ja: '貼り付けたシーンを表示しました' },
  sceneDiffers: {
    en: 'Not quite what {file} shows: another version of this page made it, or its log came from a file.',
    ja: '{file} とは一部異なります。別のバージョンで作られたか、丸太がファイルから読み込まれたものです。',
  },
  otherPage: { en: '{file} is a scene of the page “{page}”.', ja: '{file} は「{page}」のページのシーンです。' },
  pastedOther: { en: 'That is a scene of the page “{page}”.', ja: '「{page}」のページのシーンです。' },
  openThere: { en: 'Open it there', ja: 'そのページで開く' },
  pointFigures: { en: '{name}: {size}, {objects} points', ja: '{name}：{size}、点 {objects} 個' },
  mapFigures: {
    en: '{name}: {size}, {width} × {height} pixels of {pixel} m',
    ja: '{name}：{size}、{width} × {height} ピクセル、1 ピクセルは {pixel} m',
  },
  save: { en: 'Save', ja: '保存' },
  'note-plain-colours': {
    en: 'Each material has one colour. The patterns of stone, wood and flesh, moss, snow and dust are drawn here alone.',
    ja: '材質ごとに単色になります。石や木、キクラゲの模様、苔、雪、砂埃はここだけで描画されます。',
  },
  'note-no-colours': { en: 'This kind of file has no colours.', ja: 'この形式には色がありません。' },
  'note-no-objects': {
    en: 'This kind of file has no objects: everything is one mesh.',
    ja: 'この形式にはオブジェクトがなく、すべてが 1 つのメッシュになります。',
  },
  'note-below-ground': {
    en: 'Worn rocks have skirts below the ground, which show where there is none.',
    ja: '風化した岩には地面の下に隠れる裾があり、地面がないと見えます。',
  },
  'note-ground-is-open': {
    en: 'The ground is a sheet without a thickness. Only the rocks are closed.',
    ja: '地面は厚みのない面です。閉じるのは岩だけです。',
  },
  'note-no-units': {
    en: 'This kind of file has no units. One unit is {unit}.',
    ja: 'この形式には単位がありません。1 単位は {unit} です。',
  },
  'note-many-objects': {
    en: '{count} objects: many programs take long to open so many. Fewer meshes, or fewer in each file, open faster.',
    ja: 'オブジェクトが {count} 個あります。多くのソフトでは開くのに時間がかかります。メッシュを少なくまとめるか、ファイルを分けると速く開けます。',
  },
  'note-compressed': {
    en: 'Programs that do not know EXT_meshopt_compression cannot open it.',
    ja: 'EXT_meshopt_compression に対応していないソフトでは開けません。',
  },
  'note-few-readers': { en: 'Few programs read the copies.', ja: '複製を読み込めるソフトは多くありません。' },
  'note-no-device': {
    en: 'Textures are drawn by a graphics device, and there is none here: each rock has one colour.',
    ja: 'テクスチャの描画に必要な GPU が使えないため、岩は単色になります。',
  },
  'note-kit-differs': {
    en: 'Copies are like the rocks of the picture, not the same.',
    ja: '複製は画像の岩に似た形で、同一ではありません。',
  },
  'note-thickened': {
    en: 'These wood ears are sheets. To be solid they have been made 1.5 mm thick.',
    ja: '厚みのないキクラゲを、立体にするため 1.5 mm の厚さにしました。',
  },
  'note-crosses-itself': {
    en: '{count} objects pass through themselves. Slicers join what overlaps; Boolean operations may not.',
    ja: '{count} 個のオブジェクトが自己交差しています。スライサーでは問題ありませんが、ブーリアン演算では失敗することがあります。',
  },
  'note-open-log': { en: 'The log is not closed, so that it is not solid.', ja: '丸太は閉じていないため、立体ではありません。' },
  'note-log-not-in-link': {
    en: 'The log from your file is in no link: that of the file shows a grown one.',
    ja: '読み込んだ丸太はリンクに含まれません。保存されるリンクでは生成した丸太が表示されます。',
  },
  'note-in-parts': {
    en: 'The parts have one origin: import all of them at the same place.',
    ja: '各ファイルの原点は共通です。すべて同じ位置に読み込んでください。',
  },
  'note-kinds-of-kit': {
    en: 'Kinds are the meshes of “Copies of a few”, saved as GLB.',
    ja: '種類の番号は、GLB に保存した「少数の複製」のメッシュに対応します。',
  },
  'note-no-header': {
    en: 'This kind of file has no header. Tell the program the width and height, 16 bits, little-endian.',
    ja: 'この形式にはヘッダーがありません。読み込む際に幅と高さ、16 ビット、リトルエンディアンを指定してください。',
  },
  'note-height-range': {
    en: 'In 16 bits 0 is the ground, and 65535 is {highest} m.',
    ja: '16 ビットの値は、0 が地面、65535 が {highest} m です。',
  },
  'note-in-metres': { en: 'The numbers are metres.', ja: '値の単位はメートルです。' },
  'note-green-up': { en: 'Green points up, as in OpenGL.', ja: '緑は上向きです（OpenGL 形式）。' },
  'note-green-down': { en: 'Green points down, as in DirectX.', ja: '緑は下向きです（DirectX 形式）。' },
  'note-data': {
    en: 'Import as linear data (non-colour), without sRGB.',
    ja: 'sRGB ではなく、リニアデータ（Non-Color）として読み込んでください。',
  },
  rocks: { en: 'Rocks', ja: '岩' },
  triangles: { en: 'Triangles', ja: '三角形' },
  covered: { en: 'Ground covered', ja: '被覆率' },
  sites: { en: 'Sites', ja: '母点' },
  ofTarget: { en: 'of N_p', ja: '／ N_p' },
  asked: { en: 'A_s asked', ja: 'A_s 要求' },
  reached: { en: 'Reached', ja: '達成' },
  sitesSaturated: { en: 'No free pixel was left', ja: '空き画素がなくなりました' },
  cellsSaturated: { en: 'Ran out of free cells', ja: '空きセルがなくなりました' },
  saturatedKey: {
    en: '● saturated: no free pixel (sites) or no free cell (area) was left.',
    ja: '● 飽和：空き画素（母点）または空きセル（面積）がなくなりました。',
  },
  saturated: { en: 'saturated', ja: '飽和' },
  time: { en: 'Time, ms', ja: '時間（ms）' },
  total: { en: 'Total', ja: '合計' },
  cached: { en: 'A dash: taken from the cache.', ja: '「–」はキャッシュから再利用。' },
  backend: { en: 'Drawn with', ja: '描画' },
  keysPicture: { en: 'In the picture', ja: '画像の操作' },
  walk: { en: 'Walk at eye height', ja: '目の高さで歩く' },
  walkBy: {
    en: 'W A S D or arrows, Shift to run, drag to look, double-click to go there, two fingers; Esc to leave',
    ja: 'W A S D か矢印キー、Shift で走る、ドラッグで見回す、ダブルクリックでその場所へ、2本指で歩く、Esc で終了',
  },
  keysPage: { en: 'Anywhere on the page', ja: 'ページ全体' },
  orbit: { en: 'Orbit', ja: '回転' },
  orbitBy: { en: 'drag, one finger, or arrow keys', ja: 'ドラッグ、1本指、矢印キー' },
  pan: { en: 'Pan', ja: '移動' },
  panBy: { en: 'right drag, two fingers, or Shift + arrow keys', ja: '右ドラッグ、2本指、Shift + 矢印キー' },
  zoom: { en: 'Zoom', ja: '拡大・縮小' },
  zoomBy: { en: 'wheel, pinch, or + and −', ja: 'ホイール、ピンチ、+ と −' },
  frameBy: { en: 'F or double-click; again: closer', ja: 'F またはダブルクリック（もう一度で近づく）' },
  viewsBy: { en: '1, 2, 3, 4', ja: '1、2、3、4' },
  seeds: { en: 'Previous, next seed', ja: '前・次のシード' },
  seedsBy: { en: '[ and ]', ja: '[ と ]' },
  helpBy: { en: '?', ja: '?' },
  sliders: { en: 'Sliders', ja: 'スライダー' },
  slidersBy: { en: 'arrow keys, Page Up, Page Down, Home, End', ja: '矢印キー、Page Up、Page Down、Home、End' },
  undoBy: { en: 'Ctrl + Z or ⌘ Z', ja: 'Ctrl + Z または ⌘ Z' },
  redoBy: { en: 'Shift + Ctrl + Z or Shift + ⌘ Z', ja: 'Shift + Ctrl + Z または Shift + ⌘ Z' },
  layLog: { en: 'Lay the log on these rocks', ja: 'この岩の上に丸太を置く' },
  shapeClamped: {
    en: 'Some heights or tapers have reached their bounds. They come back with the radius.',
    ja: '一部の高さや幅が範囲の端に達しました。半径を戻すと元の値に戻ります。',
  },
  notationClamped: {
    en: 'Some values are past the bounds of the new notation and were moved to them.',
    ja: '新しい単位系の範囲を超える値は、範囲の端に変更されました。',
  },
} as const satisfies Record<string, Words>;

export type LaterKey = keyof typeof LATER;

export function later(language: Language, key: LaterKey, slots: Slots = {}): string {
  return filled(LATER[key][language], slots);
}

/** Errors of the element that a person at the page can read and act on; any other shows its own message. */
const ERRORS: Partial<Record<ErrorName, Words>> = {
  OutOfRange: { en: '{value} must be between {min} and {max}.', ja: '{value} は使えません。{min} 〜 {max} の範囲で指定してください。' },
  NotAnInteger: { en: '{value} must be a whole number.', ja: '{value} は整数でなければなりません。' },
  TooManyLayers: { en: 'At most {max} layers.', ja: '層は {max} 個までです。' },
  OverBudget: {
    en: 'This would need about {valueMiB} MiB of memory, and this device’s budget is {maxMiB} MiB, so it is not shown.',
    ja: 'この設定には約 {valueMiB} MiB のメモリが必要ですが、上限が {maxMiB} MiB のため表示できません。',
  },
};

export function errorText(language: Language, error: ErrorInfo): string {
  const words = ERRORS[error.name];
  // Nothing is to be filled into these, and they quote what files say.
  if (error.words) return error.words[language];
  if (!words) return language === 'ja' ? japaneseFailure(error.message) : error.message;
  const mebibytes = (bytes: unknown) => (typeof bytes === 'number' ? Math.ceil(bytes / 2 ** 20) : '?');
  const { min, max } = error;
  return filled(words[language], { value: shown(error.value), min, max, valueMiB: mebibytes(error.value), maxMiB: mebibytes(max) });
}
