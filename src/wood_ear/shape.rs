//! The shape of a grown log, given as functions, so that its coarse and its fine mesh agree.
//!
//! The thesis does not specify the log (decision K12). This one lies along x with its underside a little below the
//! ground. It is bowed in the plane, tapered, slightly oval and uneven, with long furrows in its bark, a few knots, and
//! broken ends.

use glam::DVec3;

use super::circle::turn;
use crate::noise::noise;
use crate::params::wood_ear::Log;
use crate::rng::{Purpose, Stream};

const KNOTS: usize = 4;

/// Share of the radius that lies below the ground.
const SUNK: f64 = 0.1;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct LogShape {
    log: Log,
    /// The log's place in the noise, one for each use of it.
    places: [DVec3; 5],
    /// Per knot: place along the axis (cm), direction (cos, sin), and height relative to the radius.
    knots: [(f64, [f64; 2], f64); KNOTS],
}

/// The kind of surface at a place of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Wood {
    /// Bark.
    Bark = 0,
    /// The end grain of a broken end.
    EndGrain = 1,
    /// A splinter that sticks out of a broken end.
    Splinter = 2,
}

impl LogShape {
    pub(super) fn new(log: Log) -> Self {
        let mut stream = Stream::new(log.seed, Purpose::Bark, 0, 0);
        let mut unit = || stream.unit();
        let places = [(); 5].map(|()| DVec3::new(unit(), unit(), unit()) * 1000.0);
        let knots = [(); KNOTS].map(|()| {
            let along = (0.8 * unit() - 0.4) * log.length;
            // Knots are not placed underneath, where they could not be seen.
            let direction = turn(0.6 * unit() - 0.05);
            (along, direction, 0.12 + 0.14 * unit())
        });
        LogShape { log, places, knots }
    }

    /// The bow of the log: how far the axis lies towards +y at `x` (cm), and its slope there.
    fn bow(&self, x: f64) -> [f64; 2] {
        // A parabola with a slight S-curve. Its mean is 0, and its slope never exceeds ½.
        let t = x / self.log.length;
        let depth = self.log.bend * self.log.length * 0.07;
        [depth * (4.0 * t * t - 1.0 / 3.0 + 4.0 * t * t * t - t), self.log.bend * 0.07 * (8.0 * t + 12.0 * t * t - 1.0)]
    }

    /// A point of the axis, and the direction across the axis within the plane.
    fn frame(&self, along: f64) -> [DVec3; 2] {
        let [y, slope] = self.bow(along);
        let scale = 1.0 / (1.0 + slope * slope).sqrt();
        let centre = DVec3::new(along, y, (1.0 - SUNK) * self.log.radius);
        [centre, DVec3::new(-slope * scale, scale, 0.0)]
    }

    /// Distance of the surface from the axis, cm, at a place along it (cm) in a direction (cos, sin).
    pub(super) fn radius(&self, along: f64, [cos, sin]: [f64; 2]) -> f64 {
        let Log { length, radius, bark, .. } = self.log;
        let taper = 1.0 - 0.1 * along / length;
        let [x, y] = [cos * radius, sin * radius];
        // Broad unevenness of the stem.
        let swell = noise(self.places[0] + DVec3::new(along / (2.5 * radius), x / radius, y / radius));
        let mut height =
            radius * taper * (1.0 + 0.025 * (cos * cos - sin * sin)) * (1.0 + 0.05 * swell * bark.min(0.5) * 2.0);
        if bark > 0.0 {
            // Furrows along the trunk, about 3 cm apart: plates where the noise is away from 0, valleys where it
            // crosses 0.
            let wander = 1.2 * noise(self.places[4] + DVec3::new(along / 9.0, x / 5.0, y / 5.0));
            let n = noise(self.places[1] + DVec3::new(along / 13.0, (x + wander) / 3.1, (y - wander) / 3.1));
            let plate = (n.abs() * 2.8).min(1.0);
            let grain = noise(self.places[2] + DVec3::new(along / 4.0, x / 1.6, y / 1.6));
            height += bark * radius.sqrt() * (0.3 * plate * (2.0 - plate) + 0.06 * grain * plate);
            for &(at, [kc, ks], rise) in &self.knots {
                let across = radius * ((cos - kc) * (cos - kc) + (sin - ks) * (sin - ks)).sqrt();
                let reach = 0.2 * radius + 1.0;
                let distance = ((along - at) * (along - at) + across * across) / (reach * reach);
                if distance < 1.0 {
                    let left = 1.0 - distance;
                    height += bark * rise * radius * left * left * (3.0 - 2.0 * left);
                }
            }
        }
        height
    }

