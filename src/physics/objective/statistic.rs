//! Numbers that are made of the magnitudes of a quantity's orders at a speed, without their phases: what `over` may name in a study.

use crate::numerics::C64;
use serde::de::{Deserialize, Deserializer, Error};
use serde::{Serialize, Serializer};

/// What is made of the orders at a speed: |y_n|, half peak-to-peak of each.
#[derive(Debug)]
pub struct Row {
    /// As a study names it, and in columns.
    pub name: &'static str,
    /// In words, before what it is of.
    pub label: &'static str,
    /// The number. It grows with every magnitude, and by no more than that.
    pub value: fn(&[C64]) -> f64,
    /// Its derivative by the magnitude of an order, divided by that magnitude.
    pub slope: fn(&[C64], usize) -> f64,
}

/// A row of [`STATISTICS`].
#[derive(Debug, Clone, Copy)]
pub struct Statistic(pub &'static Row);

/// All of them.
pub const STATISTICS: [Statistic; 1] = [Statistic(&RMS)];

/// Root mean square over the cycle, sqrt(sum |y_n|²/2) (Parseval): what a meter of vibration shows.
static RMS: Row = Row {
    name: "rms",
    label: "root mean square of",
    value: root_mean_square,
    slope: |y, _| {
        let value = root_mean_square(y);
        if value > 0.0 { 0.5 / value } else { 0.0 }
    },
};

fn root_mean_square(y: &[C64]) -> f64 {
    (0.5 * y.iter().map(|y| y.norm_sqr()).sum::<f64>()).sqrt()
}

impl PartialEq for Statistic {
    fn eq(&self, other: &Self) -> bool {
        self.0.name == other.0.name
    }
}

impl Serialize for Statistic {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name)
    }
}

impl<'de> Deserialize<'de> for Statistic {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        STATISTICS.into_iter().find(|s| s.0.name == name).ok_or_else(|| D::Error::custom("unknown statistic"))
    }
}
