//! What the matrices of a structure are found to be, and what of that is unlikely of a free crank along z.

use super::structure::Structure;
use crate::numerics::eigen::of_full_mass;
use crate::numerics::elementary::Elementary;
use crate::numerics::significant::significant;
use nalgebra::{DMatrix, DVector, SymmetricEigen, Vector3};

/// What a structure is found to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Checks {
    /// Largest |K X| over the largest |K| for motions X as a rigid body, lengths in m; where all nodes have a place.
    pub rigid_residual: Option<f64>,
    /// Squares of frequencies that are zero beside the others; where there is a positive definite mass matrix.
    pub rigid_modes: Option<usize>,
    /// Negative eigenvalues of the stiffness, its diagonal scaled to one.
    pub negative: usize,
    /// Whether there is a mass matrix that is not positive definite.
    pub mass_is_wrong: bool,
    /// Mass in x, y and z, kg.
    pub mass: Option<[f64; 3]>,
    /// Centre of mass, m.
    pub centre: Option<Vector3<f64>>,
    /// Inertia about the z axis, kg m².
    pub polar_inertia: Option<f64>,
    /// Elastic frequencies, the lowest first, Hz.
    pub frequencies_hz: Option<Vec<f64>>,
    /// Torsional stiffness of a free structure from the first node that rotates about z to the last one along z, N m/rad.
    pub torsional_stiffness: Option<f64>,
    /// Largest distance between places along an axis, m.
    pub extent: Option<f64>,
}

/// What the chain of an engine has, to hold a structure against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfChain {
    /// kg m².
    pub inertia: f64,
    /// From end to end, N m/rad.
    pub stiffness: f64,
}

/// What is unlikely of a free crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Objection {
    /// Motion as a rigid body meets this share of the largest stiffness.
    HeldSomewhere(f64),
    /// So many rigid modes, not six.
    RigidModes(usize),
    /// So many negative eigenvalues of the stiffness.
    NegativeStiffness(usize),
    /// The mass matrix is not positive definite.
    NegativeMass,
    /// Mass along x, y and z, kg, differs.
    UnequalMass([f64; 3]),
    /// The centre of mass is so far beside the axis, m.
    BesideTheAxis(f64),
    /// The lowest elastic frequency, Hz.
    Slow(f64),
    /// Largest distance between nodes, m.
    Extent(f64),
    /// Inertia about the axis over that of the chain.
    Inertia(f64),
    /// Torsional stiffness over that of the chain.
    TorsionalStiffness(f64),
}

/// An eigenvalue below this share of the first elastic one is that of a rigid motion; one of the scaled stiffness that is negative by less is rounding.
const RIGID: f64 = 1e-6;
/// Rigid motions of a free body.
const FREE: usize = 6;
/// Masses along the axes.
const ALIKE: f64 = 1e-6;

impl Objection {
    /// Largest residual of rigid motions of a free body.
    const RESIDUAL: f64 = 1e-5;
    /// Largest distance of the centre of mass from the axis, m.
    const OFF_AXIS: f64 = 5e-3;
    /// Least elastic frequency, Hz.
    const SLOW: f64 = 10.0;
    /// Distances between nodes, m: cranks of models and of the largest engines.
    const EXTENT: std::ops::RangeInclusive<f64> = 0.03..=40.0;
    /// By what share the inertia may differ from that of a chain.
    #[doc(hidden)]
    pub const INERTIA: f64 = 0.03;
    /// The same of stiffness.
    #[doc(hidden)]
    pub const STIFFNESS: f64 = 0.15;
}

