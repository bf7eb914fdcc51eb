//! Flags of pixels, one bit each.
//!
//! The bits are arranged in vertical strips 64 px wide: the word of pixel (x, y) is `(x / 64) · height + y`. A disc or
//! a cell touches one or two strips, and consecutive words in each of them. Stamping a disc of radius 10 therefore
//! writes about 160 contiguous bytes instead of one cache line per row.

/// A pixel (column, row). A site stands on one: its position is the pixel's centre, (column + 0.5, row + 0.5).
pub type Pixel = [u16; 2];

/// Number of pixels per word.
const STRIP: u32 = 64;

/// The flags of a `width` × `height` image. All are clear at first.
#[derive(Debug, Clone)]
pub(crate) struct Bitmap {
    width: u32,
    height: u32,
    words: Vec<u64>,
}

impl Bitmap {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let strips = width.div_ceil(STRIP) as usize;
        Bitmap { width, height, words: vec![0; strips * height as usize] }
    }

    /// Number of pixels of the image, W·H.
    pub(crate) fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Whether the pixel is flagged.
    #[inline]
    pub(crate) fn get(&self, x: u32, y: u32) -> bool {
        let word = (x / STRIP) as usize * self.height as usize + y as usize;
        (self.words[word] >> (x % STRIP)) & 1 != 0
    }

    /// Flags the pixels x0 … x1 of row y (inclusive, and within the image).
    #[inline]
    pub(crate) fn fill_span(&mut self, y: u32, x0: u32, x1: u32) {
        for strip in x0 / STRIP..=x1 / STRIP {
            let word = strip as usize * self.height as usize + y as usize;
            self.words[word] |= strip_mask(strip, x0, x1);
        }
    }

    /// Whether any of the pixels x0 … x1 of row y is flagged (inclusive, and within the image).
    #[inline]
    pub(crate) fn any_in_span(&self, y: u32, x0: u32, x1: u32) -> bool {
        let is_taken = |strip: u32| {
            let word = strip as usize * self.height as usize + y as usize;
            self.words[word] & strip_mask(strip, x0, x1) != 0
        };
        // Most spans lie in one or two strips.
        let (first, last) = (x0 / STRIP, x1 / STRIP);
        is_taken(first) || (first < last && (first + 1..=last).any(is_taken))
    }

    /// Flags every pixel of the image nearer to pixel (cx, cy) than the disc's radius.
    pub(crate) fn stamp(&mut self, disc: &Disc, cx: u32, cy: u32) {
        let reach = disc.reach();
        let (y_min, y_max) = (cy.saturating_sub(reach), (cy + reach).min(self.height - 1));
        let first_row = (y_min + reach - cy) as usize;
        if !disc.patterns.is_empty() {
            let rows = &disc.patterns[first_row..];
            let (strip, bit) = (cx / STRIP, cx % STRIP);
            self.stamp_rows(strip, y_min, y_max, rows, bit as i32 - 32);
            if bit < reach && strip > 0 {
                self.stamp_rows(strip - 1, y_min, y_max, rows, bit as i32 + 32);
            }
            if bit + reach >= STRIP && (strip + 1) * STRIP < self.width {
                self.stamp_rows(strip + 1, y_min, y_max, rows, bit as i32 - 96);
            }
            return;
        }
        let (x_min, x_max) = (cx.saturating_sub(reach), (cx + reach).min(self.width - 1));
        for strip in x_min / STRIP..=x_max / STRIP {
            let column = strip as usize * self.height as usize;
            let words = &mut self.words[column + y_min as usize..=column + y_max as usize];
            let half_widths = &disc.half_widths[first_row..];
            let (first, last) = (strip * STRIP, strip * STRIP + STRIP - 1);
            for (word, &half) in words.iter_mut().zip(half_widths) {
                let x0 = cx.saturating_sub(half).max(first);
                let x1 = (cx + half).min(x_max).min(last);
                if x0 <= x1 {
                    *word |= (!0_u64 << (x0 - first)) & (!0_u64 >> (last - x1));
                }
            }
        }
    }

    /// Flags pixels of one strip: the patterns of the rows, moved by `shift` bits.
    #[inline]
    fn stamp_rows(&mut self, strip: u32, y_min: u32, y_max: u32, rows: &[u64], shift: i32) {
        let column = strip as usize * self.height as usize;
        let words = self.words[column + y_min as usize..=column + y_max as usize].iter_mut().zip(rows);
        if shift >= 0 {
            words.for_each(|(word, row)| *word |= row << shift);
        } else {
            words.for_each(|(word, row)| *word |= row >> -shift);
        }
    }

    /// Appends every clear pixel as (column, row), in the order of the words.
    pub(crate) fn push_clear(&self, out: &mut Vec<[u16; 2]>) {
        for (strip, column) in self.words.chunks_exact(self.height as usize).enumerate() {
            let first = strip as u32 * STRIP;
            let inside = self.inside(strip);
            for (y, word) in column.iter().enumerate() {
                let mut clear = !word & inside;
                while clear != 0 {
                    out.push([(first + clear.trailing_zeros()) as u16, y as u16]);
                    clear &= clear - 1;
                }
            }
        }
    }

    /// Returns the clear pixels as they are now, in the order of the words.
    pub(crate) fn clear_pixels(&self) -> ClearPixels {
        ClearPixels::new(self)
    }

    /// Bytes that [`Bitmap::clear_pixels`] will take if it is called now.
    #[inline(never)]
    pub(crate) fn clear_bytes(&self) -> f64 {
        let clear = self.count_clear();
        if self.lists(clear) { 4.0 * f64::from(clear) } else { FOUND * self.pixels() as f64 }
    }

    /// Whether a list of `clear` pixels is no larger than the bitmap.
    fn lists(&self, clear: u32) -> bool {
        clear as usize <= 2 * self.words.len()
    }

    #[inline(never)]
    fn count_clear(&self) -> u32 {
        let columns = self.words.chunks_exact(self.height as usize).enumerate();
        columns.map(|(strip, column)| clear(column, self.inside(strip))).sum()
    }

    /// Returns the clear pixel that has `rank` clear ones before it. `before` holds the clear pixels before every
    /// [`BLOCK`] words.
    #[cold]
    #[inline(never)]
    fn clear_pixel(&self, before: &[u32], rank: u32) -> [u16; 2] {
        let block = before.partition_point(|&count| count <= rank) - 1;
        let mut left = rank - before[block];
        let mut at = block * BLOCK;
        while left >= self.words[at].count_zeros() {
            left -= self.words[at].count_zeros();
            at += 1;
        }
        let mut clear = !self.words[at];
        for _ in 0..left {
            clear &= clear - 1;
        }
        let height = self.height as usize;
        [((at / height) as u32 * STRIP + clear.trailing_zeros()) as u16, (at % height) as u16]
    }

    /// The bits of a strip that lie within the image.
    fn inside(&self, strip: usize) -> u64 {
        !0_u64 >> (STRIP - STRIP.min(self.width - strip as u32 * STRIP))
    }

    /// Number of flagged pixels.
    #[cfg(test)]
    pub(crate) fn count(&self) -> u64 {
        self.words.iter().map(|word| u64::from(word.count_ones())).sum()
    }
}

