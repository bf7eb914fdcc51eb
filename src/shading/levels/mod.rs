//! Levels of detail of rocks: which triangles they have, where they lie in the index buffer, and which of them a picture needs.
//!
//! A rock that is subdivided has the triangles of the papers' mesh in blocks, each cut into m² parts. Every second vertex of a
//! block's lattice is one of the block cut into (m/2)² parts: coarser levels share the vertices of the finest, and have no cracks.

mod clusters;

use std::ops::Range;

use clusters::{Cluster, FINE, morton};
use glam::{Mat4, Vec3};

/// Levels that a rock can have. At the coarsest each triangle stands for 256 of the finest.
pub(crate) const LEVELS: usize = 5;

/// Rocks are drawn in groups: those of a layer in a cell of a grid over the field, so many cells on a side.
const CELLS: usize = 5;

/// In a part of a picture, what has more indices of a group is drawn by clusters.
const LEAST_CUT: u32 = 3 * 200;

/// Fields of more rocks are drawn layer by layer: sorting them into cells would take longer than it saves.
const MOST_SORTED: usize = 20_000;

/// One rock of the mesh, whose vertices lie in the box `low`…`high`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    pub(crate) layer: u32,
    pub(crate) low: Vec3,
    pub(crate) high: Vec3,
    pub(crate) vertices: u32,
    pub(crate) triangles: u32,
    /// Whether it sinks so deep into the ground in natural colours that nothing of it is left.
    pub(crate) is_hidden: bool,
}

impl Body {
    /// The number of parts into which each edge of the papers' mesh is cut; 1 for any other mesh, which has one level.
    fn segments(&self) -> u32 {
        // By Euler's formula a surface whose rim has r vertices has 2v − r − 2 triangles; a rock on a cell of n corners has
        // (3n − 2)·m² of them (decision A12), and r = n·m.
        let Some(rim) = (2 * self.vertices).checked_sub(self.triangles + 2) else { return 1 };
        let is_cut = |m: &u32| rim.is_multiple_of(*m) && (3 * rim * m).checked_sub(2 * m * m) == Some(self.triangles);
        [32, 16, 8, 4, 2].into_iter().find(is_cut).unwrap_or(1)
    }

    /// Triangles of a level, 0 being the finest.
    fn triangles_at(&self, level: usize) -> u32 {
        self.triangles / self.step(level).pow(2)
    }

    /// How many segments of the finest level a segment of `level` is long.
    fn step(&self, level: usize) -> u32 {
        self.segments().min(1 << level)
    }
}

/// Appends the triangles of a rock's level to `out`. `triangles` are those of its finest.
pub(crate) fn coarser(body: &Body, level: usize, triangles: &[u32], out: &mut Vec<u32>) {
    let (m, step) = (body.segments() as usize, body.step(level) as usize);
    if step == 1 {
        out.extend_from_slice(triangles);
        return;
    }
    for block in triangles.chunks_exact(3 * m * m) {
        let corner = |row: usize, column: usize| lattice(block, m, row, column);
        for row in (0..m).step_by(step) {
            for column in (0..m - row).step_by(step) {
                let [right, up] = [corner(row, column + step), corner(row + step, column)];
                out.extend([corner(row, column), right, up]);
                if row + column + step < m {
                    out.extend([right, corner(row + step, column + step), up]);
                }
            }
        }
    }
}

/// The vertex of a block in this row and column of its lattice, of m + 1 rows: see `rocks/subdivide.rs`, which writes each row of
/// triangles from left to right, those that point up and those that point down in turns.
fn lattice(block: &[u32], m: usize, row: usize, column: usize) -> u32 {
    let upright = |row: usize, column: usize| 3 * (row * (2 * m - row) + 2 * column);
    let at = if row == m {
        upright(m - 1, 0) + 2
    } else if row + column == m {
        upright(row, column - 1) + 1
    } else {
        upright(row, column)
    };
    block.get(at).copied().unwrap_or(0)
}

/// How large rocks must be to be drawn, from `least` on, so that what is drawn `fits`, or else `most`. It is found to a few hundredths, or many rocks
/// would come and go at once while a camera moves.
pub(crate) fn least_of(least: f32, most: f32, fits: &dyn Fn(f32) -> bool) -> f32 {
    if fits(least) {
        return least;
    }
    // Where nothing is left out at first, `least` is 0.
    let (mut low, mut high) = (least, (1.5 * least).max(1.0));
    while high < most && !fits(high) {
        (low, high) = (high, 1.5 * high);
    }
    for _ in 0..4 {
        let middle = 0.5 * (low + high);
        *(if fits(middle) { &mut high } else { &mut low }) = middle;
    }
    high.min(most)
}

