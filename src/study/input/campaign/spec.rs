//! A campaign as checked.

use crate::input::overrides::Override;
use std::path::PathBuf;

/// What is computed of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Each {
    /// The objectives and limits of given designs.
    Evaluate,
    /// The optima.
    Optimise,
    /// The front.
    Front,
    /// Designs, and optima where there are some, within tolerances.
    Robust,
    /// The dampers that several engines share.
    Platform,
}

impl Each {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Evaluate => "evaluate",
            Self::Optimise => "optimise",
            Self::Front => "front",
            Self::Robust => "robust",
            Self::Platform => "platform",
        }
    }
}

/// One value of what varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// In tables: of numbers the number.
    pub label: String,
    /// The study, where it names one.
    pub study: Option<PathBuf>,
    /// Keys with their values.
    pub set: Vec<Override>,
}

/// What varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its column.
    pub name: String,
    /// Whether its labels are numbers.
    pub numeric: bool,
    /// Its values.
    pub variants: Vec<Variant>,
}

/// How a key is distributed.
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Between two values.
    Uniform(f64, f64),
    /// Gauss's, by mean and standard deviation.
    Normal(f64, f64),
    /// Values with their shares.
    Table(Vec<(f64, f64)>),
}

/// A key that points are drawn of.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// The key.
    pub key: String,
    /// Its column.
    pub name: String,
    /// How it is distributed; `None` of a table of points.
    pub distribution: Option<Distribution>,
}

/// How points are drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// Sobol's sequence.
    Sobol,
    /// A Latin hypercube.
    LatinHypercube,
    /// A full grid.
    Full,
    /// These points.
    Rows(Vec<Vec<f64>>),
}

/// Points that are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// How.
    pub drawing: Drawing,
    /// How many; of a full grid, of each key.
    pub points: usize,
    /// Of what is random.
    pub seed: u64,
    /// Whether in Saltelli's scheme.
    pub indices: bool,
    /// The keys.
    pub keys: Vec<Sampled>,
}

/// Engines that share dampers.
#[derive(Debug, Clone, PartialEq)]
pub struct Platform {
    /// The engines.
    pub engines: Axis,
    /// What the damper of an engine is good for all together.
    pub loads: Vec<Axis>,
    /// Objective of each engine that counts as one, as its column shows it; `None`: its own optimum.
    pub targets: Option<Vec<f64>>,
    /// Sets of engines whose common damper is sought, at most, besides those that a first assignment takes.
    pub sets: usize,
}

impl Platform {
    /// What it covers.
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        std::iter::once(&self.engines).chain(&self.loads)
    }

    /// How many studies it is of.
    pub fn studies(&self) -> usize {
        self.axes().map(|a| a.variants.len()).product()
    }
}

/// A campaign as checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaign {
    /// Name of its file without ending.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
    /// The study, where no variant names another.
    pub study: Option<PathBuf>,
    /// What is computed.
    pub each: Each,
    /// What varies; the first one makes the folders of its tables.
    pub axes: Vec<Axis>,
    /// What is drawn.
    pub sample: Option<Sample>,
    /// What shares dampers.
    pub platform: Option<Platform>,
    /// Relative error that objectives of given designs may have; `None`: rounding.
    pub tolerance: Option<f64>,
    /// Where it is given.
    pub cases_per_shard: Option<usize>,
}

/// Largest number of cases.
pub(super) const MOST_CASES: usize = 100_000_000;

impl Sample {
    /// How many points there are; `None` where they cannot be counted.
    pub fn count(&self) -> Option<usize> {
        let keys = self.keys.len();
        match (&self.drawing, self.indices) {
            (Drawing::Rows(rows), _) => Some(rows.len()),
            (Drawing::Full, _) => self.points.checked_pow(u32::try_from(keys).ok()?),
            (_, true) => self.points.checked_mul(keys + 2),
            (_, false) => Some(self.points),
        }
    }
}

impl Campaign {
    /// How many cases there are; `None` where there are too many.
    pub fn cases(&self) -> Option<usize> {
        let of_sample = self.sample.as_ref().map_or(Some(1), Sample::count)?;
        let all = self.axes.iter().try_fold(of_sample, |n, axis| n.checked_mul(axis.variants.len()))?;
        Some(all).filter(|n| *n <= MOST_CASES)
    }

    /// All that varies: what cases differ in, and what the platform of a case covers.
    #[doc(hidden)]
    pub fn all_axes(&self) -> impl Iterator<Item = &Axis> {
        self.axes.iter().chain(self.platform.iter().flat_map(Platform::axes))
    }
}
