//! Absorbers that may change places: what begins at two designs that differ by nothing else is one search.

use super::variables::{Space, Variable};
use crate::absorber::Host;
use crate::objective::{Limit, Measure};

/// Groups of absorbers that may change places.
#[derive(Debug)]
#[doc(hidden)]
pub struct Interchange {
    groups: Vec<Vec<usize>>,
}

impl Interchange {
    /// Those of a family whose places make no difference to any of these measures, nor to these limits together.
    pub fn of<'m>(space: &Space, measures: impl Iterator<Item = &'m Measure> + Clone, limits: &[Limit]) -> Self {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for j in 0..space.slots.len() {
            let alike = |i: usize| alike(space, i, j) && measures.clone().all(|m| m.exchanged(i, j).is(m)) && symmetric(limits, i, j);
            match groups.iter_mut().find(|group| alike(group[0])) {
                Some(group) => group.push(j),
                None => groups.push(vec![j]),
            }
        }
        Self { groups }
    }

    /// The point with the absorbers of each group in ascending order: the same for all that differ by places only.
    pub fn ordered(&self, space: &Space, point: &[f64]) -> Vec<f64> {
        let mut ordered = point.to_vec();
        let places = |absorber: usize| (0..point.len()).filter(move |v| space.variables[*v].absorber == absorber);
        for group in &self.groups {
            let mut all: Vec<Vec<f64>> = group.iter().map(|i| places(*i).map(|v| point[v]).collect()).collect();
            all.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
            for (i, own) in group.iter().zip(all) {
                places(*i).zip(own).for_each(|(v, w)| ordered[v] = w);
            }
        }
        ordered
    }
}

/// Whether two absorbers are of one type and material in one place, with the same bounds, and neither carries another.
fn alike(space: &Space, i: usize, j: usize) -> bool {
    let variables_of = |of: usize| space.variables.iter().filter(move |v| v.absorber == of).map(|v| Variable { absorber: 0, ..*v });
    let carries = |i: usize| space.slots.iter().any(|s| s.on == Host::Ring(i));
    space.slots[i] == space.slots[j] && variables_of(i).eq(variables_of(j)) && !carries(i) && !carries(j)
}

/// Whether limits stay the same together where two absorbers change places.
fn symmetric(limits: &[Limit], i: usize, j: usize) -> bool {
    limits.iter().all(|limit| {
        let exchanged = limit.measure.exchanged(i, j);
        limits.iter().any(|other| other.limit == limit.limit && other.measure.is(&exchanged))
    })
}