/// The clear pixels of a bitmap, as a list from which pixels are taken in the way of `Vec::swap_remove`.
///
/// A list takes 4 bytes per pixel, and in the image of a large disc most pixels may be clear. If a list would be larger
/// than the bitmap, a copy of the bitmap is used instead: entry i is the i-th clear pixel, except for the few entries
/// that have been moved.
#[derive(Debug)]
pub(crate) enum ClearPixels {
    /// A list of the pixels.
    Listed(Vec<[u16; 2]>),
    /// Pixels that are looked up in a bitmap.
    Found {
        /// The bitmap as it was when the pixels were counted, with everything beside the image flagged.
        bitmap: Bitmap,
        /// Number of clear pixels before every [`BLOCK`] words.
        before: Vec<u32>,
        /// Number of entries that are left.
        len: u32,
        /// The entries that replace those that were taken: in each case the one that was the last at that time.
        moved: Moved,
    },
}

/// Number of words that are counted together.
const BLOCK: usize = 32;

/// Bytes per pixel of the image that [`ClearPixels::Found`] takes: the bitmap, the counts, and the moved entries until
/// the list is made again.
const FOUND: f64 = 0.15;

fn clear(words: &[u64], inside: u64) -> u32 {
    words.iter().map(|word| (!word & inside).count_ones()).sum()
}

