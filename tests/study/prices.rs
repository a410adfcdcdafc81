//! What limits, bounds and conditions cost: one per cent more of one where several hold an optimum at once, and each left out in turn.

use crate::limits::{TwoMasses, What, with};
use crate::support::{assert_close, variant};
use hartog::Study;
use hartog::analysis::{self, Change, OptimumResult, Silent};
use hartog::input::Size;
use hartog::objective::Condition;

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

/// One order over the speeds of its resonance.
const FEW: [(&str, &str); 2] =
    [("from = 600, to = 3200, step = 20", "from = 2000, to = 5000, step = 250"), ("order_limit = 12", "order_limit = 3")];

/// Independent: what a condition, a limit, a bound and half the ring cost is what two files say, with it and without it. Costs of what is asked are never negative.
#[test]
fn what_is_asked_costs_what_it_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let fewer = [
        ("step = 20", "step = 50"),
        ("order_limit = 12", "order_limit = 6"),
        ("random_starts = 1", "random_starts = 0"),
        ("max_w = 300", "max_w = 290"),
    ];
    let found = |change: (&str, &str), prices: bool| {
        let path = variant(folder.path(), "villalva_i6_prices", &[&fewer[..], &[change]].concat());
        let mut study = Study::read(&path).unwrap_or_else(|e| panic!("{e}"));
        let search = study.optimise.as_mut().expect("optimises");
        // peaks at these speeds alone, without proofs: what is asked is of searches, whatever the peaks are
        (search.prices, search.prove.effort.boxes, study.refine_peaks) = (prices, 0, false);
        study.run().expect("damped")
    };
    let asked = found(("prices = true", "prices = true"), true);
    let own = asked.optima[0].optimum.value();
    let held = "conditions = [\"firing\", \"cold\", \"hot\"]\nprices = true";
    let limit = "dissipated_power = { max_w = 290 }";
    type Is<'a> = &'a dyn Fn(&Change) -> bool;
    let changes: [(Is, (&str, &str)); 5] = [
        (&|c| *c == Change::WithoutCondition(Condition::Cold), (held, "conditions = [\"firing\", \"hot\"]")),
        (&|c| *c == Change::WithoutCondition(Condition::Hot), (held, "conditions = [\"firing\", \"cold\"]")),
        (&|c| *c == Change::WithoutLimit(0), (limit, "dissipated_power = { max_w = 1e6 }")),
        (
            &|c| matches!(c, Change::WithoutBound { key: "loss_factor", .. }),
            ("loss_factor.between = [0.05, 0.18]", "loss_factor.between = [0.05, 2]"),
        ),
        (&|c| *c == Change::HalfTheRing, ("fixed = 0.076", "fixed = 0.038")),
    ];
    for (is_of, change) in changes {
        let price = asked.prices.iter().find(|p| is_of(&p.change)).unwrap_or_else(|| panic!("{change:?}: {:?}", asked.prices));
        let other = found(change, false).optima[0].optimum.value();
        assert_close(price.changed, other, 1e-6, 0.0, change.1);
        let cost = if price.change == Change::HalfTheRing { other / own - 1.0 } else { own / other - 1.0 };
        assert_close(price.cost().expect("limits hold"), cost, 1e-5, 1e-7, change.1);
        assert!(cost > 1e-4, "{} costs {cost}", change.1);
    }
    assert!(asked.prices.iter().all(|p| p.cost().is_some_and(|c| c >= 0.0)), "{:?}", asked.prices);
    assert_eq!(asked.prices.len(), 3 + 2 + 1 + 1, "conditions, limits, a bound, half the ring");
}

/// The same where the search does not steer what counts: a condition in which the damper does not work decides the judged value, and is priced by it.
#[test]
fn costs_are_of_what_is_judged() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = |name: &str, changes: &[(&str, &str)]| {
        let path = variant(folder.path(), name, changes);
        Study::read(&path).unwrap_or_else(|e| panic!("{e}")).run().expect("damped")
    };
    let locked = found(
        "villalva_i6_prices",
        &[
            ("\"cold\", \"hot\"]\nprices", "\"absorber_locked\"]\nprices"),
            ("\"firing\", \"cold\", \"hot\"]", "\"firing\", \"absorber_locked\"]"),
        ],
    );
    let price = locked.prices.iter().find(|p| p.change == Change::WithoutCondition(Condition::AbsorberLocked)).expect("priced");
    assert_close(price.own, locked.optima[0].design.objective.expect("a value"), 1e-12, 0.0, "as judged");
    let free = found(
        "villalva_i6_prices",
        &[
            ("conditions = [\"firing\", \"cold\", \"hot\"]", "conditions = [\"firing\"]"),
            ("temperatures = { cold_c = -20, hot_c = 90 }", ""),
        ],
    );
    assert_close(price.changed, free.optima[0].optimum.value(), 1e-6, 0.0, "without it");
    assert!(price.cost().is_some_and(|c| c > 0.3), "{price:?}");
}

