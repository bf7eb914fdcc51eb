//! After the collisions: the new buffers beside those of the preview, and the figures of the run.

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
    /// Individuals.
    pub individuals: u32,
    /// Triangles of the colony.
    pub triangles: u32,
    /// Pairs of individuals that pass through each other in the buffers, counted after the run.
    pub crossing_pairs: u32,
    /// Sweeps over all pairs.
    pub sweeps: u32,
    /// Rounds of the pair that took the most; with `pressed`, pairs that were parted by a plane.
    pub rounds: u32,
    /// Mean rim radius after the collisions over that before: the median of the individuals.
    pub kept_median: f64,
    /// The tenth percentile of the same.
    pub kept_p10: f64,
}

impl Stats {
    /// Of a colony that no rule has touched yet.
    pub(super) fn of(mesh: &ColonyMesh) -> Self {
        let [individuals, triangles] = [mesh.individuals(), mesh.triangles()].map(|n| n as u32);
        Stats { individuals, triangles, kept_median: 1.0, kept_p10: 1.0, ..Stats::default() }
    }
}

/// Steps of the histogram that percentiles are read from.
const BINS: usize = 4096;

/// Writes what has moved, counts what crosses, and puts it all in place at once.
#[derive(Debug)]
pub(super) struct Settle {
    /// Empty where the positions are final already.
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
    /// Sheets that have changed and still have to become bodies.
    pub(super) fn sheets(mesh: &ColonyMesh, sheets: Vec<Sheet>, moved: Vec<bool>) -> Self {
        Settle { sheets, ..Settle::positions(mesh.positions.clone(), moved, Vec::new()) }
    }

    /// Bodies as they are to be.
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

    /// True when [`Settle::finish`] can follow.
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

    /// What it works on, and the share of that which is done.
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

/// Mean distance of a ring from its middle.
fn rim_radius(ring: &[f32]) -> f64 {
    let points = || ring.chunks_exact(3).map(|p| Vec3::from_slice(p).as_dvec3());
    let count = (ring.len() / 3) as f64;
    let middle = points().sum::<DVec3>() / count;
    points().map(|p| p.distance(middle)).sum::<f64>() / count
}
