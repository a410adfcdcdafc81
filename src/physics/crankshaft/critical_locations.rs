//! Critical locations of a crank that are judged: fillets of every web and outlets of oil bores, with their factors and the shafts whose torque they carry.

use super::criterion::{FactorSource, Family, FatigueSpec, FilletSpec, MarginCriterion};
use super::stress_concentration::{Factors, Formulas};
use super::unit_loads::UnitLoads;
use super::{Concentration, Crank, Place, section};
use crate::drivetrain::Chain;
use crate::fatigue::endurance;
use crate::numerics::elementary::Elementary;

/// A fillet (or oil bore) of one web.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalLocation {
    /// Name with the number of the throw, and of the point where its fillet has several.
    pub name: String,
    /// The same without the point.
    pub(super) fillet: String,
    /// How many points its fillet has.
    pub(super) points: usize,
    /// From 0.
    pub throw: usize,
    /// Whether it is on the web behind the crankpin.
    pub rear: bool,
    /// Place.
    pub place: Place,
    /// The shaft whose torque it carries.
    pub shaft: usize,
    /// Local bending stress (tension positive) per moment in the plane of the throw, 1/m³, and per one across it (oil bores).
    pub(super) bending: [f64; 2],
    /// Local stress per shear force in that plane, 1/m².
    pub(super) radial: f64,
    /// Local shear stress per torque, 1/m³.
    pub(super) torsion: f64,
    /// Stresses per unit load, instead of the nominal ones.
    pub(super) unit_loads: Option<UnitLoads>,
    /// Whose it is.
    pub family: Family,
    /// Of the class rule: allowable amplitude, Pa.
    pub(super) allowable: Option<f64>,
}

impl CriticalLocation {
    /// Index of its web: front and rear of each throw.
    pub(super) fn web(&self) -> usize {
        2 * self.throw + usize::from(self.rear)
    }
}

/// Stations of the throws, by throw; nothing unless they follow each other along the chain, one way or the other.
#[doc(hidden)]
pub fn stations_of_throws(chain: &Chain, throws: usize) -> Option<Vec<usize>> {
    let station_of = |throw: usize| chain.stations.iter().position(|s| s.throws.contains(&throw));
    let stations: Vec<usize> = (0..throws).map(station_of).collect::<Option<_>>()?;
    let leads = |from: usize, to: usize| chain.path(from, to).iter().all(|link| link.1 > 0.0) && from < to;
    let rises = stations.windows(2).all(|p| leads(p[0], p[1]));
    let falls = stations.windows(2).all(|p| leads(p[1], p[0]));
    (rises || falls).then_some(stations)
}

/// Shafts whose torque the webs of the crank carry.
pub fn shafts(chain: &Chain, throws: usize) -> Vec<usize> {
    let mut shafts: Vec<usize> = (0..throws).filter_map(|t| shafts_beside(chain, throws, t)).flatten().collect();
    shafts.sort_unstable();
    shafts.dedup();
    shafts
}

/// The shafts on the sides of the throw before and of the one after each throw; a throw at an end of the chain has the one beside it on both sides.
fn shafts_beside(chain: &Chain, throws: usize, throw: usize) -> Option<[usize; 2]> {
    let stations = stations_of_throws(chain, throws)?;
    let last = chain.len().checked_sub(2)?;
    let station = stations[throw];
    // of what leads to the station, the shaft that comes from the throw before, or the one without a gear
    let leading = |i: &usize| chain.next(*i) == station && chain.gear(*i) == 1.0;
    let from_throw = |i: &usize| stations.iter().any(|s| *s <= *i && chain.path(*s, station).iter().any(|link| link.0 == *i));
    let before = (0..station).filter(leading).max_by_key(|i| (from_throw(i), *i));
    let after = if station > last { before.unwrap_or(last) } else { station };
    let beside = [before.unwrap_or(after), after];
    let falls = stations.windows(2).any(|p| p[0] > p[1]);
    Some(if falls { [beside[1], beside[0]] } else { beside })
}