impl ClearPixels {
    #[cold]
    #[inline(never)]
    fn new(bitmap: &Bitmap) -> Self {
        let height = bitmap.height as usize;
        let len = bitmap.count_clear();
        if bitmap.lists(len) {
            let mut pixels = Vec::with_capacity(len as usize);
            bitmap.push_clear(&mut pixels);
            return ClearPixels::Listed(pixels);
        }
        let mut bitmap = bitmap.clone();
        let last = bitmap.words.len() / height - 1;
        let beside = !bitmap.inside(last);
        bitmap.words[last * height..].iter_mut().for_each(|word| *word |= beside);
        let counts = bitmap.words.chunks(BLOCK).map(|words| clear(words, !0));
        let before = counts.scan(0, |sum, count| {
            *sum += count;
            Some(*sum - count)
        });
        ClearPixels::Found { before: before.collect(), bitmap, len, moved: Moved::default() }
    }

    pub(crate) fn len(&self) -> u32 {
        match self {
            ClearPixels::Listed(pixels) => pixels.len() as u32,
            ClearPixels::Found { len, .. } => *len,
        }
    }

    /// Removes entry `index` and returns its pixel. The last entry takes its place.
    #[inline]
    pub(crate) fn swap_remove(&mut self, index: u32) -> [u16; 2] {
        match self {
            ClearPixels::Listed(pixels) => pixels.swap_remove(index as usize),
            ClearPixels::Found { bitmap, before, len, moved } => {
                *len -= 1;
                let last = moved.get(*len);
                let entry = moved.replace(index, last);
                bitmap.clear_pixel(before, entry)
            }
        }
    }
}

/// The entries that do not hold their own number, in a hash table with open addressing. Nothing is ever removed from
/// it.
#[derive(Debug, Default)]
pub(crate) struct Moved {
    /// Pairs of an entry and what it holds. At least half of the slots are free.
    table: Vec<[u32; 2]>,
    used: usize,
}

const FREE: u32 = u32::MAX;

