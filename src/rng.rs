//! Random streams: one named portable generator per (seed, purpose, layer, item).
//!
//! Every draw of the field comes from the stream of its own purpose and item, so that moving one
//! slider leaves every other random choice alone (decision A21), and rock 17 does not depend on
//! rock 16. The generator is xoshiro256++ (Blackman & Vigna), whose output `rand` guarantees;
//! the mapping from integers to numbers is ours, so that no library's distribution code can change a field.

use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};

/// What a stream is for. The numbers are part of what a seed promises: never reuse one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Pixels that darts are thrown at; item 0.
    Darts = 1,
    /// Order in which a layer's cells are visited; item 0.
    VisitingOrder = 2,
    /// p_add of a rock; item = site.
    TopPoints = 3,
    /// j1 of Eqs 2 and 3; item = site.
    RockSwing = 4,
    /// j2 of Eqs 2 and 3, drawn in the order of the top vertices; item = site.
    VertexSwing = 5,
    /// j1 of Eq. 3 where it is drawn apart (decision A11); item = site.
    RockSwingHeight = 6,
    /// j2 of Eq. 3 where it is drawn apart; item = site.
    VertexSwingHeight = 7,
    /// Facets, leaning sides and squeeze of a worn rock; item = site.
    Facets = 8,
    /// Where in the noise a rough rock lies; item = site.
    Bumps = 9,
    /// Whether a vertex of the log carries a wood ear; item = vertex (or foot, see [`Purpose::Feet`]), as in the next six.
    Spawn = 10,
    /// Turn of a wood ear about its axis.
    Twist = 11,
    /// U of decision K7.
    EarSize = 12,
    /// Where in the noise a wood ear dries (Eq. 3.2).
    Drying = 13,
    /// Where in the noise a wood ear wrinkles (Eq. 3.4).
    Wrinkling = 14,
    /// How much of the wrinkling it has (decision K3).
    WrinkleShare = 15,
    /// How far it droops.
    Droop = 16,
    /// Where in the noise the bark and the broken ends of a log lie, and its knots; item 0.
    Bark = 17,
    /// Where on a mesh of the user's own wood ears can stand; item 0.
    Feet = 18,
}

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Stream(Xoshiro256PlusPlus);

impl Stream {
    pub(crate) fn new(seed: u32, purpose: Purpose, layer: u32, item: u32) -> Self {
        let origin = mix((u64::from(seed) << 32) | u64::from(layer));
        let key = mix(origin ^ ((u64::from(item) << 8) | purpose as u64));
        Stream(Xoshiro256PlusPlus::seed_from_u64(key))
    }

    /// Uniform in [0, 1): the upper 53 bits.
    #[inline]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A direction in the plane, near enough to uniform: towards a point of a square.
    pub(crate) fn direction(&mut self) -> DVec2 {
        let [x, y] = [2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0];
        DVec2::new(x, y).normalize_or(DVec2::X)
    }

    /// Uniform in 0 … n − 1, without bias (Lemire 2019, *Fast random integer generation in an interval*).
    #[inline]
    pub(crate) fn below(&mut self, n: u32) -> u32 {
        let mut product = u64::from(self.0.next_u32()) * u64::from(n);
        if (product as u32) < n {
            let threshold = n.wrapping_neg() % n;
            while (product as u32) < threshold {
                product = u64::from(self.0.next_u32()) * u64::from(n);
            }
        }
        (product >> 32) as u32
    }

    /// A pixel (column, row), from the two halves of one number; off uniform by less than 2⁻¹⁹ for sides up to 8192.
    #[inline]
    pub(crate) fn pixel(&mut self, width: u32, height: u32) -> [u16; 2] {
        let bits = self.0.next_u64();
        let column = ((bits >> 32) * u64::from(width)) >> 32;
        let row = ((bits & 0xffff_ffff) * u64::from(height)) >> 32;
        [column as u16, row as u16]
    }
}

/// SplitMix64's finaliser (Steele, Lea & Flood 2014): every input bit reaches every output bit.
fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_of_neighbouring_keys_are_unlike() {
        let first = |seed, purpose, layer, item| Stream::new(seed, purpose, layer, item).0.next_u64();
        let origin = first(0, Purpose::TopPoints, 0, 0);
        for other in [
            first(1, Purpose::TopPoints, 0, 0),
            first(0, Purpose::RockSwing, 0, 0),
            first(0, Purpose::TopPoints, 1, 0),
            first(0, Purpose::TopPoints, 0, 1),
        ] {
            assert!((origin ^ other).count_ones() > 12, "{origin:x} {other:x}");
        }
    }

    #[test]
    fn below_reaches_every_value_and_nothing_else() {
        let mut stream = Stream::new(7, Purpose::Darts, 0, 0);
        let mut seen = [0_u32; 7];
        for _ in 0..7000 {
            seen[stream.below(7) as usize] += 1;
        }
        assert!(seen.iter().all(|n| (850..1150).contains(n)), "{seen:?}");
    }
}