/// The shaft whose torque each main bearing carries, from the one before the first throw to that behind the last; `None` where the throws do not follow each other along the chain.
#[doc(hidden)]
pub fn shafts_at_bearings(chain: &Chain, throws: usize) -> Option<Vec<usize>> {
    let beside: Vec<[usize; 2]> = (0..throws).map(|t| shafts_beside(chain, throws, t)).collect::<Option<_>>()?;
    Some(beside.first().map(|b| b[0]).into_iter().chain(beside.iter().map(|b| b[1])).collect())
}

/// Webs of a throw (whether it is the rear one) with the shafts whose torque a place there is judged with.
fn sides(chain: &Chain, throws: usize, throw: usize, place: Place) -> Option<Vec<(bool, usize)>> {
    let [front, rear] = shafts_beside(chain, throws, throw)?;
    let own = match place {
        Place::Journal => vec![(false, front), (true, rear)],
        Place::Crankpin | Place::OilBore => vec![(false, front), (false, rear), (true, front), (true, rear)],
    };
    Some(own)
}

/// Sign of the local stress under a moment that is positive for the beam, as under a force towards the crankshaft: it opens the crankpin's fillets, which lie
/// on the side of the crankshaft, and closes those of the journals, on the side of the pin.
fn tension(place: Place) -> f64 {
    if place == Place::Journal { -1.0 } else { 1.0 }
}

/// Shear pushes both webs of a throw the same way and has opposite signs in them.
fn away(rear: bool) -> f64 {
    if rear { -1.0 } else { 1.0 }
}

/// Shear stress per torque where a place is, 1/m³.
fn per_torque(crank: &Crank, place: Place) -> f64 {
    match place {
        Place::Journal => section::torsion(crank.journal_diameter, crank.journal_bore),
        _ => section::torsion(crank.pin_diameter, crank.pin_bore),
    }
}

/// Local stresses of a fillet per moment, shear force and torque, factors included: 1/m³, 1/m², 1/m³.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Nominal {
    /// Stress per bending moment in the plane of the throw.
    pub bending: f64,
    /// Stress per shear force in that plane.
    pub radial: f64,
    /// Shear stress per torque.
    pub torsion: f64,
}

/// Those of a fillet with factors of nominal stress, on the section that its factors are of; `None` of one with stresses per unit load.
#[doc(hidden)]
pub fn nominal(crank: &Crank, spec: &FatigueSpec, fillet: &FilletSpec) -> Option<Nominal> {
    let sensitive = |factor: f64, radius: f64, torsion: bool| {
        let q = if spec.notch_sensitivity { endurance::notch_sensitivity(radius, spec.strength.tensile, torsion) } else { 1.0 };
        endurance::fatigue_factor(factor, q)
    };
    let (radius, round) = match fillet.place {
        Place::Journal => (crank.journal_fillet, section::bending(crank.journal_diameter, crank.journal_bore)),
        _ => (crank.pin_fillet, section::bending(crank.pin_diameter, crank.pin_bore)),
    };
    let (section, factors) = match &fillet.factors {
        FactorSource::Given { bending, torsion } => (round, Factors { bending: *bending, radial: 0.0, torsion: *torsion }),
        FactorSource::UnitLoads(_) => return None,
        FactorSource::Formulas(formulas) => {
            let all = Concentration::new(&crank.notch(), *formulas);
            let web = section::web_bending(crank.web_breadth, crank.bearing_web());
            (web, if fillet.place == Place::Journal { all.journal } else { all.crankpin })
        }
    };
    Some(Nominal {
        bending: section * sensitive(factors.bending, radius, false),
        radial: section::web_compression(crank.web_breadth, crank.bearing_web()) * factors.radial,
        torsion: per_torque(crank, fillet.place) * sensitive(factors.torsion, radius, true),
    })
}

