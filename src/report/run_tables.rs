//! The tables of a run, one row each; those of hundreds of thousands of rows (`response.csv`, `margin.csv`) are written beside them.

use super::csv;
use super::files::{Folder, WriteError};
use crate::absorber::{Material, Mounted};
use crate::analysis::{Results, compounds};
use crate::crankshaft::MarginCriterion;
use crate::input::{FrontSpec, Study};

/// A table of a run.
pub(super) struct RunTable {
    /// Its name without the ending.
    pub stem: &'static str,
    /// What is in it: its caption on the page, and what `guide/outputs.md` says of it.
    pub about: &'static str,
    /// Whether a run of a study may write it: such a file of an earlier run gives way.
    pub asked: fn(&Study) -> bool,
    /// Writes it; no file where there is nothing to tell.
    pub write: fn(&Study, &Results, &Folder) -> Result<(), WriteError>,
}

/// All of them, in the order in which the page shows them.
pub(super) const RUN_TABLES: [RunTable; 28] = [
    RunTable {
        stem: "designs",
        about: "one row for each design, optima included: values, natural frequencies (f1_hz and so on: those of the damped motion of chain and absorbers, a rubber or oil being the spring and damper that it is at the frequency of the motion; overdamped motions, and designs with a law that depends on the speed, have none), peak twist, largest order, shaft torque, heat, ring twist",
        asked: always,
        write: csv::designs,
    },
    RunTable {
        stem: "values",
        about: "one row for each value of every design: condition, measure, value, unit, place, order, speed",
        asked: always,
        write: csv::values,
    },
    RunTable {
        stem: "compounds",
        about: "compounds, oils and steps of dimensions that a study chooses from, one row each: the objective at the best that was found of it; of those that were left out the best that was found without limits",
        asked: |s| s.optimise.as_ref().is_some_and(compounds::are_named),
        write: csv::compounds,
    },
    RunTable {
        stem: "prices",
        about: "what each condition, limit and bound costs, one row each for the optimum of each type: the objective with all that is asked, and of the optimum that was found without it; and with half of the ring",
        asked: |s| s.optimise.as_ref().is_some_and(|o| o.prices),
        write: csv::prices,
    },
    RunTable {
        stem: "order_peaks",
        about: "the orders that matter to each quantity of a design, the largest first: largest amplitude at the speeds of the study, and that speed",
        asked: always,
        write: csv::order_peaks,
    },
    RunTable {
        stem: "crank_models",
        about: "peak twist of each design by every model of the crank: its chain, the flexible crank, and that with main bearings half and twice as stiff",
        asked: |s| s.on_flexible().is_some(),
        write: |_, r, f| csv::crank_models(r, f),
    },
    RunTable {
        stem: "joints",
        about: "twist of the design without absorber, the best given one and the best optimum on bearings that are not linear, beside that on linear ones: at the speed of the largest and 3 % beside it; displacement over the reach of the law, the last harmonics, steps of the solution",
        asked: |s| s.on_flexible().is_some_and(|f| f.spec.joints.is_some()),
        write: |_, r, f| csv::joints(r, f),
    },
    RunTable {
        stem: "web_loads",
        about: "webs of the design without absorber, the best given one and the best optimum on the flexible crank: half peak-to-peak of the moment in the plane of the throw in the middle of a web where it is largest, the same at that speed without vibration, and what vibration adds at most over all speeds to the amplitude of its nominal bending stress",
        asked: on_webs,
        write: |_, r, f| csv::web_loads(r, f),
    },
    RunTable {
        stem: "web_margins",
        about: "smallest margin of the same designs at the speeds of the study, the webs bent as the flexible crank bends them, beside that by the continuous beam which searches and other tables use",
        asked: on_webs,
        write: |_, r, f| csv::web_margins(r, f),
    },
    RunTable {
        stem: "von_mises",
        about: "largest equivalent stress of von Mises over the cycle of the same designs at each speed under these loads, with its location and the crank angle from the firing of the first cylinder; where a multiaxial criterion is judged",
        asked: |s| on_webs(s) && s.fatigue.as_ref().is_some_and(|f| f.criteria.iter().any(|c| matches!(c, MarginCriterion::Multiaxial(_)))),
        write: |_, r, f| csv::von_mises(r, f),
    },
    RunTable {
        stem: "catalogue",
        about: "every absorber of the study's catalogues, the best first",
        asked: |s| !s.catalogues.is_empty(),
        write: csv::catalogue,
    },
    RunTable {
        stem: "absorbers",
        about: "one row for each absorber of every design: where it sits, its type, every parameter, heat, ring twist, the loss factor that spring and damper imply; modulus or viscosity, and strain, where its shape is given",
        asked: always,
        write: |_, r, f| csv::absorbers(r, f),
    },
    RunTable {
        stem: "duty",
        about: "twist, torque and heat of each design at the points of the duty",
        asked: |s| !s.duty.is_empty(),
        write: |_, r, f| csv::duty(r, f),
    },
    RunTable {
        stem: "life",
        about: "cycles of strain and damage of absorbers at the points of the duty",
        asked: |s| !s.duty.is_empty() && materials(s, &|m| m.life.is_some()),
        write: |_, r, f| csv::life(r, f),
    },
    RunTable {
        stem: "heat",
        about: "temperatures of absorbers in balance of heat at every speed, stable or not",
        asked: |s| materials(s, &|m| m.thermal.is_some()),
        write: |_, r, f| csv::heat(r, f),
    },
    RunTable {
        stem: "strain",
        about: "the self-consistent strain of filled rubber at every speed, by each of the two rules",
        asked: |s| materials(s, &|m| m.amplitude.is_some()),
        write: |_, r, f| csv::strain(r, f),
    },
    RunTable {
        stem: "large_twist",
        about: "steady motions of designs with an absorber whose twist is not small, stable or not",
        asked: has_large_twist,
        write: |_, r, f| csv::large_twist(r, f),
    },
    RunTable { stem: "robust", about: "designs within the tolerances of the study", asked: |s| s.robust.is_some(), write: csv::robust },
    RunTable {
        stem: "allocation",
        about: "tolerances that each design can bear under the limits of the study, one row each: as given and as it bears them, what they cost, and what the others gain where it is nil",
        asked: |s| s.robust.as_ref().is_some_and(|r| r.allocate.is_some()),
        write: csv::allocation,
    },
    RunTable {
        stem: "limits",
        about: "one row for each limit of every design: value, whether it holds, and what one per cent more of it would bring",
        asked: |s| !s.limits.is_empty(),
        write: csv::limits,
    },
    RunTable {
        stem: "condition_limits",
        about: "one row for each limit of every design in each condition that changes one: value, how much of the limit it uses, whether it holds, whether it is judged there",
        asked: |s| !s.limits.is_empty(),
        write: csv::condition_limits,
    },
    RunTable {
        stem: "barred",
        about: "one row for each range of speed that a society's rule bars for a design that breaks its limit",
        asked: |s| s.limits.iter().any(|l| l.rule.is_some()),
        write: csv::barred,
    },
    RunTable {
        stem: "torsion_cases",
        about: "one row for each speed of every design by the torsion case of the study: stress at two instants of the cycle at the crankpin and the journal of the half throw with the smallest factor at its crankpin, its safety factors by Goodman, and the smallest over the full cycle",
        asked: |s| s.fatigue.as_ref().is_some_and(|f| f.torsion_case.is_some()),
        write: |_, r, f| csv::torsion_cases(r, f),
    },
    RunTable {
        stem: "rule_stresses",
        about: "one row for each limit by a society's rule of every design: where the stress is nearest to it, in which condition",
        asked: |s| s.limits.iter().any(|l| l.rule.is_some()),
        write: csv::rule_stresses,
    },
    RunTable {
        stem: "optima",
        about: "one row for each optimum: value, first- and second-order conditions, agreement of starts, other local optima, designs looked at elsewhere and near it, what is proved of it",
        asked: |s| s.optimise.is_some(),
        write: csv::optima,
    },
    RunTable {
        stem: "sensitivities",
        about: "one row for each measure and parameter of every optimum: relative change (in operation where the measure is largest there), and how far (up to 50 %) the parameter may drift before a limit breaks",
        asked: |s| s.optimise.is_some(),
        write: |_, r, f| csv::sensitivities(r, f),
    },
    RunTable {
        stem: "pareto",
        about: "the best absorber for each ring inertia",
        asked: |s| matches!(s.front, Some(FrontSpec::OverInertia(_))),
        write: csv::pareto,
    },
    RunTable {
        stem: "front",
        about: "fronts of any two measures",
        asked: |s| matches!(s.front, Some(FrontSpec::Of { .. })),
        write: csv::front,
    },
];

fn on_webs(study: &Study) -> bool {
    study.on_flexible().is_some() && study.fatigue.is_some()
}

fn always(_: &Study) -> bool {
    true
}

/// Absorbers that are given or sold.
fn given(study: &Study) -> impl Iterator<Item = &Mounted> {
    study.designs.iter().chain(study.catalogues.iter().flat_map(|c| &c.designs)).flat_map(|d| &d.absorbers)
}

/// Whether some absorber may be of such a material; of optima each that has one counts.
pub(super) fn materials(study: &Study, of: &dyn Fn(&Material) -> bool) -> bool {
    let found = study.optimise.iter().flat_map(|o| &o.absorbers).any(|a| !a.materials.is_empty());
    found || given(study).filter_map(|m| m.absorber.law()?.material()).any(of)
}

/// Whether the twist of some absorber is not small.
pub(super) fn has_large_twist(study: &Study) -> bool {
    given(study).filter_map(|m| m.absorber.law()).any(|law| law.large_twist().is_some())
}
