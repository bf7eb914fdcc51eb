//! The last step of a run: prepares the new buffers beside those of the preview, and computes the run's figures.

use glam::{DVec3, Vec3};

use super::crossing::Count;
use super::deform::Sheet;
use super::mesh::{ColonyMesh, shade, write};
use super::pose::{Plane, Poser};
use super::press::Bodies;
use super::work::Part;

/// Figures of a finished run.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stats {
    /// Number of individuals.
    pub individuals: u32,
    /// Number of triangles of the colony.
    pub triangles: u32,
    /// Number of pairs of individuals that pass through each other in the buffers, counted after the run.
    pub crossing_pairs: u32,
    /// Number of sweeps over all pairs.
    pub sweeps: u32,
    /// Number of rounds that the slowest pair took; with `pressed`, the number of pairs separated by a plane.
    pub rounds: u32,
    /// Mean rim radius after the collisions relative to before: the median over the individuals.
    pub kept_median: f64,
    /// The tenth percentile of the same ratio.
    pub kept_p10: f64,
}

impl Stats {
    /// The figures of a colony before its collisions are solved.
    pub(super) fn of(mesh: &ColonyMesh) -> Self {
        let [individuals, triangles] = [mesh.individuals(), mesh.triangles()].map(|n| n as u32);
        Stats { individuals, triangles, kept_median: 1.0, kept_p10: 1.0, ..Stats::default() }
    }
}

/// Number of bins of the histogram that percentiles are read from.
const BINS: usize = 4096;

/// Writes the bodies that have moved, counts the pairs that cross, and replaces the buffers of the preview all at once.
#[derive(Debug)]
pub(super) struct Settle {
    /// The changed sheets. Empty if the positions are final already.
    sheets: Vec<Sheet>,
    moved: Vec<bool>,
    positions: Vec<f32>,
    normals: Vec<f32>,
    next: usize,
    kept: Vec<u32>,
    count: Count,
    poser: Poser,
    sums: Vec<DVec3>,
}

impl Settle {
    /// Starts with changed sheets that still have to become bodies. `moved` says which of them have changed.
    pub(super) fn sheets(mesh: &ColonyMesh, sheets: Vec<Sheet>, moved: Vec<bool>) -> Self {
        Settle { sheets, ..Settle::positions(mesh.positions.clone(), moved, Vec::new()) }
    }

    /// Starts with the final positions of all bodies. `moved` says which of them have changed.
    pub(super) fn positions(positions: Vec<f32>, moved: Vec<bool>, planes: Vec<Vec<Plane>>) -> Self {
        Settle {
            sheets: Vec::new(),
            moved,
            normals: Vec::new(),
            positions,
            next: 0,
            kept: vec![0; BINS + 1],
            count: Count::with(planes),
            poser: Poser::default(),
            sums: Vec::new(),
        }
    }

    /// Works on up to `bodies` bodies or `pairs` pairs. Returns true when [`Settle::finish`] may be called.
    pub(super) fn advance(&mut self, of: Bodies, before: &ColonyMesh, bodies: usize, pairs: usize) -> bool {
        let step = 3 * usize::from(of.layout.vertices);
        if self.normals.is_empty() {
            self.normals = before.normals.clone();
        }
        if self.next == self.moved.len() {
            return self.count.advance(of.layout, &self.positions, bodies, pairs);
        }
        let to = (self.next + bodies).min(self.moved.len());
        let c = usize::from(of.layout.meridians);
        let rim = 3 * (usize::from(of.layout.rings) - 1) * c;
        for k in self.next..to {
            let range = k * step..(k + 1) * step;
            let mut kept = 1.0;
            if self.moved[k] {
                if let Some(sheet) = self.sheets.get(k) {
                    self.poser.pose(of.params, of.layout, &of.individuals[k], sheet, &[], (of.ground, true));
                    write(&mut self.positions[range.clone()], self.poser.points.iter().copied());
                }
                let positions = &self.positions[range.clone()];
                shade(of.layout, positions, &mut self.normals[range.clone()], &mut self.sums);
                let radius = |positions: &[f32]| rim_radius(&positions[rim..rim + 3 * c]);
                kept = radius(positions) / radius(&before.positions[range]).max(f64::MIN_POSITIVE);
            }
            self.kept[(kept * BINS as f64).clamp(0.0, BINS as f64) as usize] += 1;
        }
        self.next = to;
        false
    }

    /// The part of the run being worked on, and the share of it that is done.
    pub(super) fn progress(&self) -> (Part, f64) {
        if self.next < self.moved.len() {
            return (Part::Bodies, self.next as f64 / self.moved.len() as f64);
        }
        (Part::Count, self.count.progress())
    }

    pub(super) fn finish(self, mesh: &mut ColonyMesh, stats: &mut Stats) {
        stats.crossing_pairs = self.count.crossing.len() as u32;
        let percentile = |share: f64| {
            let mut left = (self.moved.len() as f64 * share) as u32;
            let bin = self.kept.iter().position(|n| {
                let found = left < *n;
                left = left.saturating_sub(*n);
                found
            });
            bin.map_or(1.0, |bin| bin as f64 / BINS as f64)
        };
        [stats.kept_median, stats.kept_p10] = [percentile(0.5), percentile(0.1)];
        mesh.positions = self.positions;
        if !self.normals.is_empty() {
            mesh.normals = self.normals;
        }
    }
}

/// Mean distance of a ring's vertices from their middle.
fn rim_radius(ring: &[f32]) -> f64 {
    let points = || ring.chunks_exact(3).map(|p| Vec3::from_slice(p).as_dvec3());
    let count = (ring.len() / 3) as f64;
    let middle = points().sum::<DVec3>() / count;
    points().map(|p| p.distance(middle)).sum::<f64>() / count
}