/// All locations of a study; nothing where a throw has no shaft beside it.
pub(super) fn locations(chain: &Chain, crank: &Crank, spec: &FatigueSpec) -> Option<Vec<CriticalLocation>> {
    let mut list = Vec::new();
    let by_fillets = spec.criteria.iter().any(|c| !c.is_class_rule());
    let notch = crank.notch();
    let web = section::web_bending(crank.web_breadth, crank.bearing_web());
    let compression = section::web_compression(crank.web_breadth, crank.bearing_web());
    for fillet in spec.fillets.iter().filter(|_| by_fillets) {
        if let FactorSource::UnitLoads(points) = &fillet.factors {
            list.extend(points_of(chain, crank, fillet, points)?);
            continue;
        }
        let own = nominal(crank, spec, fillet)?;
        for throw in fillet.throws(crank) {
            for (rear, shaft) in sides(chain, crank.throws(), throw, fillet.place)? {
                list.push(CriticalLocation {
                    name: fillet.name_of(throw),
                    fillet: fillet.name_of(throw),
                    points: 1,
                    throw,
                    rear,
                    place: fillet.place,
                    shaft,
                    bending: [tension(fillet.place) * own.bending, 0.0],
                    radial: tension(fillet.place) * away(rear) * own.radial,
                    torsion: own.torsion,
                    unit_loads: None,
                    family: Family::Nominal,
                    allowable: None,
                });
            }
        }
    }
    let rules = [(MarginCriterion::IacsM53, Family::Rule), (MarginCriterion::IacsM53Continuous, Family::RuleContinuous)];
    for (_, family) in rules.into_iter().filter(|(c, _)| spec.criteria.contains(c)) {
        let all = Concentration::new(&notch, Formulas::IacsM53);
        let mut places = vec![(Place::Crankpin, all.crankpin, [web, 0.0], crank.pin_diameter, crank.pin_fillet)];
        places.push((Place::Journal, all.journal, [web, 0.0], crank.journal_diameter, crank.journal_fillet));
        if let (Some(factors), Some(bore)) = (all.oil_bore, crank.oil_bore) {
            let pin = section::bending(crank.pin_diameter, crank.pin_bore);
            let planes = [pin * bore.angle.cosine(), pin * bore.angle.sine()];
            places.push((Place::OilBore, factors, planes, crank.pin_diameter, 0.5 * bore.diameter));
        }
        for throw in 0..crank.throws() {
            for (place, factors, nominal, diameter, radius) in &places {
                for (rear, shaft) in sides(chain, crank.throws(), throw, *place)? {
                    list.push(CriticalLocation {
                        name: format!("{}_{}", place.name(), throw + 1),
                        fillet: format!("{}_{}", place.name(), throw + 1),
                        points: 1,
                        throw,
                        rear,
                        place: *place,
                        shaft,
                        bending: nominal.map(|n| tension(*place) * n * factors.bending),
                        radial: tension(*place) * away(rear) * compression * factors.radial,
                        torsion: per_torque(crank, *place) * factors.torsion,
                        unit_loads: None,
                        family,
                        allowable: Some(spec.rule.fatigue_strength(*diameter, *radius, *place == Place::OilBore)),
                    });
                }
            }
        }
    }
    Some(list)
}

/// Critical locations with stresses per unit load: every point on the webs of its fillet.
fn points_of(chain: &Chain, crank: &Crank, fillet: &FilletSpec, points: &[(String, UnitLoads)]) -> Option<Vec<CriticalLocation>> {
    let mut list = Vec::new();
    for throw in fillet.throws(crank) {
        for (rear, shaft) in sides(chain, crank.throws(), throw, fillet.place)? {
            for (point, unit_loads) in points {
                // the table is of a front web; the rear one is its mirror image, in which shear force and torque have the other sign
                let mirrored = |tensor: [f64; 6]| tensor.map(|s| away(rear) * s);
                let unit_loads = UnitLoads { shear: mirrored(unit_loads.shear), torque: mirrored(unit_loads.torque), ..*unit_loads };
                let name = fillet.name_of(throw);
                list.push(CriticalLocation {
                    name: if points.len() == 1 { name.clone() } else { format!("{name}:{point}") },
                    fillet: name,
                    points: points.len(),
                    throw,
                    rear,
                    place: fillet.place,
                    shaft,
                    bending: [0.0; 2],
                    radial: 0.0,
                    torsion: 0.0,
                    unit_loads: Some(unit_loads),
                    family: Family::UnitLoads,
                    allowable: None,
                });
            }
        }
    }
    Some(list)
}