/// Rocks that are drawn together.
#[derive(Debug)]
pub(crate) struct Group {
    low: Vec3,
    high: Vec3,
    /// About how much surface they have together, px².
    surface: f32,
    rocks: f32,
    /// Where the triangles of each level are in the index buffer.
    ranges: [Range<u32>; LEVELS],
    /// Its clusters, in their order.
    clusters: Range<usize>,
    /// Whether nothing is left of its rocks in natural colours.
    is_hidden: bool,
}

impl Group {
    const EMPTY: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        surface: 0.0,
        rocks: 0.0,
        ranges: [const { 0..0 }; LEVELS],
        clusters: 0..0,
        is_hidden: false,
    };

    /// Adds a rock; the ranges begin with 0 until all groups are there.
    fn add(&mut self, body: &Body) {
        self.low = self.low.min(body.low);
        self.high = self.high.max(body.high);
        let size = body.high - body.low;
        // Between a plate of this width and a half ball.
        self.surface += 1.5 * size.x * size.y;
        self.rocks += 1.0;
        for (level, range) in self.ranges.iter_mut().enumerate() {
            range.end += 3 * body.triangles_at(level);
        }
    }

    /// The triangles of the coarsest level that have at most `most` px² on the mean, or else those of the finest.
    fn range(&self, most: f32) -> Range<u32> {
        let is_fine = |range: &&Range<u32>| self.surface <= most * range.len() as f32 / 3.0;
        self.ranges.iter().rev().find(is_fine).unwrap_or(&self.ranges[0]).clone()
    }

    /// Where a level whose triangles of the group are in `level` has those of one of its clusters.
    fn part(&self, level: &Range<u32>, cluster: &Cluster) -> Range<u32> {
        // All rocks of a group are cut alike.
        let step = (self.ranges[0].len() / level.len().max(1)).max(1) as u32;
        level.start + cluster.range.start / step..level.start + cluster.range.end / step
    }
}

/// The rocks of a field in the order in which the index buffer has them, level after level.
#[derive(Debug)]
pub(crate) struct Arrangement {
    /// The numbers of the rocks.
    pub(crate) order: Vec<u32>,
    pub(crate) groups: Vec<Group>,
    clusters: Vec<Cluster>,
    /// Indices in all.
    pub(crate) length: u32,
    low: Vec3,
    high: Vec3,
}

impl Arrangement {
    /// `image` is the size of the field, px.
    pub(crate) fn of(bodies: &[Body], image: [f32; 2]) -> Self {
        let cells = if bodies.len() > MOST_SORTED { 1 } else { CELLS };
        let fine = if cells == 1 { 1 } else { FINE };
        // Which cell, of so many on a side.
        let place = |low: f32, high: f32, size: f32, cells: usize| {
            ((0.5 * (low + high) / size.max(1.0) * cells as f32) as usize).min(cells - 1)
        };
        // What rocks of a group have in common, below that their places in its cell, and in the lower half their numbers. Of a layer's id the
        // lowest 15 bits must do: layers that agree in them may share groups, and are drawn as well.
        let key = |(rock, body): (usize, &Body)| {
            let place = |cells| [0, 1].map(|axis: usize| place(body.low[axis], body.high[axis], image[axis], cells));
            let [column, row] = place(cells);
            let group = u64::from(body.segments().ilog2()) << 5 | (row * cells + column) as u64;
            let within = u64::from(morton(place(cells * fine).map(|cell| (cell % fine) as u8)));
            // Fields of many rocks stay in their order.
            let is_hidden = u64::from(body.is_hidden && cells > 1);
            u64::from(body.layer) << 49 | is_hidden << 48 | group << 40 | within << 32 | rock as u64
        };
        let mut keys: Vec<u64> = bodies.iter().enumerate().map(key).collect();
        keys.sort_unstable();
        let mut groups: Vec<Group> = Vec::new();
        let mut clusters: Vec<Cluster> = Vec::new();
        let mut last = None;
        for key in &keys {
            let Some(body) = bodies.get(*key as u32 as usize) else { continue };
            let is_new = last.map(|last: u64| last >> 40) != Some(key >> 40);
            if is_new {
                let clusters = clusters.len()..clusters.len();
                groups.push(Group { clusters, is_hidden: key >> 48 & 1 == 1, ..Group::EMPTY });
            }
            let is_apart = last.map(|last| last >> 32) != Some(key >> 32);
            last = Some(*key);
            let Some(group) = groups.last_mut() else { continue };
            if is_new || is_apart && clusters.last().is_some_and(Cluster::is_full) {
                clusters.push(Cluster::at(group.ranges[0].end));
                group.clusters.end = clusters.len();
            }
            group.add(body);
            clusters.iter_mut().last().into_iter().for_each(|cluster| cluster.add(body.low, body.high, body.triangles));
        }
        let mut length = 0;
        for level in 0..LEVELS {
            for range in groups.iter_mut().filter_map(|group| group.ranges.get_mut(level)) {
                *range = length..length + range.end;
                length = range.end;
            }
        }
        let low = groups.iter().fold(Vec3::INFINITY, |low, group| low.min(group.low));
        let high = groups.iter().fold(Vec3::NEG_INFINITY, |high, group| high.max(group.high));
        Self { order: keys.into_iter().map(|key| key as u32).collect(), groups, clusters, length, low, high }
    }

