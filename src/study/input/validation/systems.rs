//! What a study computes with: its torque, and its chain or flexible crank under it.

use super::absorbers::DesignSpec;
use super::checked_study::{CrankModel, Study};
use super::flexible_model::FlexibleModel;
use crate::absorber::mounted::station_of;
use crate::crankshaft::flexible::Balance;
use crate::drivetrain::System;
use crate::drivetrain::flexible::Asked;
use crate::engine::{Engine, Excitation};
use crate::objective::condition::Burning;

impl Study {
    /// The flexible crank, where responses are computed with it.
    #[doc(hidden)]
    pub fn on_flexible(&self) -> Option<&FlexibleModel> {
        self.flexible.as_ref().filter(|_| self.crank_model == CrankModel::Flexible)
    }

    /// What a user is to know of its flexible crank, where responses are computed with it: sentences.
    pub(crate) fn remarks_on_crank(&self) -> Vec<String> {
        let Some(flexible) = self.on_flexible() else { return Vec::new() };
        let throws = |is: &dyn Fn(&Balance) -> bool| {
            let all = flexible.assembled.balance.iter().enumerate().filter(|(_, b)| is(b)).map(|(t, _)| (t + 1).to_string());
            all.collect::<Vec<_>>().join(", ")
        };
        let (bare, thin) = (throws(&|b| b.left_out > 0.0), throws(&|b| b.density < 1.0));
        let mut all = self
            .crank
            .as_ref()
            .map_or_else(Vec::new, |crank| flexible.objections((crank, &self.engine, &self.chain), self.fatigue.is_some()));
        if !bare.is_empty() {
            all.push(format!(
                "the flexible crank has no counterweights on throws {bare}: their stations leave no inertia for them, so that their vibration goes without; in mean forces their moment counts"
            ));
        }
        if !thin.is_empty() {
            all.push(format!(
                "webs and pins of throws {thin} are heavier as drawn than their stations: their steel counts less dense (`check --verbose`)"
            ));
        }
        all
    }

    /// The torque of its engine, with the radial forces on its pins where the crank is flexible.
    pub(crate) fn excitation(&self) -> Excitation {
        self.with_radial(Excitation::new(&self.engine, self.order_limit), &self.engine)
    }

    /// The same for a torque of another state of the engine.
    pub(crate) fn with_radial(&self, excitation: Excitation, engine: &Engine) -> Excitation {
        if self.on_flexible().is_some() { excitation.with_radial(engine) } else { excitation }
    }

    /// Its chain, or its flexible crank, under a torque.
    pub(crate) fn system(&self, excitation: Excitation) -> System {
        let (chain, modes) = (self.chain.clone(), self.modes.clone());
        let Some((flexible, crank)) = self.on_flexible().zip(self.crank.as_ref()) else {
            return System::with_modes(chain, modes, excitation);
        };
        let tables = flexible.tables((crank, &self.engine), self.asked_of_tables(&excitation));
        let own = flexible.modes_of_stations(&chain).unwrap_or_else(|| modes.clone());
        System::with_modes(chain, modes, excitation).on_flexible(tables, own)
    }

    fn asked_of_tables(&self, excitation: &Excitation) -> Asked {
        let designs = self.designs.iter().chain(self.catalogues.iter().flat_map(|c| &c.designs));
        let on = |d: &DesignSpec| (0..d.absorbers.len()).map(|i| station_of(&d.absorbers, i)).collect::<Vec<_>>();
        let mut hosts: Vec<usize> = designs.flat_map(on).collect();
        hosts.extend(self.optimise.iter().flat_map(|o| (0..o.absorbers.len()).map(|i| o.station(i))));
        hosts.push(self.hub);
        hosts.sort_unstable();
        hosts.dedup();
        Asked {
            orders: excitation.orders.clone(),
            speeds_rpm: (self.speeds_rpm[0], self.speeds_rpm[self.speeds_rpm.len() - 1]),
            hosts,
            unlike: self.conditions.iter().any(|c| c.burning() != Burning::Alike),
        }
    }
}
