//! The sky of natural colours: what the air scatters of the sun's light, what it leaves of it, and how a camera would be set for both.
//!
//! The air is that of S. Hillaire, *A scalable and production ready sky and atmosphere rendering technique* (2020): molecules, a haze of
//! droplets, and ozone in a layer; scattered once along the ray, and more than once as his series has it. How much air there is towards the sun is
//! approximated as in C. Schüler, *An approximation to the Chapman grazing-incidence function for atmospheric scattering* (2012).
//!
//! Light is told in units of what a white, matte surface sends back that faces the sun above the air, multiplied by the camera's exposure and
//! white balance. An irradiance is told as that surface's radiance: divided by π. Colours are linear. Lengths are km.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use glam::{Vec2, Vec3};

/// Columns of the map, from the sun's azimuth to the opposite one: the other half of the sky is its mirror image. A column is told by the sine
/// of half the angle from the sun's azimuth and a row by the root of the elevation's sine, which a shader finds without inverse functions.
pub(crate) const COLUMNS: usize = 96;
/// Rows of the map, from the horizon to the zenith, and denser near the horizon.
pub(crate) const ROWS: usize = 48;

const EARTH: f32 = 6360.0;
/// Where the air ends for us.
const SPACE: f32 = 6460.0;
/// How high the field lies.
const GROUND: f32 = 0.3;

/// What a km of the air at sea level scatters, and over how many km it gets thinner by e.
const MOLECULES: (Vec3, f32) = (Vec3::new(5.802e-3, 13.558e-3, 33.1e-3), 8.0);
/// The same of haze, as on a clear day over land; it absorbs little of what it scatters.
const HAZE: (f32, f32) = (0.042, 1.2);
const HAZE_EXTINCTION: f32 = 1.06;
/// How much haze scatters forwards.
const FORWARD: f32 = 0.7;
/// What a km of ozone absorbs, and the layer that it forms: its middle and half its width.
const OZONE: (Vec3, f32, f32) = (Vec3::new(0.650e-3, 1.881e-3, 0.085e-3), 25.0, 15.0);
/// Of the ground, which lights the haze from below.
const ALBEDO: f32 = 0.25;

/// Three wavelengths stand for wide and overlapping bands, whose colours are paler.
const SATURATION: f32 = 0.64;

/// Light under one sky.
#[derive(Clone, Debug)]
pub(crate) struct Sky {
    /// Irradiance of a surface that faces the sun, divided by π.
    pub(crate) sunshine: Vec3,
    /// Irradiance by the sky alone, divided by π, of a surface with normal (x, y, z), where x is the part of it towards the sun's
    /// azimuth: `c0 + c1·z + c2·x + c3·z² + c4·x·z + c5·(x² − y²)`.
    pub(crate) diffuse: [Vec3; 6],
    /// Radiances, row after row.
    map: Vec<Vec3>,
}

