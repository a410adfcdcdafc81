//! A study from engine and chain in memory, for programs that read no files.

use super::checked_study::{CrankModel, DEFAULT_TOLERANCE, Reciprocating, ResponseMethod, Study};
use super::family::{AbsorberSpec, Size};
use super::material_states::Temperatures;
use super::measures::{default_twist, twist_spec};
use super::optimise::OptimiseSpec;
use crate::absorber::construction::shape;
use crate::absorber::types::GIVEN_ONLY;
use crate::absorber::{Declaration, Host};
use crate::drivetrain::{Chain, Modes};
use crate::engine::{Engine, Source};
use crate::input::schema::prove::EFFORT;
use crate::objective::Condition;

/// Why no study follows from its parts.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PartsError {
    /// A chain of no station, or one whose stations are not joined as they should be.
    #[error("station {station}: {wrong}")]
    Station {
        /// Index in the chain.
        station: usize,
        /// What was found, and what was expected.
        wrong: &'static str,
    },
    /// Throws of the layout and of the stations differ.
    #[error("found {found} throws on the stations, expected each of the {expected} of the engine's layout once")]
    Throws {
        /// On the stations.
        found: usize,
        /// Of the layout.
        expected: usize,
    },
    /// What the engine cannot have.
    #[error("{0}")]
    Engine(&'static str),
    /// Speeds or orders that are none.
    #[error("found no ascending, finite speeds above zero and order limit from 0.5 to 200, expected both")]
    Range,
    /// A type that no search can take.
    #[error("found a search for `{0}`, whose law is of large twist or needs dimensions, expected another type: it may be given")]
    GivenOnly(&'static str),
    /// A station or size of an absorber that is none.
    #[error(
        "found an absorber on station {station} with a ring of {ring_inertia} kg m², expected a station of the chain and an inertia above zero"
    )]
    Absorber {
        /// Index.
        station: usize,
        /// As it was given, kg m².
        ring_inertia: String,
    },
}

impl Study {
    /// The twist of a chain under an engine, from its first station to its last, as a study file without objective asks for it. Inertias hold what is to be held of the reciprocating masses; all else
    /// (conditions, limits, designs) is empty and may be set in its fields.
    ///
    /// `speeds_rpm`: ascending, rpm, the grid between which peaks are refined; `order_limit`: the highest order.
    ///
    /// # Errors
    /// [`PartsError`] where the parts do not belong together; the pressure is taken as it is.
    pub fn from_parts(engine: Engine, chain: Chain, speeds_rpm: Vec<f64>, order_limit: f64) -> Result<Self, PartsError> {
        check_engine(&engine)?;
        check_chain(&chain, &engine)?;
        let ascending = speeds_rpm.windows(2).all(|w| w[0] < w[1]) && speeds_rpm.first().is_some_and(|s| *s > 0.0);
        if !ascending || !speeds_rpm.iter().all(|s| s.is_finite()) || !(0.5..=200.0).contains(&order_limit) {
            return Err(PartsError::Range);
        }
        let table = match &engine.source {
            Source::Cylinder { pressure, .. } => pressure.speeds_rpm().to_vec(),
            Source::Harmonics(table) => table.speeds_rpm(),
        };
        let known_rpm = table.first().zip(table.last()).map(|(low, high)| (*low, *high));
        Ok(Self {
            name: "study".into(),
            reciprocating: Reciprocating { mean: false, stated: true },
            modes: Modes::new(&chain),
            known_rpm,
            method: ResponseMethod::Auto,
            tolerance: DEFAULT_TOLERANCE,
            refine_peaks: true,
            every_station: false,
            torque_in_conditions: false,
            designs: Vec::new(),
            catalogues: Vec::new(),
            hub: 0,
            twist: default_twist(&chain, 0),
            objective: twist_spec(&chain, 0),
            more_objectives: Vec::new(),
            combined: None,
            limits: Vec::new(),
            optimise: None,
            held_without_search: vec![Condition::Firing],
            robust: None,
            front: None,
            conditions: Vec::new(),
            temperatures: Temperatures::default(),
            scatter: None,
            published: None,
            calibrate: None,
            crank: None,
            flexible: None,
            crank_model: CrankModel::Chain,
            crank_engine: None,
            duty: Vec::new(),
            fatigue: None,
            remarks: Vec::new(),
            set: Vec::new(),
            placeholders: Vec::new(),
            engine,
            chain,
            speeds_rpm,
            order_limit,
        })
    }

