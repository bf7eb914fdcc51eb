//! The rocks' parameter table. To add a parameter, add a row here and use it in a stage.

use super::super::spec::{Kind, Notation, Value, table};
use super::{Border, Crossing, Darts, Ground, Look, Material, ParamSpec, Params, Scope, Swing};

/// The stages of the generator. A row names the first one that has to run again after an edit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Dart throwing (Fig. 4).
    Sites,
    /// Voronoi diagrams.
    Cells,
    /// Exclusive selection (Fig. 7).
    Selection,
    /// p_add and their Delaunay triangulation (Fig. 10).
    Shape,
    /// Displacement (Eqs 2, 3), wear and the buffers.
    Mesh,
    /// No stage of the generator: only the picture changes.
    Look,
}

const PX: [&str; 2] = ["px", "px"];
const LENGTH: [&str; 2] = ["px", "width/100"];
const HEIGHT: [&str; 2] = ["px", "r"];
const DENSITY: [&str; 2] = ["/100 px", "/width"];
const DEGREES: [&str; 2] = ["°", "°"];
const NONE: [&str; 2] = ["", ""];

table! {
    {
        "seed", url "seed", Scope::Field(|p| f64::from(p.seed), |p, v| p.seed = v as u32), Kind::Integer, Sites,
        range [0.0, 4_294_967_295.0] step 1.0 default 0.0, slider [0.0, 4_294_967_295.0] linear,
        unit NONE, label ["Seed", "シード"],
        en "The same seed and parameters give the same rocks, byte for byte, everywhere.",
        ja "同じシードと設定なら、どの環境でも同じ岩が1バイトも違わず生成されます。"
    }
    {
        "imageWidth", url "w", Scope::Field(|p| f64::from(p.image_width), |p, v| p.image_width = v as u32), Kind::Integer, Sites,
        range [1.0, 8192.0] step 1.0 default 1024.0, slider [16.0, 8192.0] log,
        unit PX, label ["Width", "幅"],
        en "Width of the ground seen from above.",
        ja "真上から見た地面の幅。"
    }
    {
        "imageHeight", url "h", Scope::Field(|p| f64::from(p.image_height), |p, v| p.image_height = v as u32), Kind::Integer, Sites,
        range [1.0, 8192.0] step 1.0 default 1024.0, slider [16.0, 8192.0] log,
        unit PX, label ["Depth", "奥行き"],
        en "Depth of the ground seen from above.",
        ja "真上から見た地面の奥行き。"
    }
    {
        "packing", url "cd", Scope::Field(|p| p.packing, |p, v| p.packing = v), Kind::Real, Sites,
        range [0.0, 1.0] step 0.01 default 0.7, slider [0.0, 1.0] linear,
        unit NONE, label ["Packing c_d", "充填率 c_d"],
        en "How many sites are asked for (Eq. 1); from about 0.55 on, no pixel is left free.",
        ja "要求する母点の数（式1）。約0.55以上では空き画素がなくなるまで配置します。"
    }
    {
        "notation", url "u", Scope::Field(|p| p.notation as u8 as f64, |p, v| p.notation = if v == 0.0 { Notation::Px } else { Notation::Relative }),
        Kind::Choice(&["px", "relative"]), Sites,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Notation", "単位系"],
        en "Lengths in pixels (journal), or in hundredths of the width with heights in radii (conference).",
        ja "長さの単位：画素（論文誌）、または幅の1/100で高さは半径の倍数（会議版）。",
        choices &[["Pixels", "画素"], ["Relative", "相対"]]
    }
    {
        "darts", url "darts", Scope::Field(|p| p.darts as u8 as f64, |p, v| p.darts = if v == 0.0 { Darts::Saturate } else { Darts::Attempts }),
        Kind::Choice(&["saturate", "attempts"]), Sites,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Darts", "ダーツ"],
        en "Throw until nothing is free, or exactly N_p times as Fig. 4 is written.",
        ja "空きがなくなるまで投げるか、図4の記述どおり N_p 回だけ投げるか。",
        choices &[["Until saturated", "飽和まで"], ["N_p attempts", "N_p 回"]]
    }
    {
        "border", url "border", Scope::Field(|p| p.border as u8 as f64, |p, v| p.border = if v == 0.0 { Border::Clip } else { Border::Drop }),
        Kind::Choice(&["clip", "drop"]), Selection,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Border cells", "境界セル"],
        en "Cells at the border are clipped to the image and kept, or dropped.",
        ja "画像の縁にかかるセルを切り取って残すか、除外するか。",
        choices &[["Clip", "切り取る"], ["Drop", "除外する"]]
    }
    {
        "swing", url "swing", Scope::Field(|p| p.swing as u8 as f64, |p, v| p.swing = if v == 0.0 { Swing::Shared } else { Swing::Separate }),
        Kind::Choice(&["shared", "separate"]), Mesh,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Swing", "乱数"],
        en "Taper and height share their random numbers (wide rocks are the tall ones), or draw their own.",
        ja "幅と高さで同じ乱数を使う（幅広の岩ほど高い）か、別々の乱数を使うか。",
        choices &[["Shared", "共有"], ["Separate", "別々"]]
    }
    {
        "crossing", url "cross", Scope::Field(|p| p.crossing as u8 as f64, |p, v| p.crossing = if v == 0.0 { Crossing::Free } else { Crossing::Apart }),
        Kind::Choice(&["free", "apart"]), Mesh,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Neighbours", "隣の岩"],
        en "Rocks may pass through their neighbours, as in the papers, or each keeps to its own side.",
        ja "論文どおり隣の岩に食い込んでもよいか、岩どうしが交わらないようにするか。",
        choices &[["May cross", "交わってよい"], ["Stay apart", "交わらない"]]
    }
    {
        "variation", url "var", Scope::Field(|p| p.look.variation, |p, v| p.look.variation = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.5, slider [0.0, 1.0] linear,
        unit NONE, label ["Variation", "ばらつき"],
        en "How far the rocks differ from each other in colour and value, in natural colours.",
        ja "自然な配色での、岩ごとの色と明るさの違いの大きさ。"
    }
    {
        "wetness", url "wet", Scope::Field(|p| p.look.wetness, |p, v| p.look.wetness = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Wetness", "濡れ"],
        en "Wet stone is darker and glossy.",
        ja "濡れた石は暗く、つやが出ます。"
    }
    {
        "moss", url "moss", Scope::Field(|p| p.look.moss, |p, v| p.look.moss = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Moss", "苔"],
        en "Moss grows in patches, where the rocks are low and face up.",
        ja "低い所や上を向いた面に、まだらに苔が生えます。"
    }
    {
        "dust", url "dust", Scope::Field(|p| p.look.dust, |p, v| p.look.dust = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.2, slider [0.0, 1.0] linear,
        unit NONE, label ["Dust", "砂ぼこり"],
        en "Dust of the ground lies low on the rocks and on what faces up.",
        ja "岩の低い所と上を向いた面に、地面の砂ぼこりが積もります。"
    }
    {
        "snow", url "snow", Scope::Field(|p| p.look.snow, |p, v| p.look.snow = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Snow", "雪"],
        en "Snow covers the ground, and what faces up.",
        ja "雪は地面と、上を向いた面に積もります。"
    }
    {
        "water", url "water", Scope::Field(|p| p.look.water, |p, v| p.look.water = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Water", "水"],
        en "Clear water stands over the ground; at 1, over the highest rock.",
        ja "澄んだ水が地面を覆います。1で一番高い岩まで届きます。"
    }
    {
        "ground", url "soil", Scope::Field(|p| p.look.ground as u8 as f64, |p, v| p.look.ground = Ground::ALL.get(v as usize).copied().unwrap_or_default()),
        Kind::Choice(&["soil", "sand", "gravel"]), Look,
        range [0.0, 2.0] step 1.0 default 0.0, slider [0.0, 2.0] linear,
        unit NONE, label ["Ground", "地面"],
        en "What lies between and around the rocks, in natural colours.",
        ja "自然な配色での、岩の間とまわりの地面。",
        choices &[["Soil", "土"], ["Sand", "砂"], ["Gravel", "砂利"]]
    }
    {
        "sunAzimuth", url "sa", Scope::Field(|p| p.look.sun_azimuth, |p, v| p.look.sun_azimuth = v), Kind::Real, Look,
        range [0.0, 360.0] step 1.0 default 259.0, slider [0.0, 360.0] linear,
        unit DEGREES, label ["Sun azimuth", "太陽の方位"],
        en "Where the sun stands, counted like the camera's azimuth: at the same angle it is behind the viewer.",
        ja "太陽の方位。カメラの方位角と同じ向きに数え、同じ角度なら見る人の背後にあります。"
    }
    {
        "sunElevation", url "se", Scope::Field(|p| p.look.sun_elevation, |p, v| p.look.sun_elevation = v), Kind::Real, Look,
        range [5.0, 90.0] step 1.0 default 35.0, slider [5.0, 90.0] linear,
        unit DEGREES, label ["Sun elevation", "太陽の高さ"],
        en "How high the sun stands; a low sun throws long shadows.",
        ja "太陽の高さ。低いほど影が長くなります。"
    }

    /// One layer. Its lengths are in the notation of its [`Params`].
    pub struct Layer {
        /// Stable identity of the layer. Its random streams depend on this number and not on its place in the list.
        pub id: u32;

        /// Disc radius r: no two sites are closer than this.
        pub radius: f64 as "radius", from Sites {
            url "r",
            range [1.0, 8192.0] step 0.1 default 30.0, slider [2.0, 512.0] log,
            relative [0.01, 8192.0] step 0.01 default 3.0, slider [0.2, 50.0] log,
            unit LENGTH, label ["Radius r", "半径 r"],
            en "No two sites of the layer are closer than this, so it sets the size of the rocks.",
            ja "この層の母点どうしの最小距離。岩の大きさを決めます。"
        }

        /// A_s: the share of the whole image that the layer may fill, 0 … 1.
        pub area_fraction: f64 as "areaFraction", from Selection {
            url "a",
            range [0.0, 1.0] step 0.01 default 0.25, slider [0.0, 1.0] linear,
            unit NONE, label ["Area A_s", "面積率 A_s"],
            en "Share of the whole ground that this layer's rocks may fill.",
            ja "この層の岩が占めてよい、地面全体に対する面積の割合。"
        }

        /// Number of cells to select, instead of an area.
        pub cell_count: Option<u32> as "cellCount", from Selection {
            url "n",
            range [0.0, 4_294_967_295.0] step 1.0 default f64::NAN, slider [0.0, 1000.0] linear,
            unit NONE, label ["Count", "個数"],
            en "Number of rocks in this layer; when given, it replaces the area.",
            ja "この層の岩の個数。指定すると面積率の代わりに使われます。"
        }

        /// c_w1, c_w2, c_w3 of Eq. 2.
        pub taper: [f64; 3] as "taper", from Mesh {
            .0 url "w1",
            range [-500.0, 500.0] step 0.1 default 0.0, slider [-40.0, 40.0] linear,
            relative [-500.0, 500.0] step 0.01 default 0.0, slider [-4.0, 4.0] linear,
            unit LENGTH, label ["Taper base c_w1", "幅・基本 c_w1"],
            en "Moves the tops outward (overhangs) or, if negative, inward (pointed rocks).",
            ja "上面の頂点を外へ（張り出し）、負なら内へ（尖った岩）動かします。"
        } {
            .1 url "w2",
            range [-500.0, 500.0] step 0.1 default 6.0, slider [-40.0, 40.0] linear,
            relative [-500.0, 500.0] step 0.01 default 0.3, slider [-4.0, 4.0] linear,
            unit LENGTH, label ["Taper per rock c_w2", "幅・岩ごと c_w2"],
            en "Adds a random part of the move, one number per rock.",
            ja "岩ごとに1つの乱数で変化する移動量を加えます。"
        } {
            .2 url "w3",
            range [-500.0, 500.0] step 0.1 default 2.0, slider [-40.0, 40.0] linear,
            relative [-500.0, 500.0] step 0.01 default 0.1, slider [-4.0, 4.0] linear,
            unit LENGTH, label ["Taper per vertex c_w3", "幅・頂点ごと c_w3"],
            en "Adds a random part of the move, one number per vertex: the outline grows ragged.",
            ja "頂点ごとの乱数で移動量を加え、輪郭を不規則にします。"
        }

        /// c_h1, c_h2, c_h3 of Eq. 3.
        pub height: [f64; 3] as "height", from Mesh {
            .0 url "h1",
            range [0.0, 500.0] step 0.1 default 5.0, slider [0.0, 80.0] linear,
            relative [0.0, 500.0] step 0.01 default 0.3, slider [0.0, 2.0] linear,
            unit HEIGHT, label ["Height base c_h1", "高さ・基本 c_h1"],
            en "Height that every top vertex has at least.",
            ja "上面のすべての頂点が持つ最低の高さ。"
        } {
            .1 url "h2",
            range [0.0, 500.0] step 0.1 default 5.0, slider [0.0, 80.0] linear,
            relative [0.0, 500.0] step 0.01 default 0.3, slider [0.0, 2.0] linear,
            unit HEIGHT, label ["Height per rock c_h2", "高さ・岩ごと c_h2"],
            en "Adds up to this much height, one random number per rock.",
            ja "岩ごとの乱数で、最大この値まで高さを加えます。"
        } {
            .2 url "h3",
            range [0.0, 500.0] step 0.1 default 3.0, slider [0.0, 80.0] linear,
            relative [0.0, 500.0] step 0.01 default 0.1, slider [0.0, 2.0] linear,
            unit HEIGHT, label ["Height per vertex c_h3", "高さ・頂点ごと c_h3"],
            en "Adds up to this much height, one random number per vertex: the top grows rugged.",
            ja "頂点ごとの乱数で、最大この値まで高さを加え、上面を起伏させます。"
        }

        /// 0 is the papers' mesh, 0.2 freshly broken stone, 1 stone rounded by a river.
        pub weathering: f64 as "weathering", from Mesh {
            url "we",
            range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
            unit NONE, label ["Weathering", "風化"],
            en "Off, the papers' facets; from 0.2, freshly broken stone, worn at its edges and corners first; at 1, rounded by a river.",
            ja "0 は論文どおりの面。0.2 から割れたばかりの石となり、角や稜から先に摩耗して、1 で川の丸石になります。"
        }

        /// Strength of the noise that displaces the surface, 0 … 1.
        pub roughness: f64 as "roughness", from Mesh {
            url "ro",
            range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
            unit NONE, label ["Roughness", "粗さ"],
            en "Bumps of several sizes on the surface.",
            ja "表面に大小の凹凸を加えます。"
        }

        /// How many edges of triangles lie along 100 units of length, about; 0 leaves the papers' triangles.
        pub detail: f64 as "detail", from Mesh {
            url "dt",
            range [0.0, 1000.0] step 1.0 default 0.0, slider [0.0, 200.0] linear,
            relative [0.0, 81_920.0] step 1.0 default 0.0, slider [0.0, 2000.0] linear,
            unit DENSITY, label ["Detail", "細かさ"],
            en "How many edges of triangles lie along that much surface: boulders get many triangles, pebbles few. Weathering and roughness need some.",
            ja "岩の表面の長さあたりの三角形の辺の数。大きな岩は多くの、小石は少ない三角形になります。風化と粗さの表現に必要です。"
        }

        /// Share of a rock's height that lies below the ground, 0 … 1.
        pub embedding: f64 as "embedding", from Mesh {
            url "em",
            range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
            unit NONE, label ["Embedding", "埋まり"],
            en "Share of a rock's height that lies below the ground.",
            ja "岩の高さのうち、地面の下に埋まる割合。"
        }

        /// What the rocks are made of.
        pub material: Material as "material", from Look {
            url "mat",
            range [0.0, 5.0] step 1.0 default 0.0, slider [0.0, 5.0] linear,
            unit NONE, label ["Material", "石質"],
            en "What the rocks are made of, in natural colours.",
            ja "自然な配色での岩の種類。",
            choices &[["Mixed", "混合"], ["Granite", "花崗岩"], ["Basalt", "玄武岩"], ["Sandstone", "砂岩"], ["Limestone", "石灰岩"], ["Slate", "粘板岩"]]
        }
    }
}

impl Material {
    /// All values, in the order of the table's words.
    pub const ALL: [Material; 6] = [
        Material::Mixed,
        Material::Granite,
        Material::Basalt,
        Material::Sandstone,
        Material::Limestone,
        Material::Slate,
    ];
}

impl Value for Material {
    const KIND: Kind = Kind::Choice(&["mixed", "granite", "basalt", "sandstone", "limestone", "slate"]);
    const EMPTY: Self = Material::Mixed;

    fn get(&self, _: usize) -> f64 {
        f64::from(*self as u8)
    }

    fn set(&mut self, _: usize, value: f64) {
        *self = Material::ALL.get(value as usize).copied().unwrap_or_default();
    }
}

impl Ground {
    /// All values, in the order of the table's words.
    pub const ALL: [Ground; 3] = [Ground::Soil, Ground::Sand, Ground::Gravel];
}

impl Params {
    /// Zeroed values, which the table's rows then fill in.
    pub(crate) const EMPTY: Params = Params {
        seed: 0,
        image_width: 1,
        image_height: 1,
        packing: 0.0,
        notation: Notation::Px,
        darts: Darts::Saturate,
        border: Border::Clip,
        swing: Swing::Shared,
        crossing: Crossing::Free,
        look: Look {
            variation: 0.0,
            wetness: 0.0,
            moss: 0.0,
            dust: 0.0,
            snow: 0.0,
            water: 0.0,
            ground: Ground::Soil,
            sun_azimuth: 0.0,
            sun_elevation: 0.0,
        },
        layers: Vec::new(),
    };

    /// The table's defaults, without layers.
    pub fn with_defaults() -> Self {
        let mut params = Params::EMPTY;
        for spec in PARAMS {
            if let Scope::Field(_, set) = spec.scope {
                set(&mut params, spec.range.default);
            }
        }
        params
    }
}

impl Layer {
    /// A layer with the table's defaults for `notation`.
    pub fn with_defaults(id: u32, notation: Notation) -> Self {
        let mut layer = Layer { id, ..Layer::EMPTY };
        for spec in PARAMS {
            if let Scope::Item(_, set) = spec.scope {
                set(&mut layer, spec.range(notation).default);
            }
        }
        layer
    }
}