    /// How far an end extends beyond half the length, cm, at a place of its cross-section, which is given within the
    /// unit disc.
    fn jag(&self, positive: bool, [c, s]: [f64; 2]) -> f64 {
        let Log { radius, bark, .. } = self.log;
        if bark == 0.0 {
            return 0.0;
        }
        let side = if positive { 0.0 } else { 57.0 };
        let place = self.places[3] + DVec3::new(side, c * radius, s * radius);
        let broken = noise(DVec3::new(place.x, place.y / (0.9 * radius), place.z / (0.7 * radius)));
        let torn = noise(DVec3::new(place.x + 7.5, place.y / 3.4, place.z / 3.4));
        let splinter = noise(DVec3::new(place.x + 21.5, place.y / 2.1, place.z / 2.1)).max(0.0);
        bark * radius * (0.22 * broken + 0.07 * torn + 0.3 * splinter * splinter)
    }

    /// A point of the bark at `along` = −½ … ½ of the length, and its place along and distance from the axis. The edge
    /// of the bark follows the broken end.
    pub(super) fn bark(&self, along: f64, direction: [f64; 2]) -> (DVec3, [f64; 2]) {
        let length = self.log.length;
        let reach = (0.25 * length).min(1.6 * self.log.radius);
        let near = ((along.abs() * length - 0.5 * length + reach) / reach).max(0.0);
        let shift = if near > 0.0 { near * near * self.jag(along > 0.0, direction) } else { 0.0 };
        let at = along * length + if along > 0.0 { shift } else { -shift };
        self.place(at, direction, 1.0)
    }

    /// A point of a broken end at this share of the radius: the point, its place along and distance from the axis, and
    /// its kind.
    pub(super) fn end(&self, positive: bool, [cos, sin]: [f64; 2], share: f64) -> (DVec3, [f64; 2], Wood) {
        let jag = self.jag(positive, [cos * share, sin * share]);
        let reach = 0.5 * self.log.length + jag;
        let (point, coords) = self.place(if positive { reach } else { -reach }, [cos, sin], share);
        let wood = if jag > 0.14 * self.log.bark * self.log.radius { Wood::Splinter } else { Wood::EndGrain };
        (point, coords, wood)
    }

    /// The point at a place along the axis and a share of the radius, together with its place along and its distance
    /// from the axis, cm.
    fn place(&self, along: f64, direction: [f64; 2], share: f64) -> (DVec3, [f64; 2]) {
        let [centre, across] = self.frame(along);
        let distance = share * self.radius(along, direction);
        (centre + distance * (direction[0] * across + direction[1] * DVec3::Z), [along, distance])
    }

    /// Depth of a point inside the log, cm. It is negative outside, where its absolute value is only a lower bound of
    /// the distance. `radius_at` returns the log's radius at a place along the axis in a direction.
    pub(super) fn depth(&self, point: DVec3, radius_at: impl Fn(f64, [f64; 2]) -> f64) -> f64 {
        let mut along = point.x;
        // Newton's method finds the cross-section that the point lies in.
        for _ in 0..2 {
            let [y, slope] = self.bow(along);
            let curve = self.log.bend * 0.07 * (8.0 + 24.0 * along / self.log.length) / self.log.length;
            let aside = point.y - y;
            let steepness = (1.0 + slope * slope - aside * curve).max(0.3);
            along += (point.x - along + aside * slope) / steepness;
        }
        let Log { length, radius, bark, .. } = self.log;
        let beyond = 0.5 * length + 0.6 * bark * radius - along.abs();
        let [centre, across] = self.frame(along);
        let [u, v] = [(point - centre).dot(across), point.z - centre.z];
        let distance = (u * u + v * v).sqrt();
        // The largest radius that taper, swell, bark and knots can produce.
        let bare = radius * 1.05 * 1.025 * (1.0 + 0.05 * (2.0 * bark).min(1.0)) + 0.36 * bark * radius.sqrt();
        let knotted = self.knots.iter().any(|(at, ..)| (along - at).abs() < 0.2 * radius + 1.0);
        let reach = if knotted { bare + 0.26 * bark * radius } else { bare };
        if beyond < 0.0 || distance > reach + 0.2 {
            return beyond.min(reach - distance);
        }
        if distance < 1.0e-9 {
            return radius.min(0.5 * length - along.abs());
        }
        let direction = [u / distance, v / distance];
        let surface = radius_at(along, direction);
        let share = (distance / surface).min(1.0);
        if along.abs() < 0.5 * length - 0.6 * bark * radius {
            return surface - distance;
        }
        let end = 0.5 * length + self.jag(along > 0.0, [direction[0] * share, direction[1] * share]);
        // Splinters are narrow, so the visible mesh is less exact here.
        (surface - distance).min(end + 0.1 * bark * radius - along.abs())
    }
}
