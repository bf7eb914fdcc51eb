//! Drying and wrinkling (Eqs 3.2 to 3.5), which make individuals of one size differ.

use glam::DVec3;

use super::spawn::Individual;
use crate::noise::noise;
use crate::params::wood_ear::Params;
use crate::rng::{Purpose, Stream};

/// The gain g of decision K2. Fractal noise hardly leaves ±0.5, so without it a dry rim would hardly shrink. With it,
/// 95 % of |n| lie below 0.85, and only few meridians are cut off at 1, which would show as spikes.
const DRYING_GAIN: f64 = 1.5;
/// The gain for wrinkles. They are folds of a given strength, so many vertices may reach it.
const WRINKLING_GAIN: f64 = 2.0;
/// Largest share by which a vertex shrinks: at least a tenth of its distance is left (decisions K2, K3).
const MOST: f64 = 0.9;

/// k of decision K4 and the number of octaves, for drying and for wrinkling. k · 2^(octaves − 1) has to stay below c /
/// 4π; above it, the noise is no longer smooth from vertex to vertex.
const DRYING: (f64, u32) = (0.7, 2);
const WRINKLING: (f64, u32) = (1.5, 1);
/// q of decision K4, by which wrinkling also changes along a meridian.
const ALONG: f64 = 3.0;

/// One individual's sheet in its own frame, in units of its size, together with the size.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sheet {
    /// Rim radius before drying, cm.
    pub size: f64,
    /// The vertices, ring by ring, in the order of [`super::bowl()`].
    pub points: Vec<DVec3>,
}

/// The size of the individual on a vertex: size · v^U, with U uniform in −1 … 1 (decision K7). cm.
pub(super) fn size(params: &Params, vertex: u32) -> f64 {
    let u = 2.0 * Stream::new(params.seed, Purpose::EarSize, 0, vertex).unit() - 1.0;
    params.size * power(params.size_spread, u)
}

/// v^u for 1 ≤ v ≤ 2 and |u| ≤ 1, computed with + − × ÷ √ only: the binary digits of u select factors from the repeated
/// square roots of v.
fn power(v: f64, u: f64) -> f64 {
    if v == 1.0 {
        return 1.0;
    }
    let (mut left, mut root, mut product) = (u.abs(), v, 1.0);
    for _ in 0..40 {
        if left >= 1.0 {
            product *= root;
            left -= 1.0;
        }
        left *= 2.0;
        root = root.sqrt();
    }
    if u < 0.0 { 1.0 / product } else { product }
}

/// How strongly an individual wrinkles, 0 … 1. With `per_individual` at 1, about one in five does not wrinkle at all
/// (decision K3).
fn wrinkle_share(params: &Params, vertex: u32) -> f64 {
    if params.per_individual == 0.0 {
        return 1.0;
    }
    let share = (1.25 * Stream::new(params.seed, Purpose::WrinkleShare, 0, vertex).unit() - 0.25).max(0.0);
    1.0 + (share - 1.0) * params.per_individual
}

/// Fractal noise: the sum of the octaves divided by the sum of their amplitudes, with persistence 0.5, so |n| ≤ 1
/// (decision K4).
fn fractal(at: DVec3, octaves: u32) -> f64 {
    let (mut sum, mut amplitudes, mut amplitude, mut scale) = (0.0, 0.0, 1.0, 1.0);
    for _ in 0..octaves {
        sum += amplitude * noise(at * scale);
        amplitudes += amplitude;
        amplitude *= 0.5;
        scale *= 2.0;
    }
    sum / amplitudes
}

/// The place of an individual in the noise: its own seed in decision K4.
fn place(params: &Params, purpose: Purpose, vertex: u32) -> DVec3 {
    let mut stream = Stream::new(params.seed, purpose, 0, vertex);
    DVec3::new(stream.unit(), stream.unit(), stream.unit()) * 4096.0
}

/// Returns n of Eq. 3.2 for each meridian, −1 … 1. The noise is sampled on a circle, so that f = c meets f = 1. `unit`
/// is the bowl of [`super::bowl()`].
pub fn drying(params: &Params, vertex: u32, unit: &[DVec3]) -> Vec<f64> {
    let (k, octaves) = DRYING;
    let origin = place(params, Purpose::Drying, vertex);
    let circle = unit.iter().take(params.meridians as usize).map(|p| on_circle(params, *p));
    circle
        .map(|[c, s]| (DRYING_GAIN * fractal(origin + DVec3::new(k * c, k * s, 0.0), octaves)).clamp(-1.0, 1.0))
        .collect()
}

/// (cos θ, sin θ) of a vertex of the first ring.
fn on_circle(params: &Params, p: DVec3) -> [f64; 2] {
    let d = f64::from(params.rings);
    [p.z * d, p.x * d]
}

/// Returns the sheet of an individual: the unit bowl `unit`, dried and wrinkled.
///
/// Drying scales a vertex about the foot by 1 − |n| e/d (1 − m/100), with the same n along a meridian (Eqs 3.2, 3.3;
/// decision K2 reverses the effect of m and adds the gain). Wrinkling scales x and z by 1 − max(n, 0) s/100, with
/// another n at every vertex (Eqs 3.4, 3.5; K3).
pub fn deform(params: &Params, individual: &Individual, unit: &[DVec3]) -> Sheet {
    let vertex = individual.vertex;
    let meridians = params.meridians as usize;
    let d = f64::from(params.rings);
    let dryness = 1.0 - params.moisture / 100.0;
    let strength = params.wrinkles / 100.0 * wrinkle_share(params, vertex);
    let mut points = unit.to_vec();
    if dryness > 0.0 {
        let n = drying(params, vertex, unit);
        for (e, ring) in (1..).zip(points.chunks_exact_mut(meridians)) {
            let step = f64::from(e) / d * dryness;
            for (p, n) in ring.iter_mut().zip(&n) {
                *p *= 1.0 - (n.abs() * step).min(MOST);
            }
        }
    }
    if strength > 0.0 {
        let (k, octaves) = WRINKLING;
        let origin = place(params, Purpose::Wrinkling, vertex);
        let circle: Vec<[f64; 2]> = unit.iter().take(meridians).map(|p| on_circle(params, *p)).collect();
        for (e, ring) in (1..).zip(points.chunks_exact_mut(meridians)) {
            let along = ALONG * f64::from(e) / d;
            for (p, [c, s]) in ring.iter_mut().zip(&circle) {
                let n = (WRINKLING_GAIN * fractal(origin + DVec3::new(k * c, k * s, along), octaves)).clamp(0.0, 1.0);
                let scale = 1.0 - (n * strength).min(MOST);
                p.x *= scale;
                p.z *= scale;
            }
        }
    }
    Sheet { size: size(params, vertex), points }
}
