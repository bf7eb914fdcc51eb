//! Turns a sheet into the visible body: two sheets and a rim if it has a thickness, a foot, and the bend by gravity.
//! All of this goes beyond the thesis; with the parameters at 0, a body is its sheet times its size, bit for bit.
//!
//! The vertices of a body come in rings of c: the d rings of the inner sheet; with a thickness, the 2 rings of the
//! rounded rim, from the inner sheet to the outer, and the d rings of the outer sheet; with a foot, the ring of the
//! stalk. Single vertices follow: with a foot, its tip in the log, and with a thickness as well, the middle of the
//! floor inside.

use glam::DVec3;

use super::bowl::{band, fan, sheet};
use super::circle::radians;
use super::deform::Sheet;
use super::spawn::Individual;
use crate::params::wood_ear::Params;
use crate::rng::{Purpose, Stream};

/// Number of rings of the rim between the two sheets; they make three segments of a half circle.
pub(super) const RIM_RINGS: u16 = 2;

/// The structure that all bodies of a colony share.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layout {
    /// Number of rings of a sheet, d.
    pub rings: u16,
    /// Number of vertices of a ring, c.
    pub meridians: u16,
    /// Whether a body has a thickness, and with it two sheets.
    pub thick: bool,
    /// Whether a body has a foot.
    pub foot: bool,
    /// Number of vertices of a body.
    pub vertices: u16,
    /// Triangles of one body: counter-clockwise seen from inside the bowl or, with a thickness, from outside the body.
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

/// A vertex as the sum of a point of the body's spine and an offset from it. Moving inward shortens the offset (Eq.
/// 3.10).
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

// The numbers below are chosen by eye.

/// Thickness of dry flesh, as a share of that of wet flesh.
const DRY: f64 = 0.5;
/// How much thinner the flesh is at the rim than at the foot, as a share.
const THINNER: f64 = 0.55;
/// How deep the stalk reaches into the log, in rim radii, and how wide its end is, relative to ring 1: at foot 0, and
/// what is added up to foot 1.
const STALK_DEPTH: [f64; 2] = [0.12, 0.15];
const STALK_WIDTH: [f64; 2] = [0.4, 0.9];
/// Depth of the middle of the stalk's end, relative to its rim.
const STALK_TIP: f64 = 1.3;

/// Computes the vertices of one body in its own frame, cm, and puts them into `body`. If `lift` is not 0, all but the
/// stalk's are lifted by it and by the thickness of the flesh.
pub(super) fn build(params: &Params, layout: &Layout, sheet: &Sheet, bend: &Bend, lift: f64, body: &mut Vec<Rib>) {
    let c = usize::from(layout.meridians);
    let d = f64::from(layout.rings);
    body.clear();
    // Dry flesh is thinner than wet flesh.
    let wet = if layout.thick { params.thickness * (DRY + (1.0 - DRY) * params.moisture / 100.0) } else { 0.0 };
    let lift = if lift > 0.0 { DVec3::new(0.0, lift + wet, 0.0) } else { DVec3::ZERO };
    let mut add = |p: DVec3, share: f64| body.push(bend.rib(p * sheet.size + lift, share));
    let share = |v: usize| (v / c + 1) as f64 / d;
    for (v, p) in sheet.points.iter().enumerate() {
        add(*p, share(v));
    }
    if layout.thick {
        let outward = outward(layout, &sheet.points);
        // The flesh is thinner at the rim than at the foot.
        let thickness = |v: usize| wet / sheet.size * (1.0 - THINNER * share(v));
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
        // The foot reaches into the log, because the log's surface may fall away below ring 1.
        let depth = STALK_DEPTH[0] + STALK_DEPTH[1] * params.foot;
        let width = STALK_WIDTH[0] + STALK_WIDTH[1] * params.foot;
        let sunk = |p: DVec3| p - lift / sheet.size;
        for p in &sheet.points[..c] {
            add(sunk(DVec3::new(p.x * width, -depth, p.z * width)), 0.0);
        }
        add(sunk(DVec3::new(0.0, -STALK_TIP * depth, 0.0)), 0.0);
        if layout.thick {
            let floor = sheet.points[..c].iter().map(|p| p.y).sum::<f64>() / c as f64;
            add(DVec3::new(0.0, floor, 0.0), 0.0);
        }
    }
}

/// Unit normals of a sheet, on its outer side.
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

/// How gravity bends a body. Wet bodies bend more.
///
/// The axis becomes an arc that leaves the foot along the normal and turns towards the ground. Everything across the
/// axis turns with it, and the rim sags. On the flank of a log the bowl thereby becomes an ear: its lower lip comes
/// close to the bark and its upper lip stands out. On top of the log there is no direction to bend towards, so only the
/// sag is left.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Bend {
    /// `None` if nothing droops: the body is then the sheet, bit for bit.
    arc: Option<Arc>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    /// The direction of the bend, in the body's own frame, perpendicular to the axis.
    down: DVec3,
    /// The angle by which the axis has turned at the height of the rim, and the radius of the arc: that height divided
    /// by the angle.
    angle: f64,
    radius: f64,
    /// By how much the rim slides and sags.
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
        // An angle of 0.75 brings the lower lip of an undeformed bowl to just above the bark.
        let angle = (0.75 * own * wet * steepness).max(1.0e-9);
        let edge = 1.0 - 1.0 / f64::from(params.rings);
        let down = if steepness > 0.0 { aside / steepness } else { DVec3::X };
        let [drift, sag] = [0.3 * wet * size * aside, 0.22 * wet * own * size * gravity];
        Bend { arc: Some(Arc { down, angle, radius: size * edge * edge / angle, drift, sag }) }
    }

    /// Bends a point given in the body's own frame. `share` is how far the point is from the foot (0) to the rim (1).
    pub(super) fn rib(&self, p: DVec3, share: f64) -> Rib {
        let (mut spine, mut offset) = (DVec3::new(0.0, p.y, 0.0), DVec3::new(p.x, 0.0, p.z));
        if let Some(Arc { down, angle, radius, drift, sag }) = self.arc {
            let turned = (p.y / radius).max(0.0).min(angle);
            let [cos, sin] = radians(turned);
            // Beyond the ends of the arc the axis continues straight.
            let beyond = p.y - turned * radius;
            spine = DVec3::new(0.0, sin * radius + beyond * cos, 0.0) + ((1.0 - cos) * radius + beyond * sin) * down;
            offset += offset.dot(down) * ((cos - 1.0) * down - DVec3::new(0.0, sin, 0.0));
            spine += share * share * (drift + share * sag);
        }
        Rib { spine, offset }
    }
}