impl Sky {
    /// The sky whose sun stands so high, radians, as the camera takes it over ground on which so much `snow` has fallen, 0…1.
    pub(crate) fn new(elevation: f32, snow: f32) -> Self {
        let air = Air::new(elevation);
        let mut map = Vec::with_capacity(COLUMNS * ROWS);
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let light = air.radiance(direction(column, row));
                map.push(Vec3::splat(luminance(light)).lerp(light, SATURATION));
            }
        }
        let mut sky = Self { sunshine: air.towards_sun(GROUND, air.sun.z), diffuse: diffuse(&map), map };
        sky.expose(elevation, snow);
        sky
    }

    /// Radiance from a direction of length 1; below the horizon, that of the horizon. `sun` is the direction of the sun.
    #[allow(dead_code, reason = "what `sky_radiance` of sky.wgsl finds, for who chooses directions of the sky")]
    pub(crate) fn radiance(&self, direction: Vec3, sun: Vec3) -> Vec3 {
        let [column, row] = place(direction, sun);
        let [left, low] = [column.floor(), row.floor()];
        let at = |column: f32, row: f32| {
            let column = column.clamp(0.0, COLUMNS as f32 - 1.0) as usize;
            let row = row.clamp(0.0, ROWS as f32 - 1.0) as usize;
            self.map.get(row * COLUMNS + column).copied().unwrap_or_default()
        };
        let along = |row: f32| at(left, row).lerp(at(left + 1.0, row), column - left);
        along(low).lerp(along(low + 1.0), row - low)
    }

    /// The diffuse light as the shaders have it, and the sun's azimuth.
    pub(crate) fn uniforms(&self, sun: Vec3) -> [[f32; 4]; 6] {
        let azimuth = sun.truncate().try_normalize().unwrap_or(Vec2::X);
        let mut rows = self.diffuse.map(|light| light.extend(0.0).to_array());
        rows[0][3] = azimuth.x;
        rows[1][3] = azimuth.y;
        rows
    }

    /// The map as four half floats a texel.
    pub(crate) fn texels(&self) -> Vec<[u16; 4]> {
        self.map.iter().map(|light| light.extend(1.0).to_array().map(half)).collect()
    }

    /// Irradiance by the sky alone of a surface that faces up, divided by π.
    fn on_level_ground(&self) -> Vec3 {
        let [c0, c1, _, c3, ..] = self.diffuse;
        c0 + c1 + c3
    }

    /// Sets the camera: white balance and exposure.
    fn expose(&mut self, elevation: f32, snow: f32) {
        let level = self.sunshine * elevation.sin() + self.on_level_ground();
        // What stands faces a low sun, and is what a photographer would meter then.
        let upright = self.sunshine * elevation.cos() + 0.5 * self.on_level_ground();
        let key = luminance(level).max(0.72 * luminance(upright));
        // White is what is white at noon; and as eyes do, the camera gets used to some of what is warmer than that.
        let warm = level / luminance(level);
        let gains = warm.map(|share| share.powf(-0.4));
        let gains = gains / luminance(gains * warm) * (EXPOSURE * key.powf(-0.85));
        // Snow in the sun would be blank: a photographer closes the lens.
        let gains = gains / (1.0 + 1.1 * snow * elevation.sin());
        self.sunshine *= gains;
        for light in self.diffuse.iter_mut().chain(&mut self.map) {
            *light *= gains;
        }
    }
}

/// How bright a white and level surface is under the sky, before the tone curve.
const EXPOSURE: f32 = 2.55;

fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Towards the middle of a texel, where the sun's azimuth is that of x.
fn direction(column: usize, row: usize) -> Vec3 {
    let share = (row as f32 + 0.5) / ROWS as f32;
    let sine = share * share;
    (azimuth(column as f32 + 0.5) * (1.0 - sine * sine).sqrt()).extend(sine)
}

/// Direction on the ground that a column of the map has, in its middle if half is added to its number.
fn azimuth(column: f32) -> Vec2 {
    let half = column / COLUMNS as f32;
    Vec2::new(1.0 - 2.0 * half * half, 2.0 * half * (1.0 - half * half).max(0.0).sqrt())
}

/// Where a direction is in the map: column and row, where whole numbers are the middles of texels.
#[allow(dead_code, reason = "as for `Sky::radiance`")]
fn place(direction: Vec3, sun: Vec3) -> [f32; 2] {
    let [sun, flat] = [sun, direction].map(|way| way.truncate().try_normalize().unwrap_or(Vec2::X));
    let half = (0.5 - 0.5 * sun.dot(flat)).max(0.0).sqrt();
    [half * COLUMNS as f32 - 0.5, direction.z.max(0.0).sqrt() * ROWS as f32 - 0.5]
}

