//! Random streams: one named portable generator per (seed, purpose, layer, item).
//!
//! Every random number comes from the stream of its own purpose and item. Moving one slider therefore leaves every
//! other random choice alone (decision A21 in docs/decisions.md), and rock 17 does not depend on rock 16. The generator
//! is xoshiro256++ (Blackman & Vigna), whose output `rand` guarantees. The mapping from integers to other numbers is
//! our own, so that no change in a library can change a field.

use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};

/// What a stream is for. The numbers are part of what a seed promises, so they must never be reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// The pixels that darts are thrown at. The item is 0.
    Darts = 1,
    /// The order in which a layer's cells are visited. The item is 0.
    VisitingOrder = 2,
    /// The points p_add of a rock. The item is the site.
    TopPoints = 3,
    /// j1 of Eqs 2 and 3. The item is the site.
    RockSwing = 4,
    /// j2 of Eqs 2 and 3, drawn in the order of the top vertices. The item is the site.
    VertexSwing = 5,
    /// j1 of Eq. 3 if it is drawn separately (decision A11). The item is the site.
    RockSwingHeight = 6,
    /// j2 of Eq. 3 if it is drawn separately. The item is the site.
    VertexSwingHeight = 7,
    /// Facets, leaning sides and squeeze of a worn rock. The item is the site.
    Facets = 8,
    /// Place of a rough rock in the noise. The item is the site.
    Bumps = 9,
    /// Whether a vertex of the log carries a wood ear. Here and in the next six, the item is the vertex (or the foot,
    /// see [`Purpose::Feet`]).
    Spawn = 10,
    /// The turn of a wood ear about its axis.
    Twist = 11,
    /// The number U of decision K7, which decides a wood ear's size.
    EarSize = 12,
    /// Place of a wood ear in the noise by which it dries (Eq. 3.2).
    Drying = 13,
    /// Place of a wood ear in the noise by which it wrinkles (Eq. 3.4).
    Wrinkling = 14,
    /// How strongly a wood ear wrinkles (decision K3).
    WrinkleShare = 15,
    /// How far a wood ear droops.
    Droop = 16,
    /// Places of a log's bark and broken ends in the noise, and the log's knots. The item is 0.
    Bark = 17,
    /// The places on a log given by the user where wood ears can stand. The item is 0.
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

    /// Draws a number uniform in [0, 1), from the upper 53 bits.
    #[inline]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// Draws a direction in the plane: towards a random point of a square, which is close enough to uniform.
    pub(crate) fn direction(&mut self) -> DVec2 {
        let [x, y] = [2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0];
        DVec2::new(x, y).normalize_or(DVec2::X)
    }

    /// Draws an integer uniform in 0 … n − 1, without bias (Lemire 2019, *Fast random integer generation in an
    /// interval*).
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

    /// Draws a pixel (column, row), from the two halves of one number. For sides up to 8192, the probabilities are off
    /// by less than 2⁻¹⁹.
    #[inline]
    pub(crate) fn pixel(&mut self, width: u32, height: u32) -> [u16; 2] {
        let bits = self.0.next_u64();
        let column = ((bits >> 32) * u64::from(width)) >> 32;
        let row = ((bits & 0xffff_ffff) * u64::from(height)) >> 32;
        [column as u16, row as u16]
    }
}

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014). Every input bit affects every output bit.
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
