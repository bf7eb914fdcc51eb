//! From a sheet to the body that is seen: two sheets and a rim where it is thick, a foot, and the bend of gravity. All of it is an
//! addition; at 0 a body is the sheet times its size, bit for bit.
//!
//! A body's vertices are, c of them to a ring: the inner sheet's d rings; with a thickness 2 rings of the rounded rim, from the inner
//! sheet to the outer, and the outer sheet's d rings; with a foot the stalk's ring and then single vertices: its tip in the log and,
//! with a thickness, the middle of the floor inside.

use glam::DVec3;

use super::bowl::{band, fan, sheet};
use super::circle::radians;
use super::deform::Sheet;
use super::spawn::Individual;
use crate::params::wood_ear::Params;
use crate::rng::{Purpose, Stream};

/// Rings of the rim between the two sheets: three segments of a half circle.
pub(super) const RIM_RINGS: u16 = 2;

/// What all bodies of a colony have in common.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layout {
    /// d.
    pub rings: u16,
    /// c.
    pub meridians: u16,
    /// Whether there are two sheets.
    pub thick: bool,
    /// Whether there is a foot.
    pub foot: bool,
    /// Vertices of a body.
    pub vertices: u16,
    /// Of one body; counter-clockwise seen from inside the bowl, or from outside of a thick body.
    pub triangles: Vec<[u16; 3]>,
}

impl Layout {
    /// The layout that these parameters ask for.
    pub fn new(params: &Params) -> Self {
        let [d, c] = [params.rings, params.meridians].map(|n| n as u16);
        let (thick, foot) = (params.thickness > 0.0, params.foot > 0.0);
        let mut triangles = Vec::new();
        sheet(&mut triangles, 0, d, c, false);
        let mut vertices = d * c;
        let mut outermost = 0;
        if thick {
            let rim = vertices;
            let outer = rim + RIM_RINGS * c;
            let outer_rim = outer + (d - 1) * c;
            band(&mut triangles, (d - 1) * c, rim, c, false);
            band(&mut triangles, rim, rim + c, c, false);
            band(&mut triangles, rim + c, outer_rim, c, false);
            sheet(&mut triangles, outer, d, c, true);
            vertices += (RIM_RINGS + d) * c;
            outermost = outer;
        }
        if foot {
            let (stalk, tip) = (vertices, vertices + c);
            // The stalk continues the outermost sheet into the log.
            band(&mut triangles, outermost, stalk, c, !thick);
            fan(&mut triangles, tip, stalk, c, thick);
            vertices += c + 1;
            if thick {
                fan(&mut triangles, vertices, 0, c, false);
                vertices += 1;
            }
        } else if thick {
            band(&mut triangles, 0, outermost, c, true);
        }
        Layout { rings: d, meridians: c, thick, foot, vertices, triangles }
    }
}

/// A vertex as a point of the body's spine and what it stands off from there: moving inward shortens the second (Eq. 3.10).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Rib {
    pub(super) spine: DVec3,
    pub(super) offset: DVec3,
}

impl Rib {
    #[inline]
    pub(super) fn point(self) -> DVec3 {
        self.spine + self.offset
    }
}

/// The vertices of one body in its own frame, cm; all but the stalk are lifted by this much.
pub(super) fn build(params: &Params, layout: &Layout, sheet: &Sheet, bend: &Bend, lift: f64, body: &mut Vec<Rib>) {
    let c = usize::from(layout.meridians);
    let d = f64::from(layout.rings);
    body.clear();
    // Dry flesh is thin.
    let wet = if layout.thick { params.thickness * (0.5 + 0.5 * params.moisture / 100.0) } else { 0.0 };
    let lift = if lift > 0.0 { DVec3::new(0.0, lift + wet, 0.0) } else { DVec3::ZERO };
    let mut add = |p: DVec3, share: f64| body.push(bend.rib(p * sheet.size + lift, share));
    let share = |v: usize| (v / c + 1) as f64 / d;
    for (v, p) in sheet.points.iter().enumerate() {
        add(*p, share(v));
    }
    if layout.thick {
        let outward = outward(layout, &sheet.points);
        // The rim is thinner than the foot.
        let thickness = |v: usize| wet / sheet.size * (1.0 - 0.55 * share(v));
        let rim = sheet.points.len() - c;
        let half = 0.5 * thickness(rim);
        for k in 1..=RIM_RINGS {
            let [cos, sin] = radians(std::f64::consts::PI * f64::from(k) / f64::from(RIM_RINGS + 1));
            for f in 0..c {
                let [normal, across] = [outward[rim + f], sheet.points[rim + f] - sheet.points[rim - c + f]];
                let across = (across - across.dot(normal) * normal).normalize_or(DVec3::Y);
                add(sheet.points[rim + f] + half * ((1.0 - cos) * normal + sin * across), 1.0);
            }
        }
        for (v, (p, normal)) in sheet.points.iter().zip(&outward).enumerate() {
            add(*p + thickness(v) * *normal, share(v));
        }
    }
    if layout.foot {
        // Into the log, where the surface may fall away below ring 1.
        let depth = 0.12 + 0.15 * params.foot;
        let width = 0.4 + 0.9 * params.foot;
        let sunk = |p: DVec3| p - lift / sheet.size;
        for p in &sheet.points[..c] {
            add(sunk(DVec3::new(p.x * width, -depth, p.z * width)), 0.0);
        }
        add(sunk(DVec3::new(0.0, -1.3 * depth, 0.0)), 0.0);
        if layout.thick {
            let floor = sheet.points[..c].iter().map(|p| p.y).sum::<f64>() / c as f64;
            add(DVec3::new(0.0, floor, 0.0), 0.0);
        }
    }
}

