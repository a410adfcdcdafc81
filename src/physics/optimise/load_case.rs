//! A condition of the engine in which a design is held: its absorbers there, and what they come to.

use super::variables::Space;
use crate::absorber::{Absorber, Deviation, Host, Law, Material, Mounted, WithMaterial};
use crate::objective::Shared;
use crate::objective::condition::Condition;
use crate::objective::in_operation;
use crate::objective::measure::{Limit, Measure, Over};
use crate::objective::peak_search::PeakFinder;
use crate::response::{ResponseError, Work};
use std::borrow::Cow;
use std::sync::Arc;

/// One of several engines that share a design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Engine<'a> {
    /// Which of them.
    pub index: usize,
    /// What carries each absorber there.
    pub hosts: &'a [Host],
    /// The material of each, with the temperatures of this engine.
    pub materials: &'a [Arc<Material>],
}

impl Engine<'_> {
    /// A design in its place on this engine, at its temperatures.
    #[doc(hidden)]
    pub fn mounted(&self, design: &[Mounted]) -> Vec<Mounted> {
        let one = |((m, host), material): ((&Mounted, &Host), &Arc<Material>)| {
            let own = |law: &Arc<dyn Law>| Absorber::Ring(WithMaterial::of((law.declaration().build)(&law.values()), material));
            Mounted { on: *host, absorber: m.absorber.law().map_or_else(|| m.absorber.clone(), own), ..m.clone() }
        };
        design.iter().zip(self.hosts).zip(self.materials).map(one).collect()
    }
}

/// One condition of the engine: what is asked of a design is asked in each.
#[derive(Debug, Clone, Copy)]
pub struct LoadCase<'a> {
    /// State of the absorbers.
    pub condition: Condition,
    /// The cylinder (from 0) that misfires.
    pub cylinder: Option<usize>,
    /// Finds the peaks of the engine in this condition.
    pub finder: &'a PeakFinder<'a>,
    /// How absorbers deviate from what was drawn.
    pub deviation: Option<&'a Deviation>,
    /// Which of several engines it is of; `None` where there is only one.
    pub engine: Option<Engine<'a>>,
}

impl<'a> LoadCase<'a> {
    /// That of the only engine, with absorbers as drawn.
    pub fn new(condition: Condition, finder: &'a PeakFinder<'a>) -> Self {
        Self { condition, cylinder: finder.system.excitation.units.misfiring(), finder, deviation: None, engine: None }
    }

    /// A design in its place on this engine.
    fn mounted<'d>(&self, design: &'d [Mounted]) -> Cow<'d, [Mounted]> {
        let Some(engine) = self.engine else { return Cow::Borrowed(design) };
        Cow::Owned(engine.mounted(design))
    }

    /// The absorbers of a design as they are here.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance, of absorbers in operation.
    pub fn absorbers(&self, design: &[Mounted]) -> Result<Vec<Mounted>, ResponseError> {
        let design = &*self.mounted(design);
        match self.deviation {
            // what deviates is what was drawn; its state in operation follows from that
            Some(deviation) if self.condition == Condition::InOperation => {
                in_operation::absorbers(self.condition, self.finder, &deviation.of(design))
            }
            Some(deviation) => Ok(deviation.of(&self.condition.absorbers(design))),
            None => in_operation::absorbers(self.condition, self.finder, design),
        }
    }

    /// The same where only a few speeds are asked for: in operation, no state is found but at those.
    pub(super) fn absorbers_at_few_speeds(&self, design: &[Mounted]) -> Vec<Mounted> {
        let design = &*self.mounted(design);
        match self.deviation {
            Some(deviation) if self.condition == Condition::InOperation => {
                in_operation::absorbers_at_few_speeds(self.condition, self.finder, &deviation.of(design))
            }
            Some(deviation) => deviation.of(&self.condition.absorbers(design)),
            None => in_operation::absorbers_at_few_speeds(self.condition, self.finder, design),
        }
    }

    /// The largest value of a measure of a design here; nothing of it is zero.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(crate) fn peak(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<f64, ResponseError> {
        Ok(self.finder.peak(&self.absorbers(design)?, measure, work)?.map_or(0.0, |p| p.value))
    }

    /// The same; nothing is zero, too, where it is below `least`.
    ///
    /// # Errors
    /// As [`Self::peak`].
    #[doc(hidden)]
    pub fn peak_above(&self, design: &[Mounted], measure: &Measure, least: f64, work: &mut Work) -> Result<f64, ResponseError> {
        self.finder.exact_value(&self.absorbers(design)?, (measure, least), &Shared::default(), work)
    }

    /// Values of some measures of a design here, each with what it has to exceed to be told: nothing and less are zero. What they need of the design is computed once.
    ///
    /// # Errors
    /// As [`Self::peak`], by measure.
    #[doc(hidden)]
    pub fn values_above(&self, design: &[Mounted], asked: &[(&Measure, f64)], work: &mut Work) -> Vec<Result<f64, ResponseError>> {
        let own = match self.absorbers(design) {
            Ok(own) => own,
            Err(error) => return vec![Err(error); asked.len()],
        };
        let shared = Shared::of(asked.iter().map(|a| a.0));
        asked.iter().map(|a| self.finder.exact_value(&own, *a, &shared, work)).collect()
    }

    /// Measures of a limit or objective that are asked here, each with what it is in units of: those of this engine that count in this condition. Temperatures are those in operation in every load case, and a property is that of what was
    /// drawn: neither is another one in operation.
    #[doc(hidden)]
    pub fn parts_of<'l>(&self, limit: &'l Limit) -> impl Iterator<Item = (&'l Measure, f64)> {
        let case = *self;
        limit.parts().filter(move |p| case.counts(limit, p.0, p.2)).map(|p| (p.0, p.1))
    }

    /// Whether one of them is.
    pub(super) fn counts(&self, limit: &Limit, measure: &Measure, in_service: bool) -> bool {
        let of_here = limit.engine.is_none_or(|engine| self.engine.is_none_or(|own| own.index == engine));
        of_here && self.differs_in(measure) && self.condition.counts(in_service)
    }

    /// Whether a measure may be another one here than at the reference: not in operation, where it is found of that or does not follow from the motion.
    #[doc(hidden)]
    pub fn differs_in(&self, measure: &Measure) -> bool {
        self.condition != Condition::InOperation || !matches!(measure.over, Over::Temperature | Over::Property(_))
    }

    /// Whether a family can change anything here: a lost ring cannot, a locked one only by its inertia.
    pub(super) fn steers(&self, space: &Space) -> bool {
        match self.condition {
            Condition::AbsorberLocked => space.variables.iter().any(|v| v.parameter == 0),
            Condition::AbsorberLost => false,
            _ => true,
        }
    }
}

/// The largest value of a measure of a design over some load cases; nothing of it is zero.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
#[doc(hidden)]
pub fn largest<'a>(
    mut load_cases: impl Iterator<Item = &'a LoadCase<'a>>,
    design: &[Mounted],
    measure: &Measure,
    work: &mut Work,
) -> Result<f64, ResponseError> {
    load_cases.try_fold(0.0, |worst, case| Ok(f64::max(worst, case.peak_above(design, measure, worst, work)?)))
}