    /// How many indices it has for rocks of which no more than their triangles are known.
    pub(crate) fn length_of(bodies: &[Body]) -> u32 {
        let of = |body: &Body| (0..LEVELS).map(|level| 3 * body.triangles_at(level)).sum::<u32>();
        bodies.iter().map(of).sum()
    }

    /// Where the triangles of a level begin.
    pub(crate) fn level_start(&self, level: usize) -> u32 {
        self.groups.first().and_then(|group| group.ranges.get(level)).map_or(0, |range| range.start)
    }

    /// Every rock once, by triangles of at most `most` px² on the mean, as far as there are such; if they have sunk, without those that are hidden.
    pub(crate) fn all(&self, most: f32, has_sunk: bool) -> Vec<Range<u32>> {
        let mut all = Vec::new();
        for group in self.groups.iter().filter(|group| !(has_sunk && group.is_hidden)) {
            join(&mut all, group.range(most));
        }
        all
    }

    /// What `eye` can see, the nearest groups first.
    pub(crate) fn seen(&self, sight: &Sight) -> Vec<Range<u32>> {
        // Distances, and below them the numbers of the groups: of positive floats the bits are in their order.
        let of = |(number, group): (usize, &Group)| {
            let distance = sight.distance(group.low, group.high).filter(|&distance| sight.shows(group, distance))?;
            Some(u64::from(distance.to_bits()) << 32 | number as u64)
        };
        let mut seen: Vec<u64> = self.groups.iter().enumerate().filter_map(of).collect();
        seen.sort_unstable();
        let mut all = Vec::new();
        for key in seen {
            if let Some(group) = self.groups.get(key as u32 as usize) {
                self.show(&mut all, group, sight, f32::from_bits((key >> 32) as u32));
            }
        }
        all
    }

    /// Joins to `all` what a picture shows of a group, by the triangles for this distance.
    fn show(&self, all: &mut Vec<Range<u32>>, group: &Group, sight: &Sight, distance: f32) {
        let level = group.range(sight.most(distance));
        if sight.is_part && level.len() as u32 > LEAST_CUT {
            self.join_some(all, group, &level, &|low, high| sight.distance(low, high).is_some());
        } else {
            join(all, level);
        }
    }

    /// Joins to `all` those clusters of a group whose boxes are wanted, by the triangles of a level.
    fn join_some(
        &self,
        all: &mut Vec<Range<u32>>,
        group: &Group,
        level: &Range<u32>,
        is_wanted: &dyn Fn(Vec3, Vec3) -> bool,
    ) {
        for cluster in self.clusters.get(group.clusters.clone()).unwrap_or_default() {
            if is_wanted(cluster.low, cluster.high) {
                join(all, group.part(level, cluster));
            }
        }
    }
}

impl Arrangement {
    /// As [`Arrangement::seen`] from so far away that all groups are as far: few ranges, in the order of the buffer.
    pub(crate) fn seen_afar(&self, sight: &Sight) -> Vec<Range<u32>> {
        let Some(distance) = self.distance(sight) else { return Vec::new() };
        let mut all = Vec::new();
        for group in self.groups.iter().filter(|group| sight.shows(group, distance)) {
            if !sight.is_part || sight.distance(group.low, group.high).is_some() {
                self.show(&mut all, group, sight, distance);
            }
        }
        all
    }