/// Law: a limit that is never reached costs nothing, though limits are why the search looks at the state of operation; a bound on a property of the material has its price.
#[test]
fn a_limit_that_is_never_reached_costs_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = variant(folder.path(), "villalva_i6_materials", &FEW);
    let text = std::fs::read_to_string(&path).expect("study");
    let text = text
        .replace("conditions = [\"cold\", \"firing\", \"hot\"]", "random_starts = 0\nprices = true\nprove = { boxes = 0 }")
        .replace("\"fractional_zener\", \"carreau\", \"spring_pack\"", "\"carreau\"")
        .replace("[optimise]", "[[constraint]]\nacceleration = { station = \"pulley\", max_rad_per_s2 = 1e6 }\n[optimise]");
    let (head, tail) = text.split_once("[optimise.absorber.material.fractional_zener]").expect("materials");
    let oil = tail.split_once("[optimise.absorber.material.carreau]").expect("oil").1.split_once("# leaf springs").expect("springs").0;
    std::fs::write(&path, format!("{head}[optimise.absorber.material.carreau]{oil}")).expect("written");
    let results = Study::read(&path).unwrap_or_else(|e| panic!("{e}")).run().expect("damped");
    let cost = |is: &dyn Fn(&Change) -> bool| results.prices.iter().find(|p| is(&p.change)).and_then(hartog::analysis::Price::cost);
    assert_close(cost(&|c| *c == Change::WithoutLimit(0)).expect("priced"), 0.0, 0.0, 1e-7, "the limit");
    let bound = cost(&|c| matches!(c, Change::WithoutBound { key: "relaxation_time_s", .. }));
    assert!(bound.is_some_and(|c| c > 1e-3), "{:?}", results.prices);
}

/// Of a margin a cost is a loss: per cent by which it is smaller with the limit, as the page, the table and `results.json` show it.
#[test]
fn costs_of_a_margin_are_losses() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = variant(
        folder.path(),
        "villalva_i6_goals",
        &[("step = 20", "step = 200"), ("order_limit = 12", "order_limit = 3"), ("max_w = 150", "max_w = 0.5")],
    );
    let text = std::fs::read_to_string(&path).expect("study");
    let (head, tail) = text.split_once("[[objective]]").expect("objectives");
    let tail = tail.split_once("[[constraint]]").expect("limits").1;
    let (own, rest) = tail.split_once("[[constraint]]").expect("two limits");
    let own = format!("{own}[fatigue]{}", rest.split_once("[fatigue]").expect("strengths").1.split_once("[optimise]").expect("a search").0);
    let search = "[optimise]\nrandom_starts = 0\nprices = true\nprove = { boxes = 0 }\n[[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"tuned\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\n";
    std::fs::write(&path, format!("{head}[[objective]]\nmargin = {{}}\n[[constraint]]{own}{search}")).expect("written");
    let study = Study::read(&path).unwrap_or_else(|e| panic!("{e}"));
    let results = study.run().expect("damped");
    let told: serde_json::Value = serde_json::from_str(&hartog::report::results_json::text(&study, &[], &results)).expect("json");
    let optimum = &told["optima"][0];
    let own = optimum["value"].as_f64().expect("a margin");
    for (change, is_limit) in [("without limit mean over the duty", true), ("half the ring", false)] {
        let prices = optimum["prices"].as_array().expect("prices");
        let price = prices.iter().find(|p| p["change"].as_str().is_some_and(|c| c.starts_with(change))).expect("priced");
        let other = price["value_after"].as_f64().expect("a margin");
        let lost = if is_limit { 1.0 - own / other } else { 1.0 - other / own };
        assert!(lost > 1e-3, "{change}: {own} {other}");
        assert_close(price["cost_percent"].as_f64().expect("priced"), 100.0 * lost, 1e-6, 0.0, change);
    }
}
