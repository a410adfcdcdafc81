//! Derivatives of the twist of a ring with respect to the parameters of an absorber.
//!
//! With dynamic stiffnesses S of the laws, a change of absorber i acts like torques: dS phi_i across it, and -omega² dJ psi_i on its ring (phi: twist,
//! psi: angle). By reciprocity the twist of ring a changes by
//! d phi_a = -(dS lambda_i phi_i - omega² dJ mu_i psi_i),
//! with lambda and mu the twists and angles under a unit pair of torques, on ring a and back on what carries it.

use super::factored::Factored;
use super::{Direct, ResponseError, Work};
use crate::absorber::mounted::station_of;
use crate::absorber::{Host, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};

/// Rings of the absorbers on one station, at one frequency: all above it, however they carry each other.
struct Rings {
    /// Absorbers.
    members: Vec<usize>,
    /// Dynamic stiffness matrix of their angles.
    matrix: DMatrix<C64>,
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
                    matrix[(host, host)] += s - at.omega * at.omega * design[i].hub_inertia;
                }
            }
        }
        Some(Self { members, matrix, by_station })
    }

    /// Angles of the rings under an angle of the station and torques on them.
    fn angles(&self, station: C64, torques: &DVector<C64>) -> Option<DVector<C64>> {
        self.matrix.clone().lu().solve(&(&self.by_station * station + torques))
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
    /// Derivatives of the phasors of the twist of ring `of` at one speed with respect to the parameters of absorber `index` (ring inertia first), for each of the
    /// given orders.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance; [`ResponseError::NotApplicable`] for locked rings.
    pub(super) fn sensitivity_of_ring(
        &self,
        design: &[Mounted],
        (index, of): (usize, usize),
        orders: std::ops::Range<usize>,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        let mut solver = Factored::new(self.system);
        let (here, there) = (station_of(design, index), station_of(design, of));
        orders
            .map(|order| {
                solver.solve(design, (order, speed_rpm), work)?;
                let at = Operating { omega: solver.omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
                let found = self.ring_changes(design, (index, of), (here, there), &mut solver, at);
                found.ok_or(ResponseError::NotApplicable { method: "direct", why: "a locked ring has no twist" })
            })
            .collect()
    }

    /// The derivatives at one order, the system being solved for its torque.
    fn ring_changes(
        &self,
        design: &[Mounted],
        (index, of): (usize, usize),
        (here, there): (usize, usize),
        solver: &mut Factored,
        at: Operating,
    ) -> Option<Vec<C64>> {
        let (own, other) = (Rings::new(design, here, at)?, Rings::new(design, there, at)?);
        let still = |rings: &Rings| DVector::from_element(rings.members.len(), ZERO);
        let station = solver.angle(here, &solver.x);
        let (twist, angle) = own.of(design, index, station, &own.angles(station, &still(&own))?)?;
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
        solver.matrix.solve(&mut unit);
        let adjoint = solver.angle(here, &unit);
        let mut angles = own.angles(adjoint, &still(&own))?;
        if here == there {
            angles += held;
        }
        let (lambda, mu) = own.of(design, index, adjoint, &angles)?;
        let law = design[index].absorber.law()?;
        let mut list: Vec<C64> = law.derivatives(at).into_iter().map(|d| -d * lambda * twist).collect();
        list[0] += mu * angle * (at.omega * at.omega);
        list.iter().all(|d| d.is_finite()).then_some(list)
    }
}
