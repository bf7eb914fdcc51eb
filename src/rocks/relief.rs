//! The surface of a stone: what breaking, weather and a river have left on it, from its shape down to its own triangles.
//!
//! Every feature moves points along the rays from the stone's middle, which cannot tear the surface open. A rough stone
//! has, by the same `roughness`, different features as it weathers: freshly broken, scars with crisp ridges between
//! them; then ledges along its beds, cracks along its joints and pits; and in the end only the swells that a river
//! leaves. Octaves of noise go on until they are as fine as the stone's triangles.

use glam::DVec3;

use crate::noise::{noise, scars};
use crate::rng::{Purpose, Stream};

/// Amplitude of all swells and scars at roughness 1, as a share of the stone's radius.
const BUMPS: f64 = 0.16;

/// Features per radius of the coarsest swells, and how many times finer each octave is than the one before.
const COARSEST: f64 = 1.4;
const FINER: f64 = 2.1;

/// How much lower each octave is, on a fresh and on a worn stone.
const GAIN: f64 = 0.52;
const GAIN_WORN: f64 = 0.3;

/// The finest octave that the triangles can show, in features per radius and segment.
const FINEST: f64 = 0.41;

/// What is lower than this, in radii, is left out.
const LEAST: f64 = 0.0015;

/// Scars that are so many times as high as swells hide all but the coarsest of them.
const HIDES: f64 = 3.0;

/// Number of beds per radius, and the share of a bed in which its ledge rises.
const BEDS: f64 = 4.5;
const LEDGE: f64 = 0.14;

/// How far beds stand out, and how deep cracks and pits are, in radii.
const BEDS_OUT: f64 = 0.075;
const CRACK_DEPTH: f64 = 0.09;
const PIT_DEPTH: f64 = 0.5;

/// Number of joints along which a stone has cracked.
const JOINTS: usize = 2;

/// What is needed to displace the surface of one stone.
pub(super) struct Relief {
    swells: f64,
    scars: f64,
    gain: f64,
    octaves: usize,
    offset: DVec3,
    beds: f64,
    bedding: DVec3,
    /// Per joint, its normal and its distance from the middle.
    joints: [(DVec3, f64); JOINTS],
    crack: f64,
    crack_width: f64,
    pits: f64,
    /// A river's stone is blunter on this side.
    blunt: DVec3,
}

impl Relief {
    /// `worn` is 0 for a freshly broken stone and 1 for a rounded one, `key` is the seed, the layer and the site.
    #[inline(never)]
    pub(super) fn new(roughness: f64, worn: f64, segments: usize, [seed, layer, site]: [u32; 3]) -> Self {
        let mut stream = Stream::new(seed, Purpose::Bumps, layer, site);
        let offset = DVec3::new(stream.unit(), stream.unit(), stream.unit()) * 512.0;
        let fresh = 1.0 - worn;
        let tilted = |stream: &mut Stream, tilt: f64| {
            let z = 1.0 - tilt * stream.unit();
            (stream.direction() * (1.0 - z * z).sqrt()).extend(z)
        };
        let bedding = tilted(&mut stream, 0.25);
        let bedded = stream.unit();
        let joints = core::array::from_fn(|_| {
            let upright = stream.direction().extend(0.35 * (2.0 * stream.unit() - 1.0)).normalize();
            (upright, 0.9 * (stream.unit() - 0.5))
        });
        let blunt = stream.direction().extend(0.3 * stream.unit());
        // What stands out by less than a triangle's edge is not there yet on a coarse mesh.
        let shown = ((segments as f64 - 2.0) / 6.0).clamp(0.0, 1.0);
        let some = (2.0 * roughness).min(1.0) * shown;
        let seen = |amplitude: f64| if amplitude < LEAST { 0.0 } else { amplitude };
        let swells = seen(BUMPS * roughness * (0.15 + 3.4 * worn * fresh).clamp(0.6 * worn, 0.9));
        let scars = seen(1.1 * BUMPS * roughness * fresh * fresh * shown);
        let gain = GAIN + (GAIN_WORN - GAIN) * worn;
        let finest = FINEST * segments as f64;
        let (mut octaves, mut frequency, mut amplitude) = (1, COARSEST * FINER, gain * swells.max(scars));
        while frequency <= finest && amplitude >= LEAST {
            octaves += 1;
            frequency *= FINER;
            amplitude *= gain;
        }
        Relief {
            swells,
            scars,
            gain,
            octaves,
            offset,
            beds: seen(BEDS_OUT * some * fresh * bedded * bedded * (0.5 + 2.0 * worn).min(1.0)),
            bedding,
            joints,
            crack: seen(CRACK_DEPTH * some * fresh * ((segments as f64 - 8.0) / 8.0).clamp(0.0, 1.0)),
            crack_width: (1.6 / segments as f64).max(0.035),
            pits: PIT_DEPTH * (roughness - 0.4).max(0.0) * fresh * shown,
            blunt: blunt * (0.22 * worn),
        }
    }

