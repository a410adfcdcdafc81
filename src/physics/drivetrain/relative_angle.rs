//! A difference of two angles.

use std::ops::{Mul, Sub};

/// scale (angle of `from` - ratio angle of `to`): the twist of a link, or the twist between two stations.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Difference {
    /// Index of a body.
    pub from: usize,
    /// Index of another one, and what its angle is multiplied by; nothing for the ground.
    pub to: Option<(usize, f64)>,
    /// Of the whole.
    pub scale: f64,
}

impl Difference {
    /// Its value, given the angle of each body.
    pub fn of<T: Sub<Output = T> + Mul<f64, Output = T>>(&self, at: impl Fn(usize) -> T) -> T {
        let from = at(self.from);
        let twist = match self.to {
            Some((to, ratio)) => from - at(to) * ratio,
            None => from,
        };
        twist * self.scale
    }
}
