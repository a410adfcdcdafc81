//! Damping of the whole chain, as engineers state it beside that of single stations and links.

use crate::drivetrain::{Chain, Modes};
use crate::input::error::Check;
use crate::input::schema::bounds::{FRACTION_OF_CRITICAL, MAGNIFIER};
use crate::input::schema::engine::RawDamping;

/// Adds what the file says of the chain as a whole: dynamic magnifier M of every shaft, loss factor 1/M; Rayleigh damping C = alpha J + beta K; a fraction of
/// critical damping of the first elastic mode by dampers proportional to the stiffness, beta = 2 zeta/omega_1.
pub(super) fn apply(check: &mut Check, raw: &RawDamping, chain: &mut Chain) {
    let ways = [raw.dynamic_magnifier.as_ref(), raw.fraction_of_critical.as_ref(), raw.rayleigh.as_ref().map(|r| &r.stiffness_s)];
    if let [Some(_), Some(second), ..] | [Some(_), _, Some(second)] | [_, Some(second), Some(_)] = ways {
        check.wrong(
            second,
            "found two statements of the damping of all shafts, expected one of `dynamic_magnifier`, `fraction_of_critical` and `rayleigh`",
        );
        return;
    }
    let last = chain.len() - 1;
    if let Some(magnifier) = &raw.dynamic_magnifier {
        let m = check.within(magnifier, &MAGNIFIER);
        chain.stations[..last].iter_mut().for_each(|s| s.loss_factor_to_next += 1.0 / m);
    }
    if let Some(rayleigh) = &raw.rayleigh {
        let (alpha, beta) = (check.not_negative(&rayleigh.inertia_per_s), check.not_negative(&rayleigh.stiffness_s));
        for s in &mut chain.stations {
            s.damping_to_ground += alpha * s.inertia;
            s.damping_to_next += beta * s.stiffness_to_next;
        }
    }
    if let Some(fraction) = &raw.fraction_of_critical {
        let x = *fraction.get_ref();
        if (1.0..=100.0).contains(&x) {
            let words = format!("found {x}, expected {}", FRACTION_OF_CRITICAL.expected());
            check.wrong_with_help(fraction, words, format!("a fraction, not per cent: {x} % is {}", x / 100.0));
            return;
        }
        let zeta = check.within(fraction, &FRACTION_OF_CRITICAL);
        let modes = Modes::new(chain);
        let Some(first) = modes.elastic().next() else {
            check.wrong(fraction, "found a fraction of critical damping for a chain without an elastic mode, expected one");
            return;
        };
        let beta = 2.0 * zeta / modes.omega[first];
        chain.stations.iter_mut().for_each(|s| s.damping_to_next += beta * s.stiffness_to_next);
    }
}