    /// How many triangles [`Arrangement::seen_afar`] would have, were all of it in the picture.
    pub(crate) fn triangles_afar(&self, sight: &Sight) -> u64 {
        let distance = sight.away(self.low - Vec3::Z * sight.sunk, self.high);
        let most = sight.most(distance);
        let shown = self.groups.iter().filter(|group| sight.shows(group, distance));
        shown.map(|group| group.range(most).len() as u64 / 3).sum()
    }

    /// Whether anything of the whole is in the picture, and how far away it is.
    pub(crate) fn distance(&self, sight: &Sight) -> Option<f32> {
        sight.distance(self.low, self.high)
    }

    /// The groups that, moved by `shift`, are over the field or throw their shadows into it, by triangles as for [`Arrangement::all`]. `sun` is the
    /// direction of the sun.
    pub(crate) fn reaching(&self, shift: Vec3, sun: Vec3, image: [f32; 2], most: f32) -> Vec<Range<u32>> {
        let reaches = |low: Vec3, high: Vec3| {
            let shadow = -sun.truncate() / sun.z * high.z;
            let [low, high] = [low + shift, high + shift].map(Vec3::truncate);
            let (low, high) = (low.min(low + shadow), high.max(high + shadow));
            low.cmple(image.into()).all() && high.cmpge(glam::Vec2::ZERO).all()
        };
        let mut all = Vec::new();
        for group in self.groups.iter().filter(|group| !group.is_hidden && reaches(group.low, group.high)) {
            self.join_some(&mut all, group, &group.range(most), &reaches);
        }
        all
    }
}

/// Adds what is drawn, to the last of `all` where there is no gap.
fn join(all: &mut Vec<Range<u32>>, range: Range<u32>) {
    match all.last_mut() {
        Some(last) if last.end == range.start => last.end = range.end,
        _ if range.is_empty() => {}
        _ => all.push(range),
    }
}

/// A picture that rocks are drawn in.
#[derive(Clone, Copy)]
pub(crate) struct Sight {
    pub(crate) clip_from_eye: Mat4,
    pub(crate) eye: Vec3,
    /// How far rocks may have sunk, px.
    pub(crate) sunk: f32,
    /// Pixels of the picture per px of the world, at a distance of 1 px.
    pub(crate) scale: f32,
    /// How large triangles may be, square pixels of the picture; 0 for the finest level.
    pub(crate) most: f32,
    /// How large rocks must be on the mean to be drawn, square pixels of the picture.
    pub(crate) least: f32,
    /// Whether it is a part of a picture: then what is drawn is chosen more closely, since all parts together would repeat much. It looks the same.
    pub(crate) is_part: bool,
}

impl Sight {
    /// How far what is in a box is away; nothing if it is out of the picture.
    fn distance(&self, low: Vec3, high: Vec3) -> Option<f32> {
        let [low, high] = [low - Vec3::Z * self.sunk - self.eye, high - self.eye];
        // How many corners of its box are beyond each side of the picture.
        let mut beyond = [0; 5];
        for corner in 0..8 {
            let pick = |bit: usize, low: f32, high: f32| if corner >> bit & 1 == 0 { low } else { high };
            let at = Vec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z));
            let clip = self.clip_from_eye * at.extend(1.0);
            let sides = [clip.x > clip.w, clip.x < -clip.w, clip.y > clip.w, clip.y < -clip.w, clip.w < 0.0];
            for (count, is_beyond) in beyond.iter_mut().zip(sides) {
                *count += u32::from(is_beyond);
            }
        }
        (!beyond.contains(&8)).then(|| Vec3::ZERO.clamp(low, high).length())
    }

    /// How far what is in a box is away, wherever it is.
    fn away(&self, low: Vec3, high: Vec3) -> f32 {
        Vec3::ZERO.clamp(low - self.eye, high - self.eye).length()
    }

    /// Square pixels that a px² of a surface covers at a distance.
    fn pixels(&self, distance: f32) -> f32 {
        // About half of it is lost by its slant.
        0.5 * (self.scale / distance.max(1e-3)).powi(2)
    }

    /// How large triangles may be at a distance, px².
    fn most(&self, distance: f32) -> f32 {
        self.most / self.pixels(distance)
    }

    /// Whether the rocks of a group are large enough at a distance.
    fn shows(&self, group: &Group, distance: f32) -> bool {
        !(self.sunk > 0.0 && group.is_hidden) && group.surface * self.pixels(distance) >= self.least * group.rocks
    }
}

#[cfg(test)]
mod tests;
