// Generated from src/params/ by `UPDATE=1 cargo test --test params`; never edited.

import type { Words } from '../base/language.ts';

/** What every parameter does, by its key in links; apart from the table, so that no first picture waits for it. */
export const WOOD_EAR_DOCS: Readonly<Record<string, Words>> = {
  seed: { en: "The same seed and parameters give the same colony, byte for byte, everywhere.", ja: "同じシードと設定なら、どの環境でも同じ群生が1バイトも違わず生成されます。" },
  d: { en: "Share of the places within range (the log's vertices) that carry a wood ear.", ja: "範囲内にある丸太の頂点のうち、キクラゲが生える割合。" },
  r: { en: "How far from its base point the colony spreads, in a straight line.", ja: "群生が基点から広がる直線距離。" },
  m: { en: "Dry wood ears shrink and curl; at 100 none does.", ja: "乾くほど縮んで丸まります。100では変形しません。" },
  w: { en: "How far folds pull the surface towards the axis.", ja: "シワが表面を軸の方へ引き込む強さ。" },
  s: { en: "Median rim radius before drying: wet wood ears are 3 to 6 cm wide.", ja: "乾燥前の縁の半径の中央値。湿ったキクラゲの幅は3〜6cmです。" },
  sp: { en: "Sizes lie between the size divided and multiplied by this; at 1 all are equal.", ja: "サイズはこの値で割った値から掛けた値までの間になります。1ではすべて同じです。" },
  pi: { en: "How far wrinkling differs between individuals; at 1 some have no wrinkles at all.", ja: "シワの強さの個体差。1ではシワのない個体も現れます。" },
  co: { en: "Wood ears pass through each other, step inward as the thesis has it (a few stay crossed), or press flat against each other (none cross).", ja: "重なりを許すか、論文どおり内側へ縮めるか（一部は交差が残ります）、平らに押し合わせるか（交差は残りません）。" },
  dr: { en: "Bends wood ears downward, the wetter the more: on the log's flank they hang like ears.", ja: "湿っているほど下へ垂れ、丸太の側面では耳のように下がります。" },
  th: { en: "Of the wet flesh at the foot; thinner at the rim and when dry. At 0 they are the thesis's sheets.", ja: "湿った状態の根元の厚み。縁や乾燥時は薄くなります。0では論文どおりの面です。" },
  ft: { en: "A short stalk into the log that closes the hole of the first ring; 0 leaves the hole.", ja: "最初の輪の穴をふさいで丸太に入る短い柄。0では穴のままです。" },
  cl: { en: "Keeps wood ears from passing through the log.", ja: "キクラゲが丸太を突き抜けないようにします。" },
  e: { en: "Rings of vertices from the foot to the rim (Eq. 3.1).", ja: "根元から縁までの頂点の輪の数（式3.1）。" },
  f: { en: "Vertices on a ring (Eq. 3.1); below 19, wrinkles are coarser than the ring can show.", ja: "1つの輪の頂点数（式3.1）。19未満ではシワを表しきれません。" },
  ll: { en: "Length of the log, which lies on the ground along x.", ja: "x 方向に横たわる丸太の長さ。" },
  lr: { en: "Mean radius of the log.", ja: "丸太の平均半径。" },
  lb: { en: "How far the log is bowed.", ja: "丸太の曲がりの強さ。" },
  lk: { en: "Depth of the furrows of the bark, and of knots and splinters; at 0 the log is smooth.", ja: "樹皮の溝・節・折れ口のささくれの深さ。0では滑らかです。" },
  ls: { en: "Mean distance of the places where a wood ear can stand: the log's vertices or, on a mesh of your own, points spread over its surface.", ja: "キクラゲが生えうる位置の平均間隔。位置は丸太の頂点、独自のメッシュではその表面に広げた点です。" },
  lg: { en: "Another log for the same colony's settings.", ja: "同じ設定で別の丸太を作ります。" },
  var: { en: "How far wood ears differ from each other in colour.", ja: "個体ごとの色の違いの大きさ。" },
  tl: { en: "How much light shines through thin and wet flesh.", ja: "薄く湿った部分を光が透ける度合い。" },
  ve: { en: "Fine down on the outer side.", ja: "外側の細かい産毛。" },
  sa: { en: "Where the sun stands, counted like the camera's azimuth: at the same angle it is behind the viewer.", ja: "太陽の方位。カメラの方位角と同じ向きに数え、同じ角度なら見る人の背後にあります。" },
  se: { en: "How high the sun stands; a low sun throws long shadows.", ja: "太陽の高さ。低いほど影が長くなります。" },
  bx: { en: "Where the colony spreads from, along the log; the nearest vertex of the log is taken.", ja: "群生の基点（丸太に沿う向き）。最も近い丸太の頂点に合わせます。" },
  by: { en: "Where the colony spreads from, across the log.", ja: "群生の基点（丸太を横切る向き）。" },
  bz: { en: "Where the colony spreads from, above the ground.", ja: "群生の基点（地面からの高さ）。" },
  br: { en: "How far the colony spreads from this base; without it, the colony's range.", ja: "この基点からの広がり。省くと群生範囲と同じです。" },
};
