// Generated from src/params/ by `UPDATE=1 cargo test --test params`; never edited.

import type { Words } from '../base/language.ts';

/** What every parameter does, by its key in links; apart from the table, so that no first picture waits for it. */
export const PARAM_DOCS: Readonly<Record<string, Words>> = {
  seed: { en: "The same seed and parameters give the same rocks, byte for byte, everywhere.", ja: "同じシードと設定なら、どの環境でも同じ岩が1バイトも違わず生成されます。" },
  w: { en: "Width of the ground seen from above.", ja: "真上から見た地面の幅。" },
  h: { en: "Depth of the ground seen from above.", ja: "真上から見た地面の奥行き。" },
  cd: { en: "How many sites are asked for (Eq. 1); from about 0.55 on, no pixel is left free.", ja: "要求する母点の数（式1）。約0.55以上では空き画素がなくなるまで配置します。" },
  u: { en: "Lengths in pixels (journal), or in hundredths of the width with heights in radii (conference).", ja: "長さの単位：画素（論文誌）、または幅の1/100で高さは半径の倍数（会議版）。" },
  darts: { en: "Throw until nothing is free, or exactly N_p times as Fig. 4 is written.", ja: "空きがなくなるまで投げるか、図4の記述どおり N_p 回だけ投げるか。" },
  border: { en: "Cells at the border are clipped to the image and kept, or dropped.", ja: "画像の縁にかかるセルを切り取って残すか、除外するか。" },
  swing: { en: "Taper and height share their random numbers (wide rocks are the tall ones), or draw their own.", ja: "幅と高さで同じ乱数を使う（幅広の岩ほど高い）か、別々の乱数を使うか。" },
  cross: { en: "Rocks may pass through their neighbours, as in the papers, or each keeps to its own side.", ja: "論文どおり隣の岩に食い込んでもよいか、岩どうしが交わらないようにするか。" },
  var: { en: "How far the rocks differ from each other in colour and value, in natural colours.", ja: "自然な配色での、岩ごとの色と明るさの違いの大きさ。" },
  wet: { en: "Wet stone is darker and glossy.", ja: "濡れた石は暗く、つやが出ます。" },
  moss: { en: "Moss grows in patches, where the rocks are low and face up.", ja: "低い所や上を向いた面に、まだらに苔が生えます。" },
  dust: { en: "Dust of the ground lies low on the rocks and on what faces up.", ja: "岩の低い所と上を向いた面に、地面の砂ぼこりが積もります。" },
  snow: { en: "Snow covers the ground, and what faces up.", ja: "雪は地面と、上を向いた面に積もります。" },
  water: { en: "Clear water stands over the ground; at 1, over the highest rock.", ja: "澄んだ水が地面を覆います。1で一番高い岩まで届きます。" },
  soil: { en: "What lies between and around the rocks, in natural colours.", ja: "自然な配色での、岩の間とまわりの地面。" },
  sa: { en: "Where the sun stands, counted like the camera's azimuth: at the same angle it is behind the viewer.", ja: "太陽の方位。カメラの方位角と同じ向きに数え、同じ角度なら見る人の背後にあります。" },
  se: { en: "How high the sun stands; a low sun throws long shadows.", ja: "太陽の高さ。低いほど影が長くなります。" },
  r: { en: "No two sites of the layer are closer than this, so it sets the size of the rocks.", ja: "この層の母点どうしの最小距離。岩の大きさを決めます。" },
  a: { en: "Share of the whole ground that this layer's rocks may fill.", ja: "この層の岩が占めてよい、地面全体に対する面積の割合。" },
  n: { en: "Number of rocks in this layer; when given, it replaces the area.", ja: "この層の岩の個数。指定すると面積率の代わりに使われます。" },
  w1: { en: "Moves the tops outward (overhangs) or, if negative, inward (pointed rocks).", ja: "上面の頂点を外へ（張り出し）、負なら内へ（尖った岩）動かします。" },
  w2: { en: "Adds a random part of the move, one number per rock.", ja: "岩ごとに1つの乱数で変化する移動量を加えます。" },
  w3: { en: "Adds a random part of the move, one number per vertex: the outline grows ragged.", ja: "頂点ごとの乱数で移動量を加え、輪郭を不規則にします。" },
  h1: { en: "Height that every top vertex has at least.", ja: "上面のすべての頂点が持つ最低の高さ。" },
  h2: { en: "Adds up to this much height, one random number per rock.", ja: "岩ごとの乱数で、最大この値まで高さを加えます。" },
  h3: { en: "Adds up to this much height, one random number per vertex: the top grows rugged.", ja: "頂点ごとの乱数で、最大この値まで高さを加え、上面を起伏させます。" },
  we: { en: "Off, the papers' facets; from 0.2, freshly broken stone, worn at its edges and corners first; at 1, rounded by a river.", ja: "0 は論文どおりの面。0.2 から割れたばかりの石となり、角や稜から先に摩耗して、1 で川の丸石になります。" },
  ro: { en: "Bumps of several sizes on the surface.", ja: "表面に大小の凹凸を加えます。" },
  dt: { en: "How many edges of triangles lie along that much surface: boulders get many triangles, pebbles few. Weathering and roughness need some.", ja: "岩の表面の長さあたりの三角形の辺の数。大きな岩は多くの、小石は少ない三角形になります。風化と粗さの表現に必要です。" },
  em: { en: "Share of a rock's height that lies below the ground.", ja: "岩の高さのうち、地面の下に埋まる割合。" },
  mat: { en: "What the rocks are made of, in natural colours.", ja: "自然な配色での岩の種類。" },
};