impl Moved {
    fn slot(&self, entry: u32) -> usize {
        let mask = self.table.len() - 1;
        let mut slot = (entry.wrapping_mul(0x9e37_79b1) >> 8) as usize & mask;
        while self.table[slot][0] != entry && self.table[slot][0] != FREE {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn get(&self, entry: u32) -> u32 {
        if self.table.is_empty() {
            return entry;
        }
        let [found, held] = self.table[self.slot(entry)];
        if found == FREE { entry } else { held }
    }

    /// Stores `new` in an entry and returns what the entry held before.
    fn replace(&mut self, entry: u32, new: u32) -> u32 {
        if 2 * (self.used + 1) > self.table.len() {
            let room = (4 * self.used).max(1024).next_power_of_two();
            let old = core::mem::replace(&mut self.table, vec![[FREE, 0]; room]);
            for pair in old {
                if pair[0] != FREE {
                    let slot = self.slot(pair[0]);
                    self.table[slot] = pair;
                }
            }
        }
        let slot = self.slot(entry);
        let [found, held] = core::mem::replace(&mut self.table[slot], [entry, new]);
        self.used += usize::from(found == FREE);
        if found == FREE { entry } else { held }
    }
}

/// The bits of a strip that stand for the pixels x0 … x1.
#[inline]
fn strip_mask(strip: u32, x0: u32, x1: u32) -> u64 {
    let first = strip * STRIP;
    let lo = x0.saturating_sub(first);
    let hi = (x1 - first).min(STRIP - 1);
    (!0_u64 << lo) & (!0_u64 >> (STRIP - 1 - hi))
}

/// The pixels nearer to a pixel's centre than a radius, which form an open disc (decision A4 in docs/decisions.md).
#[derive(Debug, Clone)]
pub(crate) struct Disc {
    /// The half width of every row, px, from the lowest to the highest.
    half_widths: Vec<u32>,
    /// The rows of a small disc as bits around bit 32. Empty for a larger disc.
    patterns: Vec<u64>,
}

impl Disc {
    /// Makes a disc of this radius, px. Rows and columns farther away than `limit` are never stamped, so a radius
    /// larger than the image costs no memory.
    pub(crate) fn new(radius: f64, limit: u32) -> Self {
        let squared = radius * radius;
        // The farthest row that is nearer than the radius.
        let mut reach = (radius as u32).min(limit);
        while reach > 0 && f64::from(reach) * f64::from(reach) >= squared {
            reach -= 1;
        }
        let mut half = 0_u32;
        let mut upper: Vec<u32> = (0..=reach)
            .rev()
            .map(|dy| {
                let room = squared - f64::from(dy) * f64::from(dy);
                while half < limit && f64::from(half + 1) * f64::from(half + 1) < room {
                    half += 1;
                }
                half
            })
            .collect();
        let lower: Vec<u32> = upper.iter().rev().skip(1).copied().collect();
        upper.extend(lower);
        let row = |&half: &u32| (!0_u64 >> (63 - 2 * half)) << (32 - half);
        let patterns = if reach < 32 && half < 32 { upper.iter().map(row).collect() } else { Vec::new() };
        Disc { half_widths: upper, patterns }
    }

    /// Number of rows above the centre, and below it.
    fn reach(&self) -> u32 {
        self.half_widths.len() as u32 / 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, Stream};

    #[test]
    fn a_disc_flags_exactly_the_pixels_nearer_than_r() {
        for radius in [0.5, 1.0, 1.5, 2.0, 3.0, 7.3, 20.0, 70.0, 200.0] {
            for (cx, cy) in [(0, 0), (64, 3), (63, 50), (129, 99)] {
                let mut bitmap = Bitmap::new(130, 100);
                bitmap.stamp(&Disc::new(radius, 130), cx, cy);
                for y in 0..100_u32 {
                    for x in 0..130_u32 {
                        let d2 = f64::from(x.abs_diff(cx).pow(2) + y.abs_diff(cy).pow(2));
                        let near = d2 < radius * radius || (x, y) == (cx, cy);
                        assert_eq!(bitmap.get(x, y), near, "r {radius} at {cx},{cy}: pixel {x},{y}");
                    }
                }
            }
        }
    }

    #[test]
    fn clear_pixels_are_listed_once_and_only_within_the_image_however_they_are_kept() {
        let mut bitmap = Bitmap::new(70, 3);
        bitmap.fill_span(1, 10, 68);
        let mut clear = Vec::new();
        bitmap.push_clear(&mut clear);
        assert_eq!(clear.len() as u64, 70 * 3 - bitmap.count());
        assert!(clear.iter().all(|&[x, y]| x < 70 && y < 3 && !bitmap.get(x.into(), y.into())));
        for stamped in [0, 40] {
            let mut bitmap = Bitmap::new(200, 90);
            bitmap.stamp(&Disc::new(f64::from(stamped), 200), 60, 40);
            let mut listed = Vec::new();
            bitmap.push_clear(&mut listed);
            let mut found = bitmap.clear_pixels();
            assert!(matches!(found, ClearPixels::Found { .. }));
            let mut stream = Stream::new(1, Purpose::Darts, 0, stamped);
            while !listed.is_empty() {
                assert_eq!(found.len() as usize, listed.len());
                let index = stream.below(found.len());
                assert_eq!(found.swap_remove(index), listed.swap_remove(index as usize));
            }
            assert_eq!(found.len(), 0);
        }
        assert!(bitmap.any_in_span(1, 68, 69) && !bitmap.any_in_span(1, 69, 69) && !bitmap.any_in_span(1, 0, 9));
    }
}