/// The irradiance of all directions, in spherical harmonics up to the second order (R. Ramamoorthi and P. Hanrahan, *An efficient
/// representation for irradiance environment maps*, 2001).
fn diffuse(map: &[Vec3]) -> [Vec3; 6] {
    let mut sums = [Vec3::ZERO; 6];
    for (row, lights) in map.chunks_exact(COLUMNS).enumerate() {
        // The sine of the elevation at both edges of the row: a texel's solid angle is as large as their difference.
        let sine = |row: usize| (row as f32 / ROWS as f32).powi(2);
        for (column, &light) in lights.iter().enumerate() {
            // An arc by its chord, and again in the mirror image.
            let chord = (azimuth(column as f32 + 1.0) - azimuth(column as f32)).length();
            let angle = 2.0 * chord * (1.0 + chord * chord / 24.0) * (sine(row + 1) - sine(row));
            let Vec3 { x, y, z } = direction(column, row);
            let basis = [
                0.282_095,
                0.488_603 * z,
                0.488_603 * x,
                0.315_392 * (3.0 * z * z - 1.0),
                1.092_548 * x * z,
                0.546_274 * (x * x - y * y),
            ];
            for (sum, value) in sums.iter_mut().zip(basis) {
                *sum += light * value * angle;
            }
        }
    }
    // A cosine's share of each order, divided by π.
    let [c0, c1, c2, c3, c4, c5] = sums;
    [
        c0 * 0.282_095 - c3 * (0.25 * 0.315_392),
        c1 * (2.0 / 3.0 * 0.488_603),
        c2 * (2.0 / 3.0 * 0.488_603),
        c3 * (0.25 * 3.0 * 0.315_392),
        c4 * (0.25 * 1.092_548),
        c5 * (0.25 * 0.546_274),
    ]
}

/// The air with a sun above it.
struct Air {
    sun: Vec3,
    /// What light that was scattered more than once adds, at heights [`HEIGHTS`] apart.
    more: [Vec3; 6],
}

const HEIGHTS: f32 = 4.0;

impl Air {
    /// The sun's azimuth is that of x.
    fn new(elevation: f32) -> Self {
        let (sin, cos) = elevation.sin_cos();
        let mut air = Self { sun: Vec3::new(cos, 0.0, sin), more: [Vec3::ZERO; 6] };
        air.more = std::array::from_fn(|level| air.scattered_more(0.05 + level as f32 * HEIGHTS));
        air
    }

    /// What is left of the sun's light at a height, where the cosine of the sun's angle from the zenith is `up`.
    fn towards_sun(&self, height: f32, up: f32) -> Vec3 {
        let radius = EARTH + height;
        // How many times the air straight above.
        let masses = |scale: f32| {
            let c = (FRAC_PI_2 * radius / scale).sqrt();
            c / ((c - 1.0) * up.max(0.0) + 1.0)
        };
        let column = |scale: f32| scale * (-height / scale).exp() * masses(scale);
        let slant = |at: f32| {
            let sine = radius / (EARTH + at) * (1.0 - up * up).max(0.0).sqrt();
            (1.0 - sine * sine).max(1e-3).sqrt().recip()
        };
        let ozone = OZONE.2 * slant(OZONE.1.max(height)) * (1.0 - ((height - OZONE.1) / OZONE.2).clamp(0.0, 1.0));
        let depth = MOLECULES.0 * column(MOLECULES.1)
            + Vec3::splat(HAZE.0 * HAZE_EXTINCTION * column(HAZE.1))
            + OZONE.0 * ozone;
        // Behind the horizon.
        let horizon = -(1.0 - (EARTH / radius).powi(2)).max(0.0).sqrt();
        let risen = ((up - horizon) / 0.01).clamp(0.0, 1.0);
        (-depth).exp() * risen
    }

    /// Light that comes from a direction to a field on the ground.
    fn radiance(&self, direction: Vec3) -> Vec3 {
        const STEPS: usize = 24;
        let cosine = direction.dot(self.sun);
        let molecules = 3.0 / (16.0 * PI) * (1.0 + cosine * cosine);
        let square = FORWARD * FORWARD;
        // Cornette and Shanks.
        let haze = 3.0 / (8.0 * PI) * (1.0 - square) * (1.0 + cosine * cosine)
            / ((2.0 + square) * (1.0 + square - 2.0 * FORWARD * cosine).powf(1.5));
        let mut light = Vec3::ZERO;
        self.march(GROUND, direction, STEPS, |Step { height, up, scatter: (few, many), amount, .. }| {
            let sun = self.towards_sun(height, up);
            light += amount * (PI * sun * (few * molecules + many * haze) + (few + many) * self.more_at(height));
        });
        light
    }

