//! The inputs of every stage: its result is kept for as long as they stay the same.

use crate::params::wood_ear::{Base, Collisions, Log as LogParams, Params};

/// The inputs of the log, or of the obstacle that individuals keep out of.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LogKey {
    /// The number of the log given by the user, if there is one.
    given: Option<u32>,
    /// The values of parameters, which are only compared. Of a log given by the user, the log depends on the spacing of
    /// its feet alone, and the obstacle on nothing.
    values: [f64; 6],
}

/// The inputs of the individuals' places.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpawnKey {
    seed: u32,
    density: f64,
    range: f64,
    bases: Vec<Base>,
}

/// The inputs of the bodies before their collisions, as numbers that are only compared. None of them is NaN.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodiesKey([f64; 12]);

/// The inputs of all stages of a run, besides the results of earlier stages.
#[derive(Debug)]
pub(super) struct Keys {
    pub(super) log: LogKey,
    /// `None` if individuals need not keep out of the log.
    pub(super) ground: Option<LogKey>,
    pub(super) spawn: SpawnKey,
    pub(super) bodies: BodiesKey,
    pub(super) collisions: Collisions,
}

impl Keys {
    /// `given` is the number of the log given by the user, if there is one.
    pub(super) fn new(params: &Params, given: Option<u32>) -> Self {
        // Without `..`, so that a new parameter does not compile until it is in the key of a stage, or in none on purpose.
        let Params {
            seed,
            density,
            range,
            moisture,
            wrinkles,
            size,
            size_spread,
            rings,
            meridians,
            per_individual,
            collisions,
            droop,
            thickness,
            foot,
            clear_log,
            log,
            look: _,
            ref bases,
        } = *params;
        let LogParams { length, radius, bend, bark, spacing, seed: log_seed } = log;
        let grown = [length, radius, bend, bark, spacing, log_seed.into()];
        let [of_log, of_ground] = match given {
            Some(_) => [[spacing, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]],
            None => [grown; 2],
        };
        let values = [
            seed.into(),
            moisture,
            wrinkles,
            size,
            size_spread,
            rings.into(),
            meridians.into(),
            per_individual,
            droop,
            thickness,
            foot,
            u8::from(clear_log).into(),
        ];
        Keys {
            log: LogKey { given, values: of_log },
            ground: clear_log.then_some(LogKey { given, values: of_ground }),
            spawn: SpawnKey { seed, density, range, bases: bases.clone() },
            bodies: BodiesKey(values),
            collisions,
        }
    }
}
