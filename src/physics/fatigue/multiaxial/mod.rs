//! Multiaxial fatigue: criteria on the stress tensor at a point over one cycle \[Minucci 2010\] chapter 4, after \[Papadopoulos et al. 1997\].
//!
//! Critical-plane criteria ask every plane for its shear amplitude C_a (the radius of the smallest circle round the path of its shear stress) and its largest
//! normal stress N_max; invariant criteria for the amplitude of sqrt(J2) (the radius of the smallest ball round the path of the deviator in five dimensions) and
//! the hydrostatic stress p. The safety factor is what the whole history may be multiplied by.
//!
//! With f the limit in reversed bending, t in reversed torsion, f0 in repeated bending (amplitude):
//!
//! | criterion | n = t over | constants |
//! | --- | --- | --- |
//! | Matake | C_a + k N_max on the plane of the largest C_a | k = 2 t/f - 1 |
//! | McDiarmid | C_a + k N_max on the same plane | k = t/(2 tensile strength): sigma_f of the thesis is not defined there |
//! | Findley | (C_a + k N_max)/sqrt(1 + k²), largest over all planes | k = d/sqrt(f² - d²), d = 2 t - f |
//! | Dang Van, thesis | C_a + k p_max, the largest C_a | k = 3 t/f - 3/2 |
//! | Dang Van, plane | largest over planes and time of distance to the circle's centre + k p | the same |
//! | Dang Van, mesoscopic | largest over time of the Tresca stress of the deviator about the ball's centre + k p | the same |
//! | Sines | sqrt(J2)_a + k p_m | k = 3 t/f0 - sqrt 3 |
//! | Crossland | sqrt(J2)_a + k p_max | k = 3 t/f - sqrt 3: near zero for t = 0.577 f, so that mean stress hardly counts |
//! | Kakuno-Kawada | sqrt(J2)_a + k p_a + l p_m | k of Crossland; l = 3 t/f0 - sqrt 3 as printed; consistent with repeated bending l = 3 t/f0 - 3 t/f |
//! | Papadopoulos | sqrt(5 <T_a²>) + k p_max, T_a over all planes and directions | k = 3 t/f - sqrt 3 |
//! | Carpinteri-Spagnoli | t/f sqrt((N_a + k N_m)² + (f/t)² C_a²) on a plane whose normal is 3/2 (1 - (t/f)²) 45° from the largest principal stress of the cycle | k = f/tensile strength |
//!
//! Out of phase, criteria of the critical plane and of the invariants disagree by up to some ten per cent.
pub mod bound;
mod carpinteri;
pub mod climb;
mod criteria;
pub mod criterion;
pub mod history;
pub mod invariants;
pub mod largest_shear;
pub mod outline;
pub mod papadopoulos;
pub mod plane;
pub mod plane_state;
pub mod search;
pub(crate) use criterion::Shear;
pub use criterion::{Criterion, Limits, Undefined, Verdict, evaluate};
pub use history::History;
pub(crate) use papadopoulos::LoadShares;
pub use plane::Plane;
pub use plane_state::PlaneState;
pub use search::Grid;
