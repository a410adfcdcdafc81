//! How few designs serve many parties: for every number of designs the partition of the parties whose worst cost is least.
//!
//! The cost of a set of parties is that of the one design which is best for all of them, so that it never falls as a set grows. Sets are joined two by two, the cheapest first, which gives a partition for every number of designs; then partitions are
//! searched, the one with the lowest bound first: a partial partition costs at least as much as the dearest of its sets, and a set at least as much as any part of it that is known. The costs of sets are searches of their own, so
//! that as few of them as possible are asked for.

use crate::numerics::ranked::{ByRank, Ranked};
use std::collections::{BTreeMap, BinaryHeap};

/// Parties, as the bits of a number: party i is 1 << i.
pub type Set = u64;

/// Most parties.
#[doc(hidden)]
pub const MOST_PARTIES: usize = 64;
/// A partition is better by more than this share.
const BETTER: f64 = 1e-9;
/// Partial partitions that are looked at for one number of designs, at most.
const MOST_PARTIAL: usize = 200_000;

/// Parties that are served by one design each.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// Sets, by their first party.
    pub sets: Vec<Set>,
    /// The largest cost of a set.
    pub cost: f64,
    /// No partition into as many sets costs less; the cost itself where the search has ended.
    pub at_least: f64,
}

/// Parties of a set.
pub fn parties(set: Set) -> impl Iterator<Item = usize> {
    (0..MOST_PARTIES).filter(move |i| set >> i & 1 == 1)
}

/// Costs of sets that have been asked for.
struct Costs<'c> {
    ask: &'c mut dyn FnMut(Set) -> f64,
    known: BTreeMap<Set, f64>,
}

impl Costs<'_> {
    fn of(&mut self, set: Set) -> f64 {
        if let Some(cost) = self.known.get(&set) {
            return *cost;
        }
        // a search may err, a part is no dearer than the whole
        let cost = (self.ask)(set).max(self.at_least(set));
        self.known.insert(set, cost);
        cost
    }

    /// By the parts of a set that are known.
    fn at_least(&self, set: Set) -> f64 {
        if let Some(cost) = self.known.get(&set) {
            return *cost;
        }
        self.known.iter().filter(|(part, _)| *part & !set == 0).map(|(_, cost)| *cost).fold(0.0, f64::max)
    }
}

/// A partition of the first parties.
#[derive(Debug, Clone)]
struct Partial {
    sets: Vec<Set>,
    placed: usize,
    bound: f64,
    /// The set whose cost is not asked for yet.
    unasked: Option<Set>,
    age: u64,
}

impl Ranked for Partial {
    /// The lowest bound first; of level ones the one that is closest to the whole.
    fn rank(&self) -> (f64, u64) {
        (-self.bound, self.age)
    }
}

/// For each number of designs from one to that of the parties the best partition that is found, with `most` costs of sets asked for, at most, after those of the first partitions. A cost is positive, infinite where no design
/// serves a set, and not less than that of any part of the set.
pub fn assignments(count: usize, most: usize, ask: &mut dyn FnMut(Set) -> f64) -> Vec<Assignment> {
    let mut costs = Costs { ask, known: BTreeMap::new() };
    let first = joined(count, &mut costs);
    let most = most.saturating_add(costs.known.len());
    first.into_iter().enumerate().map(|(i, known)| searched(count, i + 1, (known, most), &mut costs)).collect()
}

fn worst(sets: &[Set], costs: &mut Costs) -> f64 {
    sets.iter().map(|set| costs.of(*set)).fold(0.0, f64::max)
}

/// Sets joined two by two, the cheapest first: a partition into each number of sets, the whole first.
fn joined(count: usize, costs: &mut Costs) -> Vec<Vec<Set>> {
    let mut sets: Vec<Set> = (0..count).map(|i| 1 << i).collect();
    sets.iter().for_each(|set| _ = costs.of(*set));
    let mut all = vec![sets.clone()];
    while sets.len() > 1 {
        let pairs = (0..sets.len()).flat_map(|i| (i + 1..sets.len()).map(move |j| (i, j)));
        let mut pairs: Vec<(f64, usize, usize)> = pairs.map(|(i, j)| (costs.at_least(sets[i] | sets[j]), i, j)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut best: Option<(f64, usize, usize)> = None;
        for (bound, i, j) in pairs {
            if best.is_some_and(|b| b.0 <= bound) {
                break;
            }
            let cost = costs.of(sets[i] | sets[j]);
            if best.is_none_or(|b| cost < b.0) {
                best = Some((cost, i, j));
            }
        }
        if let Some((_, i, j)) = best {
            sets[i] |= sets.remove(j);
        }
        all.push(sets.clone());
    }
    all.reverse();
    all
}

fn searched(count: usize, most_sets: usize, (first, most): (Vec<Set>, usize), costs: &mut Costs) -> Assignment {
    let mut best = (worst(&first, costs), first);
    let (mut open, mut age) = (BinaryHeap::new(), 0);
    open.push(ByRank(Partial { sets: Vec::new(), placed: 0, bound: 0.0, unasked: None, age }));
    let mut at_least = f64::INFINITY;
    while let Some(ByRank(mut partial)) = open.pop() {
        if partial.bound >= best.0 * (1.0 - BETTER) {
            break;
        }
        if costs.known.len() >= most || age >= MOST_PARTIAL as u64 {
            at_least = partial.bound;
            break;
        }
        if let Some(set) = partial.unasked.take() {
            partial.bound = partial.bound.max(costs.of(set));
            open.push(ByRank(partial));
            continue;
        }
        if partial.placed == count {
            best = (partial.bound, partial.sets);
            continue;
        }
        let own: Set = 1 << partial.placed;
        for i in 0..(partial.sets.len() + 1).min(most_sets) {
            let mut sets = partial.sets.clone();
            if i == sets.len() {
                sets.push(own)
            } else {
                sets[i] |= own
            }
            let (set, bound) = (sets[i], partial.bound.max(costs.at_least(sets[i])));
            age += 1;
            let unasked = Some(set).filter(|set| !costs.known.contains_key(set));
            open.push(ByRank(Partial { sets, placed: partial.placed + 1, bound, unasked, age: u64::MAX - age }));
        }
    }
    Assignment { sets: best.1, cost: best.0, at_least: best.0.min(at_least) }
}
