//! What one per cent more of a limit or a bound brings, where several hold an optimum at once.

use crate::limits::{TwoMasses, What, with};
use crate::support::assert_close;
use hartog::analysis::{self, OptimumResult, Silent};
use hartog::input::Size;

/// Law: where a bound and limits hold an optimum at once, one per cent more of one of them alone brings what a search finds: nothing. With the largest ring at a limit on its inertia the multiplier was shared out between
/// both, and each part told as the price of one; so it was between a limit that is written twice.
#[test]
fn prices_of_what_holds_together() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let found = |largest: f64, limits: &[f64]| {
        let limits: Vec<_> = limits.iter().map(|l| (What::RingInertia, *l)).collect();
        let mut s = with(masses, What::Twist, &limits);
        s.optimise.as_mut().expect("optimises").absorbers[0].size = Size::Between(0.02, largest);
        analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}")).optima.remove(0)
    };
    let of_bound = |o: &OptimumResult| o.on_bounds.iter().find(|b| b.parameter == 0).and_then(|b| b.price);
    let both = found(0.1, &[0.1]);
    let value = both.optimum.value();
    for looser in [found(0.101, &[0.1]), found(0.1, &[0.101])] {
        assert_close(looser.optimum.value(), value, 1e-9, 0.0, "one of them holds it");
    }
    assert!(both.prices[0] < 1e-6 && of_bound(&both).is_some_and(|p| p < 1e-6), "{:?} {:?}", both.prices, both.on_bounds);
    // each by itself costs what a search finds
    let cost = 1e5 * (1.0 - found(0.1 * 1.00001, &[]).optimum.value() / value);
    assert!(cost > 0.1, "{cost}");
    assert_close(found(0.2, &[0.1]).prices[0], cost, 1e-3, 0.0, "the limit");
    assert_close(of_bound(&found(0.1, &[])).expect("on it"), cost, 1e-3, 0.0, "the bound");
    let twice = found(0.2, &[0.1, 0.1]);
    assert!(twice.prices.iter().all(|p| *p < 1e-6), "{:?}", twice.prices);
}
