//! Colours: by layer, by rock, or the papers' grey, packed as four sRGB bytes with red first. Natural colours are made
//! in the shaders; for these, the four bytes packed here mean something else.

use super::order::ColorMode;

/// Colours of rocks by layer id modulo 8, sRGB. The first three are as in the papers' figures (terracotta r = 90, ochre
/// r = 30, slate r = 10). Chosen by eye.
const STONE: [[u8; 3]; 8] = [
    [176, 108, 90],
    [198, 165, 106],
    [112, 138, 155],
    [143, 157, 112],
    [150, 118, 143],
    [208, 198, 180],
    [104, 109, 116],
    [100, 152, 146],
];

/// Colours of plans in the same order. They are more saturated, because there is no lighting. Chosen by eye.
const INK: [[u8; 3]; 8] = [
    [205, 94, 60],
    [232, 178, 74],
    [74, 143, 188],
    [124, 164, 80],
    [152, 108, 158],
    [214, 200, 172],
    [112, 120, 128],
    [64, 158, 142],
];

/// sRGB grey of the papers' renderings.
const GREY: [u8; 3] = [158, 156, 152];

/// Mixes a layer id and a site index to 32 evenly distributed bits (Murmur3's finaliser).
pub(crate) fn hash(layer: u32, site: u32) -> u32 {
    let mut h = layer.wrapping_mul(0x9e37_79b9) ^ site.wrapping_mul(0x85eb_ca6b).wrapping_add(1);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// A number 0…1 from eight bits of `hash`, starting at bit `shift`.
pub(crate) fn share(hash: u32, shift: u32) -> f32 {
    ((hash >> shift) & 0xff) as f32 / 255.0
}

fn pack(rgb: [f32; 3]) -> u32 {
    let byte = |c: f32| c.round().clamp(0.0, 255.0) as u32;
    byte(rgb[0]) | byte(rgb[1]) << 8 | byte(rgb[2]) << 16 | 0xff00_0000
}

fn entry(table: &[[u8; 3]; 8], layer: u32) -> [f32; 3] {
    table.get(layer as usize % table.len()).unwrap_or(&GREY).map(f32::from)
}

/// The packed colour of one rock. `hash` is the [`hash`] of its layer id and site index, so a rock keeps its colour
/// when others come and go.
pub(crate) fn rock(mode: ColorMode, layer: u32, hash: u32) -> u32 {
    // The value varies by ±9 %, and the hue slightly from warm to cool: neighbours differ, but the layer still looks
    // like one kind of stone.
    let value = 0.91 + 0.18 * share(hash, 0);
    let warm = 0.05 * (share(hash, 8) - 0.5);
    match mode {
        ColorMode::Layer => {
            let [r, g, b] = entry(&STONE, layer);
            pack([r * value * (1.0 + warm), g * value, b * value * (1.0 - warm)])
        }
        ColorMode::Plain => {
            let value = 0.96 + 0.08 * share(hash, 0);
            pack(GREY.map(|c| f32::from(c) * value))
        }
        ColorMode::Rock => {
            let hue = std::f32::consts::TAU * (hash >> 12 & 0xffff) as f32 / 65536.0;
            pack(oklch(0.62 + 0.14 * share(hash, 0), 0.062, hue))
        }
        ColorMode::Natural => natural(0, 0, hash),
    }
}

/// Number of kinds of stone in `shaders/stone.wgsl`; kind 0 is none.
const LAST_KIND: u32 = 7;

/// What the kinds are called in files of other programs.
#[cfg(test)]
const KINDS: [&str; LAST_KIND as usize] =
    ["granite", "basalt", "sandstone", "limestone", "slate", "quartz", "red-sandstone"];

/// How many of 100 stones in a river are of each kind, in the order of the kinds. Chosen by eye.
const MIXED: [u32; LAST_KIND as usize] = [24, 18, 20, 5, 19, 6, 8];

/// Packs one rock in natural colours: three random bytes, and in the fourth its kind of stone and how far it sinks
/// (0…31). `material`: 0 mixed, otherwise the kind itself (1 granite, 2 basalt, 3 sandstone, 4 limestone, 5 slate); a
/// mix also has 6 quartz and 7 red sandstone.
pub(crate) fn natural(material: u8, sinks: u32, hash: u32) -> u32 {
    let kind = match u32::from(material) {
        kind @ 1..=5 => kind,
        _ => mixed(hash >> 24),
    };
    hash & 0x00ff_ffff | kind << 24 | sinks << 27
}

fn mixed(byte: u32) -> u32 {
    let mut left = byte * 100 / 256;
    let mut kind = 1;
    for share in MIXED {
        if left < share {
            break;
        }
        left -= share;
        kind += 1;
    }
    kind.min(LAST_KIND)
}

/// The packed fill colour of a selected cell: the layer's ink, with a value that varies from cell to cell as in Fig. 8
/// (d).
pub(crate) fn cell(layer: u32, hash: u32) -> u32 {
    let value = 0.78 + 0.3 * share(hash, 0);
    pack(entry(&INK, layer).map(|c| c * value))
}

/// The packed colour of a diagram's lines and sites, on paper or, with `dark`, on a dark ground.
pub(crate) fn line(layer: u32, dark: bool) -> u32 {
    let factor = if dark { 1.0 } else { 0.72 };
    pack(entry(&INK, layer).map(|c| c * factor))
}

/// Converts Oklch (Björn Ottosson, *A perceptual color space for image processing*, 2020) to sRGB, 0…255, clipped. With
/// chroma 0.062 no colour reaches the edge of the gamut.
fn oklch(lightness: f32, chroma: f32, hue: f32) -> [f32; 3] {
    let (sin, cos) = hue.sin_cos();
    let (a, b) = (chroma * cos, chroma * sin);
    let cube = |x: f32| x * x * x;
    let l = cube(lightness + 0.396_337_78 * a + 0.215_803_76 * b);
    let m = cube(lightness - 0.105_561_346 * a - 0.063_854_17 * b);
    let s = cube(lightness - 0.089_484_18 * a - 1.291_485_5 * b);
    [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ]
    .map(|linear| 255.0 * encode(linear.clamp(0.0, 1.0)))
}

fn encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Converts an sRGB colour to linear numbers for a uniform.
pub(crate) fn linear([r, g, b]: [u8; 3]) -> [f32; 4] {
    let decode = |c: u8| {
        let c = f32::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    [decode(r), decode(g), decode(b), 0.0]
}

/// The colours around the rocks in the page's light or dark theme, sRGB.
pub(crate) struct Theme {
    pub(crate) backdrop_low: [u8; 3],
    pub(crate) backdrop_high: [u8; 3],
    pub(crate) soil: [u8; 3],
    /// Colour of the dry soil outside the image.
    pub(crate) dust: [u8; 3],
    /// Background of the diagrams.
    pub(crate) paper: [u8; 3],
    /// Colour around the plan.
    pub(crate) table: [u8; 3],
    /// Colour of the plan's frame.
    pub(crate) rule: [u8; 3],
}

/// The light theme: the pale sky of the papers' figures. Chosen by eye.
pub(crate) const LIGHT: Theme = Theme {
    backdrop_low: [226, 228, 227],
    backdrop_high: [201, 211, 219],
    soil: [92, 74, 61],
    dust: [214, 202, 184],
    paper: [250, 248, 243],
    table: [224, 228, 230],
    rule: [110, 104, 96],
};

pub(crate) const DARK: Theme = Theme {
    backdrop_low: [38, 37, 36],
    backdrop_high: [24, 27, 31],
    soil: [92, 74, 61],
    dust: [62, 54, 48],
    paper: [27, 29, 32],
    table: [17, 18, 20],
    rule: [120, 118, 112],
};

/// Ground and outlines of the selected graph, Fig. 8 (d), in both themes.
pub(crate) const GROUND: [u8; 3] = [46, 41, 37];
pub(crate) const OUTLINE: [u8; 3] = [30, 26, 24];

/// Packs three sRGB bytes.
pub(crate) fn packed(rgb: [u8; 3]) -> u32 {
    pack(rgb.map(f32::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Kind, PARAMS};

    /// The source of a file with a copy of numbers from here.
    fn source(path: &str) -> String {
        let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
    }

    fn hex([r, g, b]: [u8; 3]) -> String {
        format!("'#{r:02x}{g:02x}{b:02x}'")
    }

    #[test]
    fn the_plans_of_the_canvas_have_the_renderers_colours() {
        let canvas = source("www/renderer/canvas2d.ts");
        let inks = INK.map(hex).join(", ");
        let theme = |theme: &Theme| {
            let Theme { table, paper, rule, .. } = theme;
            format!("{{ table: {}, paper: {}, line: {} }}", hex(*table), hex(*paper), hex(*rule))
        };
        for (name, copy) in [
            ("INK", format!("[{inks}]")),
            ("GREY", hex(GREY)),
            ("the light theme", theme(&LIGHT)),
            ("the dark theme", theme(&DARK)),
            ("GROUND", hex(GROUND)),
            ("OUTLINE", hex(OUTLINE)),
        ] {
            assert!(canvas.contains(&copy), "{name} of canvas2d.ts is not {copy}");
        }
    }

    /// The numbers of all colours in a function of a shader, in their order there.
    fn colours(path: &str, function: &str) -> Vec<[f32; 3]> {
        let shader = source(path);
        let (_, code) = shader.split_once(function).expect("the function");
        let code = code.split_once("\n}").map_or(code, |(body, _)| body);
        let numbers = |text: &str| {
            let parts: Vec<f32> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
            <[f32; 3]>::try_from(parts).ok()
        };
        code.split("vec3f(").skip(1).filter_map(|part| numbers(part.split_once(')')?.0)).collect()
    }

    fn mixed_colour(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
        [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]))
    }

    /// As TypeScript writes it, rounded to four digits after the point.
    fn written(colour: [f32; 3]) -> String {
        let numbers = colour.map(|value| format!("{}", (f64::from(value) * 1.0e4).round() / 1.0e4));
        format!("[{}]", numbers.join(", "))
    }

    /// The kinds of wood in the order of `log.kinds`, with their colours: plain as `wood_color` of common.wgsl has them,
    /// and natural as log.wgsl has them on the mean.
    fn wood() -> String {
        // On the mean, bark is so far up from the floor of its fissures; rings, stains and gaps darken end grain.
        const HIGH: f32 = 0.68;
        const GRAIN: f32 = 0.7;
        let plain = colours("src/shading/shaders/common.wgsl", "fn wood_color");
        let bark = colours("src/shading/shaders/log.wgsl", "fn bark(");
        // Before these are directions.
        let [low, brown, grey] = bark[bark.len() - 3..] else { panic!("bark has other colours") };
        let bare = colours("src/shading/shaders/log.wgsl", "fn bare_wood(");
        let pale = bare.iter().position(|colour| *colour == [0.27, 0.19, 0.115]).expect("the pale wood");
        let torn = bare.iter().position(|colour| *colour == [0.28, 0.19, 0.11]).expect("the torn wood");
        let natural = [
            mixed_colour(low, mixed_colour(brown, grey, 0.5), HIGH),
            mixed_colour(bare[pale], bare[pale + 1], 0.5).map(|value| GRAIN * value),
            mixed_colour(bare[torn], bare[torn + 1], 0.5),
        ];
        let mut content = String::from(
            "\n/** What a log is made of, in the order of its `kinds`, with mean colours in linear light. */\nexport const WOOD = [\n",
        );
        for ((name, plain), natural) in
            ["bark", "end-grain", "splinter"].iter().zip([0, 1, 1].map(|k| plain[k])).zip(natural)
        {
            content += &format!("  {{ name: '{name}', plain: {}, natural: {} }},\n", written(plain), written(natural));
        }
        content + "] as const;\n"
    }

    /// The colours that `flesh_albedo` of ear.wgsl mixes, and those of plain wood ears.
    fn flesh() -> String {
        let natural = colours("src/shading/shaders/ear.wgsl", "fn flesh_albedo(");
        let plain = colours("src/shading/shaders/common.wgsl", "fn wood_color");
        let [grown, old, young, dry_inside, dry_outside, wet_outside] = natural[..] else {
            panic!("flesh has other colours")
        };
        let rows = [
            ("young", young),
            ("grown", grown),
            ("old", old),
            ("dryInside", dry_inside),
            ("wetOutside", wet_outside),
            ("dryOutside", dry_outside),
            ("velvet", colours("src/shading/shaders/ear.wgsl", "// Velvet")[0]),
            ("plainInside", plain[2]),
            ("plainOutside", plain[3]),
        ];
        let mut content = String::from(
            "\n/** What the colours of wood ears are mixed from, in linear light: those of wet flesh by age, of the other\n * states and sides, and of plain ones. */\n\
             export const FLESH = {\n",
        );
        for (name, colour) in rows {
            content += &format!("  {name}: {},\n", written(colour));
        }
        content + "} as const;\n"
    }

    /// The colours of `soil_albedo` in cover.wgsl, and that of the ground under layers.
    fn grounds() -> String {
        let mut content = String::from(
            "\n/** What lies between rocks, by the names of the parameter `ground`, with its colour in linear light. */\nexport const GROUND_KINDS = [\n",
        );
        let colours = colours("src/shading/shaders/cover.wgsl", "fn soil_albedo(");
        let names = PARAMS.iter().find_map(|row| match row.kind {
            Kind::Choice(names) if row.key == "ground" => Some(names),
            _ => None,
        });
        let names = names.expect("the parameter");
        assert_eq!(names.len(), colours.len());
        for (name, colour) in names.iter().zip(colours) {
            content += &format!("  {{ name: '{name}', albedo: {} }},\n", written(colour));
        }
        content += "] as const;\n\n/** What lies between rocks in all other colours: bytes of sRGB. */\n";
        content + &format!("export const SOIL = [{}] as const;\n", LIGHT.soil.map(|byte| byte.to_string()).join(", "))
    }

    #[test]
    fn the_panels_swatches_have_the_colours_of_the_layers() {
        let tokens = source("www/styles/tokens.css");
        // The first three are lighter in the panel, where they are small and without light.
        for (layer, [r, g, b]) in STONE.iter().enumerate().skip(3) {
            let token = format!("--layer-{layer}: rgb({r} {g} {b});");
            assert!(tokens.contains(&token), "tokens.css lacks {token}");
        }
    }

    #[test]
    fn typescript_has_the_same_colours() {
        let mut content = String::from(
            "// Generated from src/shading/palette.rs by `UPDATE=1 cargo test --lib palette`; never edited.\n\n\
             /** Colours of rocks by layer id modulo 8: bytes of sRGB. */\nexport const STONE = [\n",
        );
        for [r, g, b] in STONE {
            content += &format!("  [{r}, {g}, {b}],\n");
        }
        content += "] as const;\n\n/** How many of 100 stones of a mixture are of each kind. */\n";
        content += &format!("export const MIXED = [{}] as const;\n", MIXED.map(|share| share.to_string()).join(", "));
        content +=
            "\n/** The kinds of stone, with their mean colour in linear light. */\nexport const STONE_KINDS = [\n";
        let shader = source("src/shading/shaders/stone.wgsl");
        let (_, code) = shader.split_once("fn kind_albedo").expect("the function");
        let albedos = code.split("vec3f(").skip(1).filter_map(|part| part.split_once(')')).map(|(numbers, _)| numbers);
        for (name, albedo) in KINDS.iter().zip(albedos) {
            content += &format!("  {{ name: '{name}', albedo: [{albedo}] }},\n");
        }
        content += "] as const;\n";
        content += &(wood() + &flesh() + &grounds());
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/www/data/palette.gen.ts");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &content).expect("the file can be written");
        }
        let found = source("www/data/palette.gen.ts");
        assert!(found == content, "{path} has other colours; run `UPDATE=1 cargo test --lib palette`");
    }

    /// Files are written in TypeScript, which has the mixture a second time; `tests/web/export.test.ts` reads these lines.
    #[test]
    fn the_kinds_of_a_mixture_are_those_that_typescript_is_compared_with() {
        let mut content = String::from("[");
        for layer in [0, 1, 7, 0xffff_ffff] {
            for site in (0..50).chain([65_537, 0xffff_fffe]) {
                let kind = natural(0, 0, hash(layer, site)) >> 24 & 7;
                let comma = if content.len() > 1 { "," } else { "" };
                content += &format!("{comma}\n  [{layer}, {site}, {}]", kind - 1);
            }
        }
        content += "\n]\n";
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/stone-kinds.json");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &content).expect("the file can be written");
        }
        let found = source("tests/data/stone-kinds.json");
        assert!(found == content, "{path} has other kinds; run `UPDATE=1 cargo test --lib palette`");
    }

    #[test]
    fn stones_too_small_for_a_mesh_are_mixed_like_the_others() {
        let shader = source("src/shading/shaders/stone.wgsl");
        let (_, code) = shader.split_once("fn mixed_albedo").expect("the function");
        let (code, _) = code.split_once("return albedo;").expect("its end");
        // Each line has the next kind, and the share at which it begins.
        let mut steps = vec![(1, 0.0)];
        for line in code.lines().filter_map(|line| line.trim().strip_prefix("albedo = select(albedo, kind_albedo(")) {
            let (kind, from) = line.split_once("), share > ").expect("a kind and a share");
            let kind: f64 = kind.parse().expect("a kind");
            steps.push((kind as usize, from.trim_end_matches(");").parse().expect("a share")));
        }
        assert_eq!(steps.len(), MIXED.len());
        let ends = steps.iter().skip(1).map(|(_, from)| *from).chain([1.0]);
        for (&(kind, from), to) in steps.iter().zip(ends) {
            let here: f64 = 100.0 * (to - from);
            // Limestone and red sandstone differ by one hundredth.
            assert!((here - f64::from(MIXED[kind - 1])).abs() < 1.01, "kind {kind}: {here} of 100");
        }
    }
}