    /// Whether the surface stays as it is.
    pub(super) fn is_none(&self) -> bool {
        self.swells == 0.0 && self.scars == 0.0 && self.blunt == DVec3::ZERO
    }

    /// The factor for the distance of a point from the middle. The point is given relative to the middle, in radii.
    #[inline(never)]
    pub(super) fn at(&self, from_middle: DVec3) -> f64 {
        let mut out = 1.0;
        if self.blunt != DVec3::ZERO {
            let ray = from_middle.normalize_or(DVec3::Z);
            out += 0.5 * (self.blunt.dot(ray) - self.blunt.length());
        }
        if self.swells == 0.0 && self.scars == 0.0 {
            return out;
        }
        let (mut frequency, mut amplitude) = (COARSEST, 1.0);
        let (mut swells, mut scarred) = (0.0, 0.0);
        let mut coarsest = 0.0;
        for octave in 0..self.octaves {
            let at = from_middle * frequency + self.offset;
            let is_hidden = octave > 0 && self.scars > HIDES * self.swells && self.pits == 0.0;
            let value = if is_hidden { 0.0 } else { noise(at) };
            swells += amplitude * value;
            if octave == 0 {
                coarsest = value;
            }
            if self.scars > 0.0 {
                scarred += amplitude * (scars(at) - 0.5);
            }
            if self.pits > 0.0 && octave >= 2 {
                out -= self.pits * amplitude * (value - 0.3).max(0.0);
            }
            frequency *= FINER;
            amplitude *= self.gain;
        }
        out += self.swells * swells + self.scars * scarred;
        if self.beds > 0.0 {
            out += self.beds * ledges(from_middle.dot(self.bedding) * BEDS + 0.3 * coarsest + self.offset.x);
        }
        if self.crack > 0.0 {
            for (normal, distance) in self.joints {
                // A crack wanders, and ends.
                let off = (from_middle.dot(normal) - distance - 0.06 * coarsest).abs() / self.crack_width;
                out -= self.crack * (1.0 - off).max(0.0) * (0.6 + 1.5 * coarsest).clamp(0.0, 1.0);
            }
        }
        out.max(0.4)
    }
}

/// How far the bed at this height stands out, −1 … 1: each by another amount, with a crisp ledge between two, and below it a
/// joint that has been washed out.
fn ledges(height: f64) -> f64 {
    let bed = height.floor();
    let within = height - bed;
    let of = |bed: f64| noise(DVec3::new(bed * 3.7 + 0.5, 0.5, 0.5));
    let t = ((within - (1.0 - LEDGE)) / LEDGE).max(0.0);
    let rise = t * t * (3.0 - 2.0 * t);
    of(bed) + (of(bed + 1.0) - of(bed)) * rise - 1.2 * t * (1.0 - t)
}