/// Unit normals of a sheet on its outer side.
fn outward(layout: &Layout, points: &[DVec3]) -> Vec<DVec3> {
    let [d, c] = [layout.rings, layout.meridians].map(usize::from);
    let at = |e: usize, f: usize| points[e * c + f % c];
    let mut normals = Vec::with_capacity(points.len());
    for e in 0..d {
        for f in 0..c {
            let along = at((e + 1).min(d - 1), f) - at(e.saturating_sub(1), f);
            let around = at(e, f + 1) - at(e, f + c - 1);
            let p = at(e, f);
            normals.push(around.cross(along).normalize_or(DVec3::new(p.x, -1.0, p.z).normalize_or(DVec3::NEG_Y)));
        }
    }
    normals
}

/// How gravity bends a body, the wetter the more.
///
/// The axis becomes an arc that leaves the foot along the normal and turns towards the ground; what stands across it turns with it, and
/// the rim sags. On the log's flank the bowl so becomes an ear: its lower lip comes close to the bark, the upper one stands out. Straight
/// up there is no direction to bend to, and only the sag is left.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Bend {
    /// None where nothing droops: then a body is the sheet, bit for bit.
    arc: Option<Arc>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    /// The direction, in the own frame, square to the axis.
    down: DVec3,
    /// By how much the axis has turned at the height of the rim, and that height over it: the arc's radius.
    angle: f64,
    radius: f64,
    /// How far the rim slides and sags.
    drift: DVec3,
    sag: DVec3,
}

impl Bend {
    pub(super) fn new(params: &Params, individual: &Individual, size: f64) -> Self {
        if params.droop == 0.0 {
            return Bend::default();
        }
        let wet = params.droop * (0.35 + 0.65 * params.moisture / 100.0);
        let gravity = DVec3::from_array(individual.axes.map(|axis| -axis.z));
        let aside = DVec3::new(gravity.x, 0.0, gravity.z);
        let steepness = aside.length();
        let own = 0.75 + 0.25 * Stream::new(params.seed, Purpose::Droop, 0, individual.vertex).unit();
        // An angle of 0.75 brings the lower lip of an undeformed bowl just above the bark.
        let angle = (0.75 * own * wet * steepness).max(1.0e-9);
        let edge = 1.0 - 1.0 / f64::from(params.rings);
        let down = if steepness > 0.0 { aside / steepness } else { DVec3::X };
        let [drift, sag] = [0.3 * wet * size * aside, 0.22 * wet * own * size * gravity];
        Bend { arc: Some(Arc { down, angle, radius: size * edge * edge / angle, drift, sag }) }
    }

    /// Where a point of the own frame comes to lie; `share` is how far it is from the foot to the rim.
    pub(super) fn rib(&self, p: DVec3, share: f64) -> Rib {
        let (mut spine, mut offset) = (DVec3::new(0.0, p.y, 0.0), DVec3::new(p.x, 0.0, p.z));
        if let Some(Arc { down, angle, radius, drift, sag }) = self.arc {
            let turned = (p.y / radius).max(0.0).min(angle);
            let [cos, sin] = radians(turned);
            // Past the arc's ends the axis goes on straight.
            let beyond = p.y - turned * radius;
            spine = DVec3::new(0.0, sin * radius + beyond * cos, 0.0) + ((1.0 - cos) * radius + beyond * sin) * down;
            offset += offset.dot(down) * ((cos - 1.0) * down - DVec3::new(0.0, sin, 0.0));
            spine += share * share * (drift + share * sag);
        }
        Rib { spine, offset }
    }
}
