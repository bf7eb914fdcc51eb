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

/// The vertices of one body in its own frame, cm.
pub(super) fn build(params: &Params, layout: &Layout, individual: &Individual, sheet: &Sheet, body: &mut Vec<Rib>) {
    let c = usize::from(layout.meridians);
    let d = f64::from(layout.rings);
    body.clear();
    let mut add = |p: DVec3| {
        let p = p * sheet.size;
        body.push(Rib { spine: DVec3::new(0.0, p.y, 0.0), offset: DVec3::new(p.x, 0.0, p.z) });
    };
    sheet.points.iter().for_each(|p| add(*p));
    if layout.thick {
        let outward = outward(layout, &sheet.points);
        // Dry flesh is thin, and the rim is thinner than the foot.
        let wet = params.thickness / sheet.size * (0.5 + 0.5 * params.moisture / 100.0);
        let thickness = |e: usize| wet * (1.0 - 0.55 * (e as f64 + 1.0) / d);
        let rim = sheet.points.len() - c;
        let half = 0.5 * thickness(usize::from(layout.rings) - 1);
        for k in 1..=RIM_RINGS {
            let [cos, sin] = radians(std::f64::consts::PI * f64::from(k) / f64::from(RIM_RINGS + 1));
            for f in 0..c {
                let [normal, across] = [outward[rim + f], sheet.points[rim + f] - sheet.points[rim - c + f]];
                let across = (across - across.dot(normal) * normal).normalize_or(DVec3::Y);
                add(sheet.points[rim + f] + half * ((1.0 - cos) * normal + sin * across));
            }
        }
        for (v, (p, normal)) in sheet.points.iter().zip(&outward).enumerate() {
            add(*p + thickness(v / c) * *normal);
        }
    }
    if layout.foot {
        // Into the log, where the surface may fall away below ring 1.
        let depth = 0.12 + 0.15 * params.foot;
        let width = 0.4 + 0.9 * params.foot;
        sheet.points[..c].iter().for_each(|p| add(DVec3::new(p.x * width, -depth, p.z * width)));
        add(DVec3::new(0.0, -1.3 * depth, 0.0));
        if layout.thick {
            let floor = sheet.points[..c].iter().map(|p| p.y).sum::<f64>() / c as f64;
            add(DVec3::new(0.0, floor, 0.0));
        }
    }
    if params.droop > 0.0 {
        bend(params, layout, individual, sheet.size, body);
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

/// Bends a body's axis towards the ground, the wetter the more, and lets the rim sag.
///
/// The axis becomes an arc that leaves the foot along the normal; what stands across it turns with it. On the log's flank the bowl
/// so becomes an ear: its lower lip comes close to the bark, the upper one stands out. Straight up there is no direction to bend
/// to, and only the sag is left.
fn bend(params: &Params, layout: &Layout, individual: &Individual, size: f64, body: &mut [Rib]) {
    let wet = params.droop * (0.35 + 0.65 * params.moisture / 100.0);
    let gravity = DVec3::from_array(individual.axes.map(|axis| -axis.z));
    let aside = DVec3::new(gravity.x, 0.0, gravity.z);
    let steepness = aside.length();
    let own = 0.75 + 0.25 * Stream::new(params.seed, Purpose::Droop, 0, individual.vertex).unit();
    let angle = 0.75 * own * wet * steepness;
    let d = f64::from(layout.rings);
    let top = size * ((d - 1.0) / d) * ((d - 1.0) / d);
    let c = usize::from(layout.meridians);
    let sheet = usize::from(layout.rings) * c;
    let outer = sheet + usize::from(RIM_RINGS) * c;
    for (v, rib) in body.iter_mut().enumerate() {
        // Share of the way from the foot to the rim.
        let u = match v {
            v if v < sheet => (v / c + 1) as f64 / d,
            _ if !layout.thick => 0.0,
            v if v < outer => 1.0,
            v if v < outer + sheet => ((v - outer) / c + 1) as f64 / d,
            _ => 0.0,
        };
        if angle > 1.0e-6 {
            let down = aside / steepness;
            let tau = angle * (rib.spine.y / top).clamp(0.0, 1.0);
            let [cos, sin] = radians(tau);
            let beyond = rib.spine.y - tau * (top / angle);
            let [along, across] = [sin * (top / angle) + beyond * cos, (1.0 - cos) * (top / angle) + beyond * sin];
            rib.spine = DVec3::new(0.0, along, 0.0) + across * down;
            let o = rib.offset.dot(down);
            rib.offset += o * ((cos - 1.0) * down - DVec3::new(0.0, sin, 0.0));
        }
        // The bowl's middle slides down from the foot, and the rim hangs by its own weight.
        rib.spine += (0.3 * wet * size * u * u) * aside + (0.22 * wet * own * size * u * u * u) * gravity;
    }
}
