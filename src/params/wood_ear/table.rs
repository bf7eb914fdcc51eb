//! The wood ears' parameter table. To add a parameter, add a row here and use it in a stage.

use super::super::spec::{Kind, table};
use super::{Base, Collisions, Log, Look, ParamSpec, Params, Scope};

/// The stages of the generator. A row names the first one that has to run again after an edit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// The log and its fine mesh.
    Log,
    /// Choosing the vertices that carry individuals \[3.2\].
    Spawn,
    /// Bowls, drying, wrinkles (Eqs 3.1 to 3.5), droop and thickness. Afterwards there is a colony to show.
    Deform,
    /// Solving collisions (Eqs 3.6 to 3.10).
    Collide,
    /// The buffers.
    Mesh,
    /// No stage of the generator: only the picture changes.
    Look,
}

const CM: [&str; 2] = ["cm", "cm"];
const PERCENT: [&str; 2] = ["%", "%"];
const DEGREES: [&str; 2] = ["°", "°"];
const NONE: [&str; 2] = ["", ""];

/// Largest coordinate, cm. A grown log is at most 4 m long, but a log given by the user may lie anywhere within 100 m.
const REACH: f64 = 10_000.0;

table! {
    {
        "seed", url "seed", Scope::Field(|p| f64::from(p.seed), |p, v| p.seed = v as u32), Kind::Integer, Spawn,
        range [0.0, 4_294_967_295.0] step 1.0 default 0.0, slider [0.0, 4_294_967_295.0] linear,
        unit NONE, label ["Seed", "シード"],
        en "The same seed and parameters give the same colony, byte for byte, everywhere.",
        ja "同じシードと設定なら、どの環境でも同じ群生が1バイトも違わず生成されます。"
    }
    {
        "density", url "d", Scope::Field(|p| p.density, |p, v| p.density = v), Kind::Real, Spawn,
        range [0.0, 100.0] step 1.0 default 50.0, slider [0.0, 100.0] linear,
        unit PERCENT, label ["Colony density", "群生密度"],
        en "Share of the places within range (the log's vertices) that carry a wood ear.",
        ja "範囲内にある丸太の頂点のうち、キクラゲが生える割合。"
    }
    {
        "range", url "r", Scope::Field(|p| p.range, |p, v| p.range = v), Kind::Real, Spawn,
        range [20.0, 200.0] step 1.0 default 50.0, slider [20.0, 200.0] linear,
        unit CM, label ["Colony range", "群生範囲"],
        en "How far from its base point the colony spreads, in a straight line.",
        ja "群生が基点から広がる直線距離。"
    }
    {
        "moisture", url "m", Scope::Field(|p| p.moisture, |p, v| p.moisture = v), Kind::Real, Deform,
        range [0.0, 100.0] step 1.0 default 50.0, slider [0.0, 100.0] linear,
        unit PERCENT, label ["Moisture", "含水率"],
        en "Dry wood ears shrink and curl; at 100 none does.",
        ja "乾くほど縮んで丸まります。100では変形しません。"
    }
    {
        "wrinkles", url "w", Scope::Field(|p| p.wrinkles, |p, v| p.wrinkles = v), Kind::Real, Deform,
        range [0.0, 100.0] step 1.0 default 50.0, slider [0.0, 100.0] linear,
        unit PERCENT, label ["Wrinkles", "シワの密度"],
        en "How far folds pull the surface towards the axis.",
        ja "シワが表面を軸の方へ引き込む強さ。"
    }
    {
        "size", url "s", Scope::Field(|p| p.size, |p, v| p.size = v), Kind::Real, Deform,
        range [1.0, 3.0] step 0.05 default 2.0, slider [1.0, 3.0] linear,
        unit CM, label ["Size", "サイズ"],
        en "Median rim radius before drying: wet wood ears are 3 to 6 cm wide.",
        ja "乾燥前の縁の半径の中央値。湿ったキクラゲの幅は3〜6cmです。"
    }
    {
        "sizeSpread", url "sp", Scope::Field(|p| p.size_spread, |p, v| p.size_spread = v), Kind::Real, Deform,
        range [1.0, 2.0] step 0.05 default 1.5, slider [1.0, 2.0] linear,
        unit NONE, label ["Size spread", "サイズのばらつき幅"],
        en "Sizes lie between the size divided and multiplied by this; at 1 all are equal.",
        ja "サイズはこの値で割った値から掛けた値までの間になります。1ではすべて同じです。"
    }
    {
        "perIndividual", url "pi", Scope::Field(|p| p.per_individual, |p, v| p.per_individual = v), Kind::Real, Deform,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Wrinkles per individual", "個体ごとのシワ"],
        en "How far wrinkling differs between individuals; at 1 some have no wrinkles at all.",
        ja "シワの強さの個体差。1ではシワのない個体も現れます。"
    }
    {
        "collisions", url "co", Scope::Field(|p| p.collisions as u8 as f64, |p, v| p.collisions = Collisions::ALL.get(v as usize).copied().unwrap_or_default()),
        Kind::Choice(&["off", "thesis", "pressed"]), Collide,
        range [0.0, 2.0] step 1.0 default 1.0, slider [0.0, 2.0] linear,
        unit NONE, label ["Collisions", "衝突"],
        en "Wood ears pass through each other, step inward as the thesis has it (a few stay crossed), or press flat against each other (none cross).",
        ja "重なりを許すか、論文どおり内側へ縮めるか（一部は交差が残ります）、平らに押し合わせるか（交差は残りません）。",
        choices &[["Off", "なし"], ["Thesis", "論文"], ["Pressed", "押し合い"]]
    }
    {
        "droop", url "dr", Scope::Field(|p| p.droop, |p, v| p.droop = v), Kind::Real, Deform,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Droop", "垂れ下がり"],
        en "Bends wood ears downward, the wetter the more: on the log's flank they hang like ears.",
        ja "湿っているほど下へ垂れ、丸太の側面では耳のように下がります。"
    }
    {
        "thickness", url "th", Scope::Field(|p| p.thickness, |p, v| p.thickness = v), Kind::Real, Deform,
        range [0.0, 0.4] step 0.01 default 0.0, slider [0.0, 0.4] linear,
        unit CM, label ["Thickness", "厚み"],
        en "Of the wet flesh at the foot; thinner at the rim and when dry. At 0 they are the thesis's sheets.",
        ja "湿った状態の根元の厚み。縁や乾燥時は薄くなります。0では論文どおりの面です。"
    }
    {
        "foot", url "ft", Scope::Field(|p| p.foot, |p, v| p.foot = v), Kind::Real, Deform,
        range [0.0, 1.0] step 0.01 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Foot", "柄"],
        en "A short stalk into the log that closes the hole of the first ring; 0 leaves the hole.",
        ja "最初の輪の穴をふさいで丸太に入る短い柄。0では穴のままです。"
    }
    {
        "clearLog", url "cl", Scope::Field(|p| p.clear_log as u8 as f64, |p, v| p.clear_log = v != 0.0),
        Kind::Choice(&["off", "on"]), Deform,
        range [0.0, 1.0] step 1.0 default 0.0, slider [0.0, 1.0] linear,
        unit NONE, label ["Clear of the log", "丸太との衝突"],
        en "Keeps wood ears from passing through the log.",
        ja "キクラゲが丸太を突き抜けないようにします。",
        choices &[["Off", "なし"], ["On", "あり"]]
    }
    {
        "rings", url "e", Scope::Field(|p| f64::from(p.rings), |p, v| p.rings = v as u32), Kind::Integer, Deform,
        range [3.0, 24.0] step 1.0 default 10.0, slider [3.0, 24.0] linear,
        unit NONE, label ["Rings d", "輪の数 d"],
        en "Rings of vertices from the foot to the rim (Eq. 3.1).",
        ja "根元から縁までの頂点の輪の数（式3.1）。"
    }
    {
        "meridians", url "f", Scope::Field(|p| f64::from(p.meridians), |p, v| p.meridians = v as u32), Kind::Integer, Deform,
        range [8.0, 64.0] step 1.0 default 30.0, slider [8.0, 64.0] linear,
        unit NONE, label ["Vertices per ring c", "輪の頂点数 c"],
        en "Vertices on a ring (Eq. 3.1); below 19, wrinkles are coarser than the ring can show.",
        ja "1つの輪の頂点数（式3.1）。19未満ではシワを表しきれません。"
    }
    {
        "logLength", url "ll", Scope::Field(|p| p.log.length, |p, v| p.log.length = v), Kind::Real, Log,
        range [40.0, 400.0] step 1.0 default 200.0, slider [40.0, 400.0] linear,
        unit CM, label ["Log length", "丸太の長さ"],
        en "Length of the log, which lies on the ground along x.",
        ja "x 方向に横たわる丸太の長さ。"
    }
    {
        "logRadius", url "lr", Scope::Field(|p| p.log.radius, |p, v| p.log.radius = v), Kind::Real, Log,
        range [5.0, 40.0] step 0.5 default 14.0, slider [5.0, 40.0] linear,
        unit CM, label ["Log radius", "丸太の半径"],
        en "Mean radius of the log.",
        ja "丸太の平均半径。"
    }
    {
        "logBend", url "lb", Scope::Field(|p| p.log.bend, |p, v| p.log.bend = v), Kind::Real, Log,
        range [0.0, 1.0] step 0.01 default 0.5, slider [0.0, 1.0] linear,
        unit NONE, label ["Log bend", "丸太の曲がり"],
        en "How far the log is bowed.",
        ja "丸太の曲がりの強さ。"
    }
    {
        "logBark", url "lk", Scope::Field(|p| p.log.bark, |p, v| p.log.bark = v), Kind::Real, Log,
        range [0.0, 1.0] step 0.01 default 0.5, slider [0.0, 1.0] linear,
        unit NONE, label ["Bark", "樹皮"],
        en "Depth of the furrows of the bark, and of knots and splinters; at 0 the log is smooth.",
        ja "樹皮の溝・節・折れ口のささくれの深さ。0では滑らかです。"
    }
    {
        "logSpacing", url "ls", Scope::Field(|p| p.log.spacing, |p, v| p.log.spacing = v), Kind::Real, Log,
        range [1.5, 6.0] step 0.1 default 3.0, slider [1.5, 6.0] linear,
        unit CM, label ["Vertex spacing", "頂点の間隔"],
        en "Mean distance of the places where a wood ear can stand: the log's vertices or, on a mesh of your own, points spread over its surface.",
        ja "キクラゲが生えうる位置の平均間隔。位置は丸太の頂点、独自のメッシュではその表面に広げた点です。"
    }
    {
        "logSeed", url "lg", Scope::Field(|p| f64::from(p.log.seed), |p, v| p.log.seed = v as u32), Kind::Integer, Log,
        range [0.0, 4_294_967_295.0] step 1.0 default 0.0, slider [0.0, 4_294_967_295.0] linear,
        unit NONE, label ["Log seed", "丸太のシード"],
        en "Another log for the same colony's settings.",
        ja "同じ設定で別の丸太を作ります。"
    }
    {
        "variation", url "var", Scope::Field(|p| p.look.variation, |p, v| p.look.variation = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.4, slider [0.0, 1.0] linear,
        unit NONE, label ["Variation", "ばらつき"],
        en "How far wood ears differ from each other in colour.",
        ja "個体ごとの色の違いの大きさ。"
    }
    {
        "translucency", url "tl", Scope::Field(|p| p.look.translucency, |p, v| p.look.translucency = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.5, slider [0.0, 1.0] linear,
        unit NONE, label ["Translucency", "透け"],
        en "How much light shines through thin and wet flesh.",
        ja "薄く湿った部分を光が透ける度合い。"
    }
    {
        "velvet", url "ve", Scope::Field(|p| p.look.velvet, |p, v| p.look.velvet = v), Kind::Real, Look,
        range [0.0, 1.0] step 0.01 default 0.5, slider [0.0, 1.0] linear,
        unit NONE, label ["Velvet", "産毛"],
        en "Fine down on the outer side.",
        ja "外側の細かい産毛。"
    }
    {
        "sunAzimuth", url "sa", Scope::Field(|p| p.look.sun_azimuth, |p, v| p.look.sun_azimuth = v), Kind::Real, Look,
        range [0.0, 360.0] step 1.0 default 320.0, slider [0.0, 360.0] linear,
        unit DEGREES, label ["Sun azimuth", "太陽の方位"],
        en "Where the sun stands, counted like the camera's azimuth: at the same angle it is behind the viewer.",
        ja "太陽の方位。カメラの方位角と同じ向きに数え、同じ角度なら見る人の背後にあります。"
    }
    {
        "sunElevation", url "se", Scope::Field(|p| p.look.sun_elevation, |p, v| p.look.sun_elevation = v), Kind::Real, Look,
        range [5.0, 90.0] step 1.0 default 40.0, slider [5.0, 90.0] linear,
        unit DEGREES, label ["Sun elevation", "太陽の高さ"],
        en "How high the sun stands; a low sun throws long shadows.",
        ja "太陽の高さ。低いほど影が長くなります。"
    }
    {
        "x", url "bx", Scope::Item(|b| b.position[0], |b, v| b.position[0] = v), Kind::Real, Spawn,
        range [-REACH, REACH] step 0.1 default 0.0, slider [-200.0, 200.0] linear,
        unit CM, label ["Base x", "基点 x"],
        en "Where the colony spreads from, along the log; the nearest vertex of the log is taken.",
        ja "群生の基点（丸太に沿う向き）。最も近い丸太の頂点に合わせます。"
    }
    {
        "y", url "by", Scope::Item(|b| b.position[1], |b, v| b.position[1] = v), Kind::Real, Spawn,
        range [-REACH, REACH] step 0.1 default -10.0, slider [-60.0, 60.0] linear,
        unit CM, label ["Base y", "基点 y"],
        en "Where the colony spreads from, across the log.",
        ja "群生の基点（丸太を横切る向き）。"
    }
    {
        "z", url "bz", Scope::Item(|b| b.position[2], |b, v| b.position[2] = v), Kind::Real, Spawn,
        range [-REACH, REACH] step 0.1 default 23.0, slider [0.0, 80.0] linear,
        unit CM, label ["Base z", "基点 z"],
        en "Where the colony spreads from, above the ground.",
        ja "群生の基点（地面からの高さ）。"
    }
    {
        "range", url "br", Scope::Item(|b| b.range.unwrap_or(f64::NAN), |b, v| b.range = if v.is_nan() { None } else { Some(v) }), Kind::OptionalReal, Spawn,
        range [20.0, 200.0] step 1.0 default f64::NAN, slider [20.0, 200.0] linear,
        unit CM, label ["Base range", "基点の範囲"],
        en "How far the colony spreads from this base; without it, the colony's range.",
        ja "この基点からの広がり。省くと群生範囲と同じです。"
    }
}

impl Collisions {
    /// All values, in the order of the table's words.
    pub const ALL: [Collisions; 3] = [Collisions::Off, Collisions::Thesis, Collisions::Pressed];
}

impl Params {
    /// Zeroed parameters, which the table's rows then fill in.
    pub(super) const EMPTY: Params = Params {
        seed: 0,
        density: 0.0,
        range: 0.0,
        moisture: 0.0,
        wrinkles: 0.0,
        size: 0.0,
        size_spread: 0.0,
        rings: 0,
        meridians: 0,
        per_individual: 0.0,
        collisions: Collisions::Off,
        droop: 0.0,
        thickness: 0.0,
        foot: 0.0,
        clear_log: false,
        log: Log { length: 0.0, radius: 0.0, bend: 0.0, bark: 0.0, spacing: 0.0, seed: 0 },
        look: Look { variation: 0.0, translucency: 0.0, velvet: 0.0, sun_azimuth: 0.0, sun_elevation: 0.0 },
        bases: Vec::new(),
    };

    /// The table's defaults, with one base at its default.
    pub fn with_defaults() -> Self {
        let mut params = Params::EMPTY;
        for spec in PARAMS {
            if let Scope::Field(_, set) = spec.scope {
                set(&mut params, spec.range.default);
            }
        }
        params.bases.push(Base::with_defaults());
        params
    }
}

impl Base {
    /// The table's defaults.
    pub fn with_defaults() -> Self {
        let mut base = Base { position: [0.0; 3], range: None };
        for spec in PARAMS {
            if let Scope::Item(_, set) = spec.scope {
                set(&mut base, spec.range.default);
            }
        }
        base
    }
}
