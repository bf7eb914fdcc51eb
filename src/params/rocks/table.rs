//! The rocks' parameter table. To add a parameter, add a row here and use it in a stage.

use super::super::spec::{Kind, Notation, table};
use super::{Border, Darts, Ground, Layer, Look, Material, ParamSpec, Params, Scope, Swing};

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
    {
        "radius", url "r", Scope::Item(|l| l.radius, |l, v| l.radius = v), Kind::Real, Sites,
        range [1.0, 8192.0] step 0.1 default 30.0, slider [2.0, 512.0] log,
        relative [0.01, 8192.0] step 0.01 default 3.0, slider [0.2, 50.0] log,
        unit LENGTH, label ["Radius r", "半径 r"],
        en "No two sites of the layer are closer than this, so it sets the size of the rocks.",
        ja "この層の母点どうしの最小距離。岩の大きさを決めます。"
    }
    {
        "areaFraction", url "a", Scope::Item(|l| l.area_fraction, |l, v| l.area_fraction = v), Kind::Real, Selection,
        range [0.0, 1.0] step 0.01 default 0.25, slider [0.0, 1.0] linear,
        unit NONE, label ["Area A_s", "面積率 A_s"],
        en "Share of the whole ground that this layer's rocks may fill.",
        ja "この層の岩が占めてよい、地面全体に対する面積の割合。"
    }
    {
        "cellCount", url "n", Scope::Item(|l| l.cell_count.map_or(f64::NAN, f64::from), |l, v| l.cell_count = if v.is_nan() { None } else { Some(v as u32) }),
        Kind::OptionalInteger, Selection,
        range [0.0, 4_294_967_295.0] step 1.0 default f64::NAN, slider [0.0, 1000.0] linear,
        unit NONE, label ["Count", "個数"],
        en "Number of rocks in this layer; when given, it replaces the area.",
        ja "この層の岩の個数。指定すると面積率の代わりに使われます。"
    }
    {
        "taper".0, url "w1", Scope::Item(|l| l.taper[0], |l, v| l.taper[0] = v), Kind::Real, Mesh,
        range [-500.0, 500.0] step 0.1 default 0.0, slider [-40.0, 40.0] linear,
        relative [-500.0, 500.0] step 0.01 default 0.0, slider [-4.0, 4.0] linear,
        unit LENGTH, label ["Taper base c_w1", "幅・基本 c_w1"],
        en "Moves the tops outward (overhangs) or, if negative, inward (pointed rocks).",
        ja "上面の頂点を外へ（張り出し）、負なら内へ（尖った岩）動かします。"
    }
    {
        "taper".1, url "w2", Scope::Item(|l| l.taper[1], |l, v| l.taper[1] = v), Kind::Real, Mesh,
        range [-500.0, 500.0] step 0.1 default 6.0, slider [-40.0, 40.0] linear,
        relative [-500.0, 500.0] step 0.01 default 0.3, slider [-4.0, 4.0] linear,
        unit LENGTH, label ["Taper per rock c_w2", "幅・岩ごと c_w2"],
        en "Adds a random part of the move, one number per rock.",
        ja "岩ごとに1つの乱数で変化する移動量を加えます。"
    }
    {
        "taper".2, url "w3", Scope::Item(|l| l.taper[2], |l, v| l.taper[2] = v), Kind::Real, Mesh,
        range [-500.0, 500.0] step 0.1 default 2.0, slider [-40.0, 40.0] linear,
        relative [-500.0, 500.0] step 0.01 default 0.1, slider [-4.0, 4.0] linear,
        unit LENGTH, label ["Taper per vertex c_w3", "幅・頂点ごと c_w3"],
        en "Adds a random part of the move, one number per vertex: the outline grows ragged.",
        ja "頂点ごとの乱数で移動量を加え、輪郭を不規則にします。"
    }
    {
        "height".0, url "h1", Scope::Item(|l| l.height[0], |l, v| l.height[0] = v), Kind::Real, Mesh,
        range [0.0, 500.0] step 0.1 default 5.0, slider [0.0, 80.0] linear,
        relative [0.0, 500.0] step 0.01 default 0.3, slider [0.0, 2.0] linear,
        unit HEIGHT, label ["Height base c_h1", "高さ・基本 c_h1"],
        en "Height that every top vertex has at least.",
        ja "上面のすべての頂点が持つ最低の高さ。"
    }
    {
        "height".1, url "h2", Scope::Item(|l| l.height[1], |l, v| l.height[1] = v), Kind::Real, Mesh,
        range [0.0, 500.0] step 0.1 default 5.0, slider [0.0, 80.0] linear,
        relative [0.0, 500.0] step 0.01 default 0.3, slider [0.0, 2.0] linear,
        unit HEIGHT, label ["Height per rock c_h2", "高さ・岩ごと c_h2"],
        en "Adds up to this much height, one random number per rock.",
        ja "岩ごとの乱数で、最大この値まで高さを加えます。"
    }
    {
        "height".2, url "h3", Scope::Item(|l| l.height[2], |l, v| l.height[2] = v), Kind::Real, Mesh,
        range [0.0, 500.0] step 0.1 default 3.0, slider [0.0, 80.0] linear,
        relative [0.0, 500.0] step 0.01 default 0.1, slider [0.0, 2.0] linear,
        unit HEIGHT, label ["Height per vertex c_h3", "高さ・頂点ごと c_h3"],
        en "Adds up to this much height, one random number per vertex: the top grows rugged.",
        ja "頂点ごとの乱数で、最大この値まで高さを加え、上面を起伏させます。"
    }
    {
        "weathering", url "we", Scope::Item(|l| l.weathering, |l, v| l.weathering = v), Kind::Real, Mesh,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Weathering", "風化"],
        en "Off, the papers' facets; from 0.2, freshly broken stone, worn at its edges and corners first; at 1, rounded by a river.",
        ja "0 は論文どおりの面。0.2 から割れたばかりの石となり、角や稜から先に摩耗して、1 で川の丸石になります。"
    }
    {
        "roughness", url "ro", Scope::Item(|l| l.roughness, |l, v| l.roughness = v), Kind::Real, Mesh,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Roughness", "粗さ"],
        en "Bumps of several sizes on the surface.",
        ja "表面に大小の凹凸を加えます。"
    }
    {
        "detail", url "de", Scope::Item(|l| f64::from(l.detail), |l, v| l.detail = v as u32), Kind::Integer, Mesh,
        range [0.0, 3.0] step 1.0 default 0.0, slider [0.0, 3.0] linear,
        unit NONE, label ["Detail", "細かさ"],
        en "How often every triangle is cut into four; weathering and roughness need some.",
        ja "三角形を4分割する回数。風化と粗さの表現には分割が必要です。"
    }
    {
        "embedding", url "em", Scope::Item(|l| l.embedding, |l, v| l.embedding = v), Kind::Real, Mesh,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Embedding", "埋まり"],
        en "Share of a rock's height that lies below the ground.",
        ja "岩の高さのうち、地面の下に埋まる割合。"
    }
    {
        "material", url "mat", Scope::Item(|l| l.material as u8 as f64, |l, v| l.material = Material::ALL.get(v as usize).copied().unwrap_or_default()),
        Kind::Choice(&["mixed", "granite", "basalt", "sandstone", "limestone", "slate"]), Look,
        range [0.0, 5.0] step 1.0 default 0.0, slider [0.0, 5.0] linear,
        unit NONE, label ["Material", "石質"],
        en "What the rocks are made of, in natural colours.",
        ja "自然な配色での岩の種類。",
        choices &[["Mixed", "混合"], ["Granite", "花崗岩"], ["Basalt", "玄武岩"], ["Sandstone", "砂岩"], ["Limestone", "石灰岩"], ["Slate", "粘板岩"]]
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
        look: Look {
            variation: 0.0,
            wetness: 0.0,
            moss: 0.0,
            dust: 0.0,
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
    /// Zeroed values, which the table's rows then fill in.
    pub(crate) const EMPTY: Layer = Layer {
        id: 0,
        radius: 0.0,
        area_fraction: 0.0,
        cell_count: None,
        taper: [0.0; 3],
        height: [0.0; 3],
        weathering: 0.0,
        roughness: 0.0,
        detail: 0,
        embedding: 0.0,
        material: Material::Mixed,
    };

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
