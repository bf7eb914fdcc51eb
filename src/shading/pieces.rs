//! A picture in pieces: what of it is drawn next, for whoever draws pieces as large as the device can draw in the time there is.
//!
//! Pieces lie in rows from top to bottom, and in each row from left to right. Those of a row are as high as its first, since a piece may be
//! asked for in any size while the picture is under way.

/// A rectangle of the picture, device pixels from its upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// What is left to draw of a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pieces {
    width: u32,
    height: u32,
    /// The next piece begins here.
    x: u32,
    y: u32,
    /// Height of the pieces of the present row; 0 before its first.
    row: u32,
}

impl Pieces {
    /// All of a picture of this size, of at least one pixel.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        Self { width: width.max(1), height: height.max(1), x: 0, y: 0, row: 0 }
    }

    /// Takes the next piece, of about `pixels` and with no side longer than `most`. Nothing is left when there is none.
    pub(crate) fn next(&mut self, pixels: u32, most: u32) -> Option<Piece> {
        let Self { width, height, x, y, .. } = *self;
        if self.is_whole() {
            return None;
        }
        if x == 0 {
            // What is close to a square is crossed by the fewest rocks, but one wider than the picture would be a strip of less than was asked for.
            let side = (pixels as f32).sqrt() as u32;
            self.row = side_of(side.max(pixels / width), height - y, most);
        }
        let piece = Piece { x, y, width: side_of(pixels / self.row, width - x, most), height: self.row };
        self.x += piece.width;
        if self.x == width {
            (self.x, self.y) = (0, y + self.row);
        }
        Some(piece)
    }

    /// Whether every piece was taken.
    pub(crate) fn is_whole(&self) -> bool {
        self.y == self.height
    }
}

/// About `wanted` of the `left` pixels of a side, so that nothing narrow remains.
fn side_of(wanted: u32, left: u32, most: u32) -> u32 {
    let parts = left.div_ceil(most).max(left / wanted.clamp(1, left));
    left.div_ceil(parts.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pieces of sizes that change while the picture is under way.
    fn cut(width: u32, height: u32, most: u32, sizes: &[u32]) -> Vec<Piece> {
        let mut pieces = Pieces::new(width, height);
        let mut sizes = sizes.iter().cycle();
        std::iter::from_fn(|| pieces.next(*sizes.next().expect("it never ends"), most)).collect()
    }

    #[test]
    fn pieces_cover_every_pixel_once() {
        let sizes: [&[u32]; 5] = [&[1], &[100], &[7, 400, 33, 1], &[1 << 30], &[0, 5000, 90]];
        for (width, height) in [(1, 1), (31, 1), (1, 40), (64, 48), (97, 53)] {
            for most in [1, 7, 1024] {
                for sizes in sizes {
                    let mut seen = vec![0_u8; (width * height) as usize];
                    for Piece { x, y, width: across, height: down } in cut(width, height, most, sizes) {
                        assert!(across > 0 && down > 0 && across <= most && down <= most);
                        assert!(x + across <= width && y + down <= height);
                        for row in y..y + down {
                            for column in x..x + across {
                                seen[(row * width + column) as usize] += 1;
                            }
                        }
                    }
                    assert!(seen.iter().all(|&times| times == 1), "{width} × {height}, at most {most}, {sizes:?}");
                }
            }
        }
    }

    #[test]
    fn pieces_are_about_as_large_as_was_asked_for() {
        for pixels in [4_096, 20_000, 60_000, 250_000] {
            for Piece { width, height, .. } in cut(1096, 900, 1024, &[pixels]) {
                let share = f64::from(width * height) / f64::from(pixels);
                assert!((0.4..2.1).contains(&share), "{width} × {height} of {pixels}");
            }
        }
    }

    #[test]
    fn a_picture_that_is_small_enough_is_one_piece() {
        assert_eq!(cut(274, 225, 1024, &[274 * 225]), [Piece { x: 0, y: 0, width: 274, height: 225 }]);
        assert_eq!(cut(800, 20, 1024, &[16_000]).len(), 1, "a strip, too");
    }
}
