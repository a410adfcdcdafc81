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
const MOST_PARTIAL: usize = 50_000;

/// Parties that are served by one design each.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// Sets, by their first party.
    pub sets: Vec<Set>,
    /// The largest cost of a set.
    pub cost: f64,
}

/// Parties of a set.
pub fn parties(set: Set) -> impl Iterator<Item = usize> {
    (0..MOST_PARTIES).filter(move |i| set >> i & 1 == 1)
}

/// What a set costs at least, by those of its parts that are known.
fn at_least(known: &BTreeMap<Set, f64>, set: Set) -> f64 {
    known.iter().filter(|(part, _)| *part & !set == 0).map(|(_, cost)| *cost).fold(0.0, f64::max)
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
        let cost = (self.ask)(set).max(at_least(&self.known, set));
        self.known.insert(set, cost);
        cost
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
    /// The lowest bound first; of level ones the latest, which is closest to the whole.
    fn rank(&self) -> (f64, u64) {
        (-self.bound, u64::MAX - self.age)
    }
}

/// Partial partitions that may still be the best.
struct Open {
    heap: BinaryHeap<ByRank<Partial>>,
    pushed: usize,
}

impl Open {
    fn new() -> Self {
        let none = Partial { sets: Vec::new(), placed: 0, bound: 0.0, unasked: None, age: 0 };
        Self { heap: BinaryHeap::from([ByRank(none)]), pushed: 0 }
    }

    fn lowest(&mut self) -> Option<Partial> {
        self.heap.pop().map(|partial| partial.0)
    }

    fn put(&mut self, partial: Partial) {
        self.heap.push(ByRank(partial));
    }

    /// The next party in each of the sets of a partition, and in one of its own. `of`: what a set costs at least, and whether its cost is to be asked for.
    fn place(&mut self, partial: &Partial, most_sets: usize, mut of: impl FnMut(Set) -> (f64, bool)) {
        let own: Set = 1 << partial.placed;
        for i in 0..(partial.sets.len() + 1).min(most_sets) {
            let mut sets = partial.sets.clone();
            if i == sets.len() {
                sets.push(own)
            } else {
                sets[i] |= own
            }
            let (set, (bound, is_unasked)) = (sets[i], of(sets[i]));
            self.pushed += 1;
            let (bound, age) = (partial.bound.max(bound), self.pushed as u64);
            self.put(Partial { sets, placed: partial.placed + 1, bound, unasked: is_unasked.then_some(set), age });
        }
    }
}

/// For each number of designs from one to that of the parties (up to [`MOST_PARTIES`]) the best partition that is found, with `most` costs of sets asked for, at most, after those of the first partitions. A cost is positive, infinite where no design
/// serves a set, and not less than that of any part of the set.
pub fn assignments(count: usize, most: usize, ask: &mut dyn FnMut(Set) -> f64) -> Vec<Assignment> {
    if count == 0 {
        return Vec::new();
    }
    let mut costs = Costs { ask, known: BTreeMap::new() };
    let first = joined(count, &mut costs);
    let asked = costs.known.len();
    let most = |i: usize| asked.saturating_add(most.saturating_mul(i + 1) / count.max(1));
    first.into_iter().enumerate().map(|(i, known)| searched(count, i + 1, (known, most(i)), &mut costs)).collect()
}

/// No partition of the parties into so many sets, at most, costs less, by what some sets are known to cost at least.
pub fn least(count: usize, most_sets: usize, known: &BTreeMap<Set, f64>) -> f64 {
    let mut bounds: BTreeMap<Set, f64> = BTreeMap::new();
    let mut bound = |set: Set| *bounds.entry(set).or_insert_with(|| at_least(known, set));
    let mut open = Open::new();
    while let Some(partial) = open.lowest() {
        if partial.placed == count || open.pushed >= MOST_PARTIAL {
            return partial.bound;
        }
        open.place(&partial, most_sets, |set| (bound(set), false));
    }
    f64::INFINITY
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
        let mut pairs: Vec<(f64, usize, usize)> = pairs.map(|(i, j)| (at_least(&costs.known, sets[i] | sets[j]), i, j)).collect();
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
    let mut open = Open::new();
    // there is one partition into one set, and one into as many as there are parties
    while let Some(mut partial) = open.lowest().filter(|_| most_sets > 1 && most_sets < count) {
        let is_no_better = partial.bound >= best.0 * (1.0 - BETTER);
        if is_no_better || open.pushed >= MOST_PARTIAL || partial.unasked.is_some() && costs.known.len() >= most {
            break;
        }
        if let Some(set) = partial.unasked.take() {
            partial.bound = partial.bound.max(costs.of(set));
            open.put(partial);
        } else if partial.placed == count {
            best = (partial.bound, partial.sets);
        } else {
            let known = &costs.known;
            open.place(&partial, most_sets, |set| known.get(&set).map_or_else(|| (at_least(known, set), true), |cost| (*cost, false)));
        }
    }
    Assignment { sets: best.1, cost: best.0 }
}
