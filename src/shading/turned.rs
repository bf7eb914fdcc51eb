//! Whether rocks are turned inside out, as a taper that reaches beyond their middle makes them.

use glam::Vec3;

/// Of so many vertices one may be turned: on worn rocks that is a grain here and there.
const ONE_IN: u32 = 5000;

/// Looks at the vertices of all rocks, in their order.
#[derive(Default)]
pub(crate) struct Turned {
    /// How many rocks are whole.
    rocks: usize,
    /// Positions and normals of the rock at hand, as far as they came.
    rock: Vec<[Vec3; 2]>,
    seen: u32,
    turned: u32,
}

impl Turned {
    /// The next vertex. `starts`: rocks + 1 offsets into the vertices.
    pub(crate) fn add(&mut self, starts: &[u32], position: Vec3, normal: Vec3) {
        self.rock.push([position, normal]);
        self.seen += 1;
        while starts.get(self.rocks + 1).is_some_and(|end| *end <= self.seen) {
            self.turned += turned(&self.rock);
            self.rock.clear();
            self.rocks += 1;
        }
    }

    /// Whether so much of the rocks is turned that it would be missed.
    pub(crate) fn found(&self) -> bool {
        self.turned > self.seen / ONE_IN
    }
}

/// How many vertices of a rock face its middle, of those that stand out of the ground.
fn turned(rock: &[[Vec3; 2]]) -> u32 {
    let middle = rock.iter().map(|[position, _]| *position).sum::<Vec3>() / rock.len().max(1) as f32;
    let ground = rock.iter().fold(0.0_f32, |top, [position, _]| top.max(position.z)) * 0.02;
    let faces_middle = |[position, normal]: &&[Vec3; 2]| {
        let away = *position - middle;
        position.z > ground && normal.dot(away) < -0.5 * away.length()
    };
    rock.iter().filter(faces_middle).count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pyramid around (x, 0), whose normals point away from its middle or, with −1, towards it.
    fn pyramid(x: f32, out: f32) -> Vec<[Vec3; 2]> {
        let foot = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        let corners = foot.into_iter().chain([Vec3::Z]);
        corners.map(|at| [at + Vec3::X * x, (at - Vec3::Z / 5.0).normalize() * out]).collect()
    }

    fn found(rocks: &[Vec<[Vec3; 2]>]) -> bool {
        let starts: Vec<u32> = (0..=rocks.len() as u32).map(|rock| 5 * rock).collect();
        let mut turned = Turned::default();
        rocks.iter().flatten().for_each(|[position, normal]| turned.add(&starts, *position, *normal));
        turned.found()
    }

    #[test]
    fn a_rock_that_is_inside_out_is_found_wherever_it_stands() {
        assert!(!found(&[pyramid(0.0, 1.0), pyramid(100.0, 1.0)]));
        assert!(found(&[pyramid(0.0, 1.0), pyramid(100.0, -1.0)]));
        assert!(found(&[pyramid(0.0, -1.0), pyramid(100.0, 1.0)]));
    }

    #[test]
    fn what_is_below_the_ground_does_not_count() {
        let mut rock = pyramid(0.0, -1.0);
        rock.iter_mut().for_each(|[position, _]| position.z -= 1.0);
        assert!(!found(&[rock]));
    }

    #[test]
    fn one_vertex_among_thousands_would_not_be_missed() {
        let rocks = |good| [vec![pyramid(0.0, -1.0)], vec![pyramid(9.0, 1.0); good]].concat();
        assert!(found(&rocks(10)));
        assert!(!found(&rocks(2000)));
    }

    #[test]
    fn rocks_without_vertices_are_not_turned() {
        assert!(!Turned::default().found());
        let mut turned = Turned::default();
        turned.add(&[0, 0, 1], Vec3::Z, Vec3::NEG_Z);
        assert!(!turned.found());
    }
}
