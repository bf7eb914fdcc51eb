//! What a run of the rocks' generator takes, by an allocator that counts.

use peak_alloc::PeakAlloc;
use rock_field::Error;
use rock_field::params::Params;
use rock_field::rocks::Generator;

/// A wasm instance before its first run: a stack of 1 MiB and static data. It is part of what a tab needs.
pub const INSTANCE: usize = 1_150_000;

/// An estimate and a peak that are both below this are tiny: there the estimate may be more than twice the peak.
pub const TINY: usize = 4 << 20;

/// The seeds of the ten thousand cases of an ignored test: `SEED=20000 cargo test …` looks at others than the usual ones.
pub fn ten_thousand_seeds(usual: u64) -> std::ops::Range<u64> {
    let first = std::env::var("SEED").map_or(usual, |seed| seed.parse().expect("SEED must be an integer"));
    first..first + 10_000
}

/// Measures a generator that it sees from the beginning on. Nothing may run beside it.
pub struct Meter<'a> {
    allocated: &'a PeakAlloc,
    before: usize,
}

impl<'a> Meter<'a> {
    pub fn new(allocated: &'a PeakAlloc) -> Self {
        Meter { allocated, before: allocated.current_usage() }
    }

    /// Bytes at the peak of a run with its output copied out, and its estimate; up to its end where it is refused.
    ///
    /// Usize is twice as wide here as in wasm, but all that grows with the field is of fixed width.
    pub fn measure(&self, generator: &mut Generator, params: &Params, budget: u64) -> (usize, Result<u64, Error>) {
        self.allocated.reset_peak_usage();
        let outcome = run(generator, params, budget);
        let peak = || INSTANCE + self.allocated.peak_usage() - self.before;
        if outcome.is_err() {
            return (peak(), outcome);
        }
        // The copies of the buffers lie in JavaScript's memory; the conversions they are made from, one at a time, in wasm.
        let mesh = generator.mesh();
        let words = mesh.positions.len() + mesh.normals.len() + mesh.indices.len() + 2 * mesh.rock_starts.len();
        let mut copied = 4 * words + mesh.rock_layer.len();
        for layer in generator.layers() {
            copied += 4 * (layer.cells.starts.len() + layer.selection.selected.len());
            copied += 4 * (layer.sites.positions().len() + layer.cells.flat_vertices().len());
        }
        (peak() + copied, outcome)
    }
}

fn run(generator: &mut Generator, params: &Params, budget: u64) -> Result<u64, Error> {
    generator.start(params.clone(), budget)?;
    while !generator.step()? {}
    Ok(generator.estimate())
}
