//! How few designs serve many parties: shares are held against all partitions.

use hartog::optimise::assignment::{Set, assignments, parties};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A cost that never falls as a set grows: each party has a place in a plane and a weight, a set costs its heaviest party and the square of its diameter; beyond a diameter nothing serves it.
struct Places(Vec<(f64, f64, f64)>, f64);

impl Places {
    fn cost(&self, set: Set) -> f64 {
        let own: Vec<_> = parties(set).map(|i| self.0[i]).collect();
        let wide = own.iter().flat_map(|a| own.iter().map(|b| (a.0 - b.0).hypot(a.1 - b.1))).fold(0.0, f64::max);
        if wide > self.1 { f64::INFINITY } else { own.iter().map(|p| p.2).fold(0.0, f64::max) + wide * wide }
    }

    /// The least cost of all partitions into so many sets, at most.
    fn least(&self, sets: usize) -> f64 {
        let all = (0..self.0.len()).fold(vec![Vec::<Set>::new()], |all, i| {
            let with = |own: &Vec<Set>| {
                let place = |s: usize| {
                    let mut own = own.clone();
                    if s == own.len() {
                        own.push(1 << i)
                    } else {
                        own[s] |= 1 << i
                    }
                    own
                };
                (0..(own.len() + 1).min(sets)).map(place).collect::<Vec<_>>()
            };
            all.iter().flat_map(with).collect()
        });
        all.iter().map(|own| own.iter().map(|set| self.cost(*set)).fold(0.0, f64::max)).fold(f64::INFINITY, f64::min)
    }
}

/// Random parties: every number of designs has the least cost of all partitions, its sets are a partition, and of the 255 sets of eight parties hardly more than half are asked for. Without a set beyond the first partitions, the
/// bound is below the least cost and the partition above.
#[test]
fn every_number_of_designs_has_the_best_partition() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let mut asked = 0;
    for round in 0..40 {
        let count = 2 + round % 7;
        let place = |r: &mut Xoshiro256PlusPlus| (r.random::<f64>(), r.random::<f64>(), 1.0 + 0.2 * r.random::<f64>());
        let places = Places((0..count).map(|_| place(&mut random)).collect(), if round % 3 == 0 { 0.8 } else { 2.0 });
        let mut own = Vec::new();
        let found = assignments(count, 10_000, &mut |set| {
            own.push(set);
            places.cost(set)
        });
        assert_eq!(found.len(), count);
        let mut distinct = own.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(own.len(), distinct.len(), "no set is asked for twice");
        asked = asked.max(own.len());
        let rough = assignments(count, 0, &mut |set| places.cost(set));
        for (i, (exact, rough)) in found.iter().zip(&rough).enumerate() {
            let least = places.least(i + 1);
            assert!(exact.cost == least && exact.at_least == least, "{count}, {}: {exact:?}, {least}", i + 1);
            assert!(rough.at_least <= least && rough.cost >= least, "{rough:?}, {least}");
            for own in [exact, rough] {
                assert!(own.sets.len() <= i + 1 && own.sets.iter().sum::<Set>() == (1 << count) - 1, "{own:?}");
                assert!(own.sets.iter().enumerate().all(|(a, s)| own.sets[..a].iter().all(|t| s & t == 0)));
            }
        }
    }
    assert!(asked <= 140, "{asked}");
}