    /// Hillaire's series: isotropic light of the second order, and its share that is scattered again and again.
    fn scattered_more(&self, height: f32) -> Vec3 {
        const DIRECTIONS: usize = 32;
        let mut second = Vec3::ZERO;
        let mut again = Vec3::ZERO;
        for number in 0..DIRECTIONS {
            // A spiral over the sphere.
            let z = 1.0 - (2.0 * number as f32 + 1.0) / DIRECTIONS as f32;
            let (sin, cos) = (2.399_963 * number as f32).sin_cos();
            let flat = (1.0 - z * z).sqrt();
            let direction = Vec3::new(flat * cos, flat * sin, z);
            let left =
                self.march(height, direction, 12, |Step { height, up, scatter: (few, many), amount, .. }| {
                    let scattered = amount * (few + many);
                    second += scattered * self.towards_sun(height, up) * (PI * 0.25 * FRAC_1_PI);
                    again += scattered;
                });
            if let Some(left) = left {
                second += left * self.towards_sun(0.0, self.sun.z) * (ALBEDO * self.sun.z.max(0.0));
            }
        }
        let all = 1.0 / DIRECTIONS as f32;
        second * all / (Vec3::ONE - again * all)
    }

    fn more_at(&self, height: f32) -> Vec3 {
        let at = (height / HEIGHTS).min(4.999);
        let level = at as usize;
        match self.more.get(level..level + 2) {
            Some(&[low, high]) => low.lerp(high, at - level as f32),
            _ => Vec3::ZERO,
        }
    }

    /// Goes through the air in steps that grow. Returns what is left of light from the ground, if the ray meets it.
    fn march(&self, from: f32, direction: Vec3, steps: usize, mut see: impl FnMut(Step)) -> Option<Vec3> {
        let radius = EARTH + from;
        let along = radius * direction.z;
        let to = |sphere: f32| along * along - radius * radius + sphere * sphere;
        let ground =
            Some(to(EARTH)).filter(|&square| direction.z < 0.0 && square > 0.0).map(|square| -along - square.sqrt());
        let end = ground.unwrap_or_else(|| -along + to(SPACE).max(0.0).sqrt());
        let mut left = Vec3::ONE;
        let mut start = 0.0;
        for step in 1..=steps {
            let stop = end * (step as f32 / steps as f32).powi(2);
            let (middle, length) = (0.5 * (start + stop), stop - start);
            let at = direction * middle + Vec3::Z * radius;
            let height = (at.length() - EARTH).max(0.0);
            let few = MOLECULES.0 * (-height / MOLECULES.1).exp();
            let many = HAZE.0 * (-height / HAZE.1).exp();
            let ozone = OZONE.0 * (1.0 - (height - OZONE.1).abs() / OZONE.2).max(0.0);
            let lost = few + many * HAZE_EXTINCTION + ozone;
            let through = (-lost * length).exp();
            let amount = left * (Vec3::ONE - through) / lost.max(Vec3::splat(1e-9));
            see(Step { height, up: at.normalize().dot(self.sun), scatter: (few, Vec3::splat(many)), amount });
            left *= through;
            start = stop;
        }
        ground.map(|_| left)
    }
}

/// A piece of a ray.
struct Step {
    height: f32,
    /// The cosine of the sun's angle from the zenith there.
    up: f32,
    /// What a km scatters: molecules, haze.
    scatter: (Vec3, Vec3),
    /// By how much what a km sends towards the ray's origin has to be multiplied.
    amount: Vec3,
}

/// Rounds to a half float, of 0…65504.
fn half(value: f32) -> u16 {
    // The smallest steps of a half float.
    const TINY: f32 = 5.960_464_5e-8;
    let value = value.clamp(0.0, 65504.0);
    if value < 6.103_515_6e-5 {
        return (value / TINY).round() as u16;
    }
    let bits = value.to_bits() + 0x0fff + ((value.to_bits() >> 13) & 1);
    ((bits - 0x3800_0000) >> 13) as u16
}

#[cfg(test)]
mod tests;