    /// The same with a search for the best absorber of a type and size on a station: all its other parameters are free within wide bounds. The twist is from that station to the last.
    ///
    /// # Errors
    /// [`PartsError::Absorber`] where there is no such station or ring, [`PartsError::GivenOnly`] of a type whose law is of large twist or needs dimensions.
    pub fn with_search(mut self, station: usize, kind: &'static Declaration, ring_inertia: f64) -> Result<Self, PartsError> {
        if station >= self.chain.len() || !ring_inertia.is_finite() || ring_inertia <= 0.0 {
            return Err(PartsError::Absorber { station, ring_inertia: ring_inertia.to_string() });
        }
        if GIVEN_ONLY.contains(&kind) || shape(kind).is_some() {
            return Err(PartsError::GivenOnly(kind.name));
        }
        let absorber = AbsorberSpec {
            on: Host::Station(station),
            hub_inertia: 0.0,
            types: vec![kind],
            size: Size::Each(vec![ring_inertia]),
            bounds: Vec::new(),
            steps: Vec::new(),
            materials: Vec::new(),
            temperatures: Temperatures::default(),
            whole_chain: false,
        };
        let spec = OptimiseSpec {
            seed: 1,
            random_starts: super::optimise::RANDOM_STARTS,
            absorbers: vec![absorber],
            conditions: vec![Condition::Firing],
            in_operation: false,
            prices: false,
            prove: super::optimise::ProveSpec { effort: EFFORT, all: false, file: false },
            search_all: false,
        };
        (self.hub, self.twist, self.objective) = (station, default_twist(&self.chain, station), twist_spec(&self.chain, station));
        self.optimise = Some(spec);
        Ok(self)
    }
}

fn check_engine(engine: &Engine) -> Result<(), PartsError> {
    let layout = &engine.layout;
    if !matches!(engine.strokes, 2 | 4) {
        return Err(PartsError::Engine("found other than 2 or 4 strokes, expected one of them"));
    }
    let in_pairs = layout.rods_per_throw == 1 || layout.rods_per_throw == 2 && layout.firing_deg.len().is_multiple_of(2);
    if layout.firing_deg.is_empty() || !in_pairs || !layout.firing_deg.iter().all(|deg| deg.is_finite()) {
        return Err(PartsError::Engine(
            "found no finite firing angle for each rod, expected one for each cylinder, one or two cylinders on a throw",
        ));
    }
    if layout.misplaced_throw().is_some() {
        return Err(PartsError::Engine(
            "found two cylinders of a throw whose firing angles do not differ by the bank angle, expected that",
        ));
    }
    if let Source::Cylinder { geometry, .. } = &engine.source {
        let crank = &geometry.slider_crank;
        let rod = geometry.rod_rotating_fraction();
        let sizes = [geometry.bore, crank.crank_radius, crank.rod_length, geometry.piston_mass, geometry.rod_mass, rod, 1.0 - rod];
        if !sizes.iter().all(|x| x.is_finite() && *x >= 0.0) || geometry.bore == 0.0 || crank.rod_length <= crank.crank_radius {
            return Err(PartsError::Engine(
                "found a bore, stroke, rod or mass that no engine has, expected them positive and the rod longer than the crank radius",
            ));
        }
    }
    Ok(())
}

fn check_chain(chain: &Chain, engine: &Engine) -> Result<(), PartsError> {
    let wrong = |station: usize, wrong: &'static str| Err(PartsError::Station { station, wrong });
    let Some(last) = chain.len().checked_sub(1) else { return wrong(0, "found a chain without stations, expected one at least") };
    for (i, s) in chain.stations.iter().enumerate() {
        let rest = [s.stiffness_to_next, s.damping_to_next, s.loss_factor_to_next, s.stiffness_to_ground, s.damping_to_ground, s.inertia];
        if !rest.iter().all(|x| x.is_finite() && *x >= 0.0) || s.inertia == 0.0 {
            return wrong(i, "found an inertia, stiffness or damping below zero or not finite, or no inertia, expected them positive");
        }
        if i == last && (s.stiffness_to_next > 0.0 || s.damping_to_next > 0.0 || s.joint.is_some()) {
            return wrong(i, "found what joins the last station to a next one, expected nothing");
        }
        if let Some(joint) = &s.joint
            && (joint.leads_to <= i || joint.leads_to > last || !joint.gear.is_finite() || joint.gear == 0.0)
        {
            return wrong(i, "found a joint to a station that is not after this one, or a gear of zero, expected a later station");
        }
        if chain.stations[..i].iter().any(|other| other.name == s.name) {
            return wrong(i, "found a name a second time, expected different names");
        }
    }
    let mut throws: Vec<usize> = chain.stations.iter().flat_map(|s| s.throws.iter().copied()).collect();
    throws.sort_unstable();
    let expected = engine.layout.throws();
    if throws.iter().copied().ne(0..expected) {
        return Err(PartsError::Throws { found: throws.len(), expected });
    }
    Ok(())
}