impl std::fmt::Display for Objection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rounded = |x: f64| significant(x, 3);
        let off = |ratio: f64| significant(100.0 * (ratio - 1.0), 3);
        let words: String = match *self {
            Self::NegativeStiffness(n) => format!("its stiffness has {n} negative eigenvalues: it is no structure at rest"),
            Self::NegativeMass => "its mass matrix is not positive definite".into(),
            Self::HeldSomewhere(r) => {
                format!(
                    "motion as a rigid body meets a stiffness of {} of the largest, above {:e}: is it free, are places and units right?",
                    rounded(r),
                    Self::RESIDUAL
                )
            }
            Self::RigidModes(n) => format!("{n} rigid modes, expected six of a free body"),
            Self::UnequalMass(m) => {
                let [x, y, z] = m.map(|m| significant(m, 7));
                format!("its mass is {x}, {y} and {z} kg along x, y and z, expected the same")
            }
            Self::BesideTheAxis(off) => {
                let most = 1e3 * Self::OFF_AXIS;
                format!(
                    "its centre of mass lies {} mm beside the z axis, above {most} mm: is that the axis of the crank (axis)?",
                    rounded(1e3 * off)
                )
            }
            Self::Slow(hz) => {
                format!("its lowest elastic frequency is {} Hz, below {}: are the units right?", rounded(hz), Self::SLOW)
            }
            Self::Extent(m) => {
                let (least, most) = (Self::EXTENT.start(), Self::EXTENT.end());
                format!("its nodes lie within {} m, expected {least} to {most} m: are the units right (units)?", rounded(m))
            }
            Self::Inertia(ratio) if !(0.01..=100.0).contains(&ratio) => {
                format!("its inertia about the axis is {} times that of the chain: are the units right (units)?", rounded(ratio))
            }
            Self::Inertia(ratio) => {
                format!("its inertia about the axis is {} % off that of the chain, above {} %", off(ratio), rounded(100.0 * Self::INERTIA))
            }
            Self::TorsionalStiffness(ratio) => {
                format!("its torsional stiffness is {} % off that of the chain, above {} %", off(ratio), rounded(100.0 * Self::STIFFNESS))
            }
        };
        f.write_str(&words)
    }
}

impl Structure {
    /// What it is found to be.
    pub fn checks(&self) -> Checks {
        let rigid = self.rigid_motions();
        let largest = self.stiffness.amax();
        let rigid_residual = rigid.as_ref().filter(|_| largest > 0.0).map(|x| (&self.stiffness * x).amax() / largest);
        let eigen = self.mass.as_ref().and_then(|m| of_full_mass(&self.stiffness, m)).map(|found| found.0);
        // beside the seventh of a free body, and beside the smallest that is none of rounding where there are fewer
        let zero = |all: &DVector<f64>| {
            let beside = all.iter().copied().find(|s| *s > 1e-12 * all.amax()).unwrap_or(0.0);
            RIGID * beside.max(all.get(FREE).copied().unwrap_or(beside))
        };
        let hz = |s: &f64| s.sqrt() / std::f64::consts::TAU;
        let rigid_modes = eigen.as_ref().map(|all| all.iter().filter(|s| s.abs() < zero(all)).count());
        let frequencies_hz = eigen.as_ref().map(|all| all.iter().filter(|s| **s >= zero(all) && **s > 0.0).map(hz).collect());
        let body = rigid.as_ref().zip(self.mass.as_ref()).map(|(x, m)| x.transpose() * m * x).filter(|b| b[(0, 0)] > 0.0);
        let mass = body.as_ref().map(|b| [0, 1, 2].map(|k| b[(k, k)]));
        // m S(c)' stands beside the translations
        let centre = body.as_ref().zip(mass).map(|(b, m)| Vector3::new(b[(1, 5)], -b[(0, 5)], b[(0, 4)]) / m[0]);
        let is_free = rigid_residual.is_some_and(|r| r <= Objection::RESIDUAL);
        Checks {
            rigid_residual,
            rigid_modes,
            negative: negative(&self.stiffness),
            mass_is_wrong: self.mass.is_some() && eigen.is_none(),
            mass,
            centre,
            polar_inertia: body.as_ref().map(|b| b[(5, 5)]),
            frequencies_hz,
            torsional_stiffness: rigid.as_ref().filter(|_| is_free).and_then(|x| self.torsional_stiffness(x)),
            extent: self.extent(),
        }
    }

