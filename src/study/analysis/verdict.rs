//! What is absurd of an optimum although its numbers are right: it is worse than no absorber, gains next to nothing, cannot be built, lies on a bound of its search, or overheats.

use super::buildable::{OIL_DENSITY, Property, Range, range};
use super::evaluate::{AbsorberLoad, DesignResult};
use super::judged::Judged;
use super::results::{OptimumResult, Results};
use crate::absorber::{Absorber, FRACTIONAL_KELVIN, FRACTIONAL_ZENER, Mounted, RUBBER, TUNED};
use crate::drivetrain::natural;
use crate::optimise::OnBound;
use crate::units::HZ_PER_RAD_PER_S;

/// One finding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum Verdict {
    /// The engine without absorber is better, both inside.
    WorseThanNone {
        /// The value that the design is judged by.
        value: f64,
        /// That of the engine without absorber.
        none: f64,
    },
    /// The engine without absorber is nearly as good.
    LittleGain {
        /// The value that the design is judged by.
        value: f64,
        /// That of the engine without absorber.
        none: f64,
    },
    /// Nobody sells what it is made of.
    Unbuildable {
        /// Index of the absorber.
        absorber: usize,
        /// Of the property, in its unit.
        value: f64,
        /// What exists.
        exists: &'static Range,
    },
    /// It lies on a bound of its search.
    OnBound(OnBound),
    /// It overheats at so many of the speeds.
    Overheats {
        /// How many.
        speeds: usize,
        /// What its material bears, °C.
        limit: f64,
    },
}

/// A gain below this share is little.
#[doc(hidden)]
pub const LITTLE: f64 = 0.02;
/// Values nearer than this share are level.
const LEVEL: f64 = 1e-9;

impl Results {
    /// What is absurd of an optimum, the worst first.
    #[doc(hidden)]
    pub fn verdicts(&self, o: &OptimumResult) -> Vec<Verdict> {
        let mut found = self.verdicts_of(&o.design, &self.judged_optimum(o));
        found.extend(o.on_bounds.iter().copied().map(Verdict::OnBound));
        found
    }

    /// What is absurd of a design.
    #[doc(hidden)]
    pub fn verdicts_of(&self, d: &DesignResult, judged: &Judged) -> Vec<Verdict> {
        let mut found = Vec::new();
        let (value, bare) = (judged.value, self.bare.get(judged.objective).copied().flatten());
        if let Some(none) = bare.filter(|none| *none > 0.0 && !d.absorbers.is_empty()) {
            if value > none * (1.0 + LEVEL) {
                found.push(Verdict::WorseThanNone { value, none });
            } else if value > none * (1.0 - LITTLE) {
                found.push(Verdict::LittleGain { value, none });
            }
        }
        if let Some(h) = self.heat.iter().find(|h| h.design == d.name) {
            let speeds = h.points.iter().filter(|p| p.balances.is_empty()).count();
            found.extend((speeds > 0).then_some(Verdict::Overheats { speeds, limit: h.limit }));
        }
        for (absorber, (m, load)) in d.absorbers.iter().zip(&d.loads).enumerate() {
            for (of, value) in properties(m, load) {
                let exists = range(of);
                found.extend(exists.beyond(value).map(|_| Verdict::Unbuildable { absorber, value, exists }));
            }
        }
        found
    }
}

/// Types that stand for rubber where no shape says what is sheared.
fn is_rubber(absorber: &Absorber) -> bool {
    absorber.declaration().is_some_and(|d| [&TUNED, &RUBBER, &FRACTIONAL_KELVIN, &FRACTIONAL_ZENER].contains(&d))
}

/// What an absorber asks of what it is made of, as far as that is known.
fn properties(m: &Mounted, load: &AbsorberLoad) -> Vec<(Property, f64)> {
    let Some(law) = m.absorber.law() else { return Vec::new() };
    let mut list = Vec::new();
    // oil has no frequency that matters, and that of a pendulum goes with the speed of the shaft
    let swings = m.absorber.stiffness().is_some_and(|k| k > 0.0) && !law.depends_on_speed();
    let own = natural::own(law.as_ref()).filter(|_| swings);
    if let Some(omega) = own {
        list.push((Property::OwnFrequency, omega * HZ_PER_RAD_PER_S));
    }
    let loss = own.and_then(|_| natural::own_loss_factor(law.as_ref()));
    match load.made_of {
        Some(made) if made.viscosity.is_some() => list.extend(made.viscosity.map(|v| (Property::Viscosity, v / OIL_DENSITY))),
        Some(made) => {
            let strain = made.strain;
            let properties_of =
                |(_, modulus, loss)| [(Property::Modulus, modulus), (Property::LossFactor, loss), (Property::Strain, strain)];
            list.extend(made.rubber.into_iter().flat_map(properties_of));
        }
        // a spring with less loss is one of steel
        None => list.extend(
            loss.filter(|l| is_rubber(&m.absorber) && *l > range(Property::LossFactor).least.value).map(|l| (Property::LossFactor, l)),
        ),
    }
    list
}
