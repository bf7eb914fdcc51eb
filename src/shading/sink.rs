//! How deep rocks sink near the image's border in natural colours, so that the border is ragged and not a visible
//! square.

use super::palette;

/// Number of steps in which sinking is stored: what is left of a byte beside the kind of stone.
const STEPS: f32 = 31.0;

/// Where every rock stands and how high it is. Collected while the vertices are uploaded.
#[derive(Default)]
pub(crate) struct Stands {
    /// Mean x, mean y and largest z of each rock, px.
    rocks: Vec<[f32; 3]>,
    sum: [f32; 2],
    count: f32,
    top: f32,
}

impl Stands {
    /// Adds the next vertex of the current rock.
    pub(crate) fn add(&mut self, [x, y, z]: [f32; 3]) {
        self.sum = [self.sum[0] + x, self.sum[1] + y];
        self.count += 1.0;
        self.top = self.top.max(z);
    }

    /// Completes the current rock.
    pub(crate) fn close(&mut self) {
        let [x, y] = self.sum.map(|sum| sum / self.count.max(1.0));
        self.rocks.push([x, y, self.top]);
        (self.sum, self.count, self.top) = ([0.0; 2], 0.0, 0.0);
    }

    /// Whether nothing of `rock` is left above the ground; the other arguments are those of [`Stands::sinks`].
    pub(crate) fn hides(&self, rock: usize, image: [f32; 2], highest: f32, hash: u32) -> bool {
        self.sinks(rock, image, highest, hash) == STEPS as u32
    }

    /// How far `rock` sinks, in steps of 1/31 of `highest`. It sinks deeper the nearer it is to the border of `image`;
    /// the depth varies from rock to rock with its `hash`, and the border is wavy.
    pub(crate) fn sinks(&self, rock: usize, image: [f32; 2], highest: f32, hash: u32) -> u32 {
        let Some(&[x, y, top]) = self.rocks.get(rock) else { return 0 };
        let side = image[0].min(image[1]).max(1.0);
        // The distance to the border of the image, with the image's corners rounded off.
        let corner = 0.15 * side;
        let beyond = |at: f32, size: f32| (corner - at.min(size - at)).max(0.0);
        let inwards = corner - beyond(x, image[0]).hypot(beyond(y, image[1]));
        let margin = 0.1 * side;
        let at = [x / margin, y / margin];
        let broad = (0.9 * at[0] + 1.1 * at[1] + 2.0).sin() + (1.3 * at[0] - 0.8 * at[1]).sin();
        let fine = (2.8 * at[0] + 2.0).sin() + (2.4 * at[1]).sin() + (4.5 * (at[0] + at[1]) + 1.0).sin();
        let depth = inwards / margin - 0.2 + 0.3 * broad + 0.12 * fine - 0.5 * palette::share(hash, 0);
        let t = (depth / 0.8).clamp(0.0, 1.0);
        let sunk = 1.05 * (1.0 - t * t * (3.0 - 2.0 * t));
        // A rock that would be hidden goes as deep as possible, because from afar small differences of depth cannot be
        // resolved; and so does one of which only a flat rest would be left. The others keep most of their height.
        let steps = if sunk > 0.7 { STEPS } else { (sunk.min(0.35) * top / highest * STEPS).round() };
        steps.clamp(0.0, STEPS) as u32
    }
}