    fn extent(&self) -> Option<f64> {
        let along = |k: usize| {
            let all = self.places.values().map(|p| p[k]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            high - low
        };
        (self.places.len() > 1).then(|| (0..3).map(along).fold(0.0, f64::max))
    }

    /// By a unit torque on the last node against the first.
    fn torsional_stiffness(&self, rigid: &DMatrix<f64>) -> Option<f64> {
        let along = |i: usize| self.places.get(&self.unknowns[i].node).map(|p| p.z);
        let about_z = (0..self.unknowns.len()).filter(|i| self.unknowns[*i].component == 6);
        let mut ends: Vec<(f64, usize)> = about_z.filter_map(|i| Some((along(i)?, i))).collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (first, last) = (ends.first()?.1, ends.last()?.1);
        let motion = self.twisted(rigid, (first, last))?;
        let twist = motion[last] - motion[first];
        (first != last && twist.is_finite() && twist > 0.0).then(|| 1.0 / twist)
    }

    /// Static motion of all unknowns under a unit torque on an unknown (by its index) and the opposite one on another, with `rigid` motions. What moves as a rigid body is held softly, which changes nothing of a twist.
    pub(crate) fn twisted(&self, rigid: &DMatrix<f64>, (from, to): (usize, usize)) -> Option<DVector<f64>> {
        // of the six motions those that the unknowns can tell apart
        let eigen = SymmetricEigen::new(rigid.transpose() * rigid);
        let most = eigen.eigenvalues.amax();
        let mut held = self.stiffness.clone();
        for (k, square) in eigen.eigenvalues.iter().enumerate().filter(|e| *e.1 > 1e-9 * most) {
            let motion = rigid * eigen.eigenvectors.column(k) / square.sqrt();
            held += &motion * motion.transpose() * self.stiffness.amax();
        }
        let torque = DVector::from_fn(held.nrows(), |i, _| f64::from(u8::from(i == to)) - f64::from(u8::from(i == from)));
        held.lu().solve(&torque)
    }
}

/// Negative eigenvalues of a matrix whose diagonal is scaled to one: its unknowns have units of their own.
fn negative(stiffness: &DMatrix<f64>) -> usize {
    let scale = |i: usize| if stiffness[(i, i)] == 0.0 { 1.0 } else { stiffness[(i, i)].abs().sqrt() };
    let scaled = DMatrix::from_fn(stiffness.nrows(), stiffness.ncols(), |i, j| stiffness[(i, j)] / (scale(i) * scale(j)));
    scaled.symmetric_eigenvalues().iter().filter(|e| **e < -RIGID).count()
}

impl Checks {
    /// What is unlikely, beside a chain where there is one.
    pub fn objections(&self, chain: Option<OfChain>) -> Vec<Objection> {
        let of_chain = |own: Option<f64>, of: fn(&OfChain) -> f64| Some(own? / of(chain.as_ref()?));
        let frequency = self.frequencies_hz.as_ref().and_then(|f| f.first()).copied();
        let all = [
            (self.negative > 0).then_some(Objection::NegativeStiffness(self.negative)),
            self.mass_is_wrong.then_some(Objection::NegativeMass),
            self.rigid_residual.filter(|r| *r > Objection::RESIDUAL).map(Objection::HeldSomewhere),
            self.rigid_modes.filter(|n| *n != FREE).map(Objection::RigidModes),
            self.mass.filter(|m| m.iter().any(|x| (x / m[0] - 1.0).abs() > ALIKE)).map(Objection::UnequalMass),
            self.centre.map(|p| p.x.hypotenuse(p.y)).filter(|off| *off > Objection::OFF_AXIS).map(Objection::BesideTheAxis),
            frequency.filter(|f| *f < Objection::SLOW).map(Objection::Slow),
            self.extent.filter(|e| !Objection::EXTENT.contains(e)).map(Objection::Extent),
            of_chain(self.polar_inertia, |c| c.inertia).filter(|r| (r - 1.0).abs() > Objection::INERTIA).map(Objection::Inertia),
            of_chain(self.torsional_stiffness, |c| c.stiffness)
                .filter(|r| (r - 1.0).abs() > Objection::STIFFNESS)
                .map(Objection::TorsionalStiffness),
        ];
        all.into_iter().flatten().collect()
    }
}
