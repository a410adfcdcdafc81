//! Derivatives of the twist of a ring with respect to the parameters of an absorber.
//!
//! With dynamic stiffnesses S of the laws, a change of absorber i acts like torques: dS phi_i across it, and -omega² dJ psi_i on its ring (phi: twist,
//! psi: angle). By reciprocity the twist of ring a changes by
//! d phi_a = -(dS lambda_i phi_i - omega² dJ mu_i psi_i),
//! with lambda and mu the twists and angles under a unit pair of torques, on ring a and back on what carries it.

use super::Direct;
use super::factored::Factored;
use crate::absorber::construction::hub_derivatives;
use crate::absorber::mounted::station_of;
use crate::absorber::{Host, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Rings of the absorbers on one station, at one frequency: all above it, however they carry each other.
struct Rings {
    /// Absorbers.
    members: Vec<usize>,
    /// Dynamic stiffness matrix of their angles, factored.
    matrix: LU<C64, Dyn, Dyn>,
    /// What the angle of the station puts on each.
    by_station: DVector<C64>,
}

impl Rings {
    /// Nothing where a ring is locked: its twist is no unknown.
    fn new(design: &[Mounted], station: usize, at: Operating) -> Option<Self> {
        let members: Vec<usize> = (0..design.len()).filter(|i| station_of(design, *i) == station).collect();
        let place = |i: usize| members.iter().position(|m| *m == i);
        let mut matrix = DMatrix::from_element(members.len(), members.len(), ZERO);
        let mut by_station = DVector::from_element(members.len(), ZERO);
        for (row, &i) in members.iter().enumerate() {
            let law = design[i].absorber.law()?;
            let s = law.dynamic_stiffness(at);
            matrix[(row, row)] += s - at.omega * at.omega * law.ring_inertia();
            match design[i].on {
                Host::Station(_) => by_station[row] = s,
                Host::Ring(inner) => {
                    let host = place(inner)?;
                    matrix[(row, host)] -= s;
                    matrix[(host, row)] -= s;
                    matrix[(host, host)] += s - at.omega * at.omega * design[i].hub();
                }
            }
        }
        Some(Self { members, matrix: matrix.lu(), by_station })
    }

    /// Angles of the rings under an angle of the station and torques on them.
    fn angles(&self, station: C64, torques: &DVector<C64>) -> Option<DVector<C64>> {
        self.matrix.solve(&(&self.by_station * station + torques))
    }

    /// Twist and angle of an absorber's ring.
    fn of(&self, design: &[Mounted], index: usize, station: C64, angles: &DVector<C64>) -> Option<(C64, C64)> {
        let place = |i: usize| self.members.iter().position(|m| *m == i);
        let own = angles[place(index)?];
        let host = match design[index].on {
            Host::Station(_) => station,
            Host::Ring(inner) => angles[place(inner)?],
        };
        Some((own - host, own))
    }
}

impl Direct<'_> {
    /// Derivatives of the twist of ring `of` at one order with respect to the parameters of some absorbers (ring inertia first), the system being solved for its torque; each is given to `put` with its place
    /// in the list. Nothing where a ring is locked.
    pub(super) fn ring_changes(
        &self,
        design: &[Mounted],
        (absorbers, of): (&[usize], usize),
        solver: &mut Factored,
        at: Operating,
        put: &mut dyn FnMut(usize, Vec<C64>),
    ) -> Option<()> {
        let there = station_of(design, of);
        let other = Rings::new(design, there, at)?;
        let still = |rings: &Rings| DVector::from_element(rings.members.len(), ZERO);
        // the pair of torques on ring `of` and on what carries it, passed on to the station
        let place = |i: usize| other.members.iter().position(|m| *m == i);
        let mut pair = still(&other);
        pair[place(of)?] += 1.0;
        let mut on_station = match design[of].on {
            Host::Station(_) => -C64::from(1.0),
            Host::Ring(inner) => {
                pair[place(inner)?] -= 1.0;
                ZERO
            }
        };
        let held = other.angles(ZERO, &pair)?;
        on_station += other.by_station.iter().zip(held.iter()).map(|(s, a)| s * a).sum::<C64>();
        let mut unit = vec![ZERO; self.system.chain.len()];
        unit[there] = on_station;
        let unit = solver.under(&unit);
        let mut moved: Option<Moved> = None;
        for (i, &index) in absorbers.iter().enumerate() {
            let here = station_of(design, index);
            if moved.as_ref().is_none_or(|m| m.station != here) {
                let own = Rings::new(design, here, at)?;
                let (under, adjoint) = (solver.angle(here, &solver.x), solver.angle(here, &unit));
                let mut by_pair = own.angles(adjoint, &still(&own))?;
                if here == there {
                    by_pair += &held;
                }
                moved = Some(Moved { station: here, under: (under, own.angles(under, &still(&own))?), by_pair: (adjoint, by_pair), own });
            }
            let Moved { own, under, by_pair, .. } = moved.as_ref()?;
            let (twist, angle) = own.of(design, index, under.0, &under.1)?;
            let (lambda, mu) = own.of(design, index, by_pair.0, &by_pair.1)?;
            let law = design[index].absorber.law()?;
            let mut list: Vec<C64> = law.derivatives(at).into_iter().map(|d| -d * lambda * twist).collect();
            list[0] += mu * angle * (at.omega * at.omega);
            // a housing moves as what carries it
            let hub = (mu - lambda) * (angle - twist) * (at.omega * at.omega);
            list.iter_mut().zip(hub_derivatives(law.as_ref())).for_each(|(d, by)| *d += hub * by);
            if !list.iter().all(|d| d.is_finite()) {
                return None;
            }
            put(i, list);
        }
        Some(())
    }
}

/// Rings on a station, with its angle and theirs: under the torque, and under the pair on the ring whose twist is asked for.
struct Moved {
    station: usize,
    own: Rings,
    under: (C64, DVector<C64>),
    by_pair: (C64, DVector<C64>),
}
