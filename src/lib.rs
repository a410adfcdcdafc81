//! Design of torsional vibration absorbers for engine crankshafts.
//!
//! ```
//! use hartog::Study;
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let results = Study::read("studies/den_hartog.toml")?.run()?;
//!     let best = &results.optima[0];
//!     println!("{}: {:.6}°", best.design.name, best.optimum.value().to_degrees());
//!     Ok(())
//! }
//! ```
//!
//! It prints the number that `hartog run studies/den_hartog.toml` prints. Three longer programs stand in `studies/examples`: one evaluates a design,
//! one optimises two absorbers together, one brings an absorber law of its own.
//!
//! # Model
//!
//! A crankshaft with flywheel, pulley and absorber is a chain of rigid inertias joined by shafts. Its angles theta (about uniform
//! rotation) obey
//!
//! ```text
//! J theta'' + C theta' + K theta = T(t)
//! ```
//!
//! with diagonal J (kg m²), tridiagonal C (N m s/rad) and K (N m/rad; hysteretic shafts have k (1 + i eta)), and the torque T (N m) that gas
//! and moving masses put on each throw. At constant speed the torque is periodic in the working cycle (one revolution for two strokes,
//! two for four), so each **order** n (events per revolution, in halves for four strokes) can be solved by itself.
//!
//! | symbol | meaning | unit |
//! | --- | --- | --- |
//! | Omega | speed of the crankshaft | rad/s (`speed_rpm`: rpm) |
//! | omega = n Omega | circular frequency of order n | rad/s |
//! | theta | angle of a station; crank angle where the engine is meant | rad |
//! | J, k, c | inertia, stiffness, damping | kg m², N m/rad, N m s/rad |
//! | S = k + i omega c | complex stiffness of a link | N m/rad |
//! | z(omega) | dynamic stiffness an absorber adds to its station | N m/rad |
//! | H(omega) | receptance: angle per unit torque at a station | rad/(N m) |
//! | mu | ring inertia over engine inertia | 1 |
//!
//! **Phasors.** Y stands for Re(Y e^{i omega t}); magnitudes are zero to peak. Crank angle zero is the firing dead centre of the cylinder that
//! fires at 0°; angles, torques and twists are positive in the direction of rotation.
//!
//! **Peak of a sum.** "Half peak-to-peak" is (largest - smallest)/2 over the cycle of the sum of all orders with their phases. Order zero,
//! the mean torque, is left out: it turns the whole engine.
//!
//! **Damping ratios** are named by what they divide by: `c/(2 J omega_absorber)` or `c/(2 J omega_engine)`, see [`absorber::closed_forms`].
//!
//! # Map
//!
//! A row imports only from rows above it (a test proves that).
//!
//! | module | holds |
//! | --- | --- |
//! | [`units`] | every conversion factor |
//! | [`numerics`] | physics-free mathematics |
//! | [`engine`] | kinematics, pressure, forces, orders, layout: the torque harmonics of a throw |
//! | [`absorber`] | one file a type: its law, derivatives, parameters and closed-form optima; absorbers on stations and on each other |
//! | [`drivetrain`] | stations and shafts, their modes, natural frequencies with absorbers |
//! | [`response`] | response methods, one file each, in frequency and in time; power |
//! | [`fatigue`] | criteria of mean stress (Goodman and others), endurance factors, class rules, multiaxial criteria |
//! | [`crankshaft`] | the crank as a beam on its bearings, stress concentration, critical locations and their margins |
//! | [`sizing`] | piston pin, connecting rod and crank from operating data; the rounds that make them agree |
//! | [`objective`] | measures, conditions, the search of peaks over speed with their gradients, surrogates for searches |
//! | [`optimise`] | problem, variables, starts, gradient-free search, minimax, front |
//! | [`input`] | schema, validation (where a TOML key is checked), tables, errors: the only place that reads files |
//! | [`analysis`] | a whole study: calibrate, evaluate, optimise, margins |
//! | [`benchmark`] | what `hartog chart` measures: speed against accuracy, growth, energy, stability |
//! | [`validation`] | what `hartog compare` does: published tables, formulas that only their sources use |
//! | [`report`] | text, tables and plots: the only place that writes files |
//! | [`cli`] | one file a command |
//!
//! # References
//!
//! - \[Akl & Toussaint 1978\] S. G. Akl, G. T. Toussaint, A fast convex hull algorithm, *Inf. Process. Lett.* 7, 219.
//! - \[Andrew 1979\] A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, *Inf. Process. Lett.* 9, 216.
//! - \[Asami 2017\] T. Asami, Optimal design of double-mass dynamic vibration absorbers arranged in series or in parallel, *J. Vib. Acoust.* 139,
//!   011015.
//! - \[Al-Mohy & Higham 2009\] A. H. Al-Mohy, N. J. Higham, A new scaling and squaring algorithm for the matrix exponential, *SIAM J. Matrix Anal. Appl.* 31, 970.
//! - \[Badoiu & Clarkson 2003\] M. Badoiu, K. L. Clarkson, Smaller core-sets for balls, *Proc. 14th ACM-SIAM Symp. Discrete Algorithms*, 801.
//! - \[Bhandari 2010\] V. B. Bhandari, *Design of Machine Elements*, 3rd ed., chapter 25.
//! - \[Chmielowiec 2021\] A. Chmielowiec, S. Woś, J. Gumieniak, Viscosity approximation of PDMS using Weibull function, *Materials* 14(20), 6060.
//! - \[Brent 1973\] R. P. Brent, *Algorithms for Minimization without Derivatives*, chapter 5.
//! - \[Brock 1946\] J. E. Brock, A note on the damped vibration absorber, *J. Appl. Mech.* 13, A-284.
//! - \[Den Hartog 1956\] J. P. Den Hartog, *Mechanical Vibrations*, 4th ed., chapters 3, 5 and 8.
//! - \[Cameron & Griffin 1989\] T. M. Cameron, J. H. Griffin, An alternating frequency/time domain method for calculating the steady-state response of
//!   nonlinear dynamic systems, *J. Appl. Mech.* 56, 149.
//! - \[Denman 1992\] H. H. Denman, Tautochronic bifilar pendulum torsion absorbers for reciprocating engines, *J. Sound Vib.* 159, 251.
//! - \[Dennis, Gay & Welsch 1981\] J. E. Dennis, D. M. Gay, R. E. Welsch, An adaptive nonlinear least-squares algorithm, *ACM Trans. Math.
//!   Softw.* 7, 348.
//! - \[Dang Van 1989\] K. Dang Van, B. Griveau, O. Message, On a new multiaxial fatigue limit criterion, *EGF Publ.* 3, 479.
//! - \[Douglas & Peucker 1973\] D. H. Douglas, T. K. Peucker, Algorithms for the reduction of the number of points required to represent a digitized line or
//!   its caricature, *Cartographica* 10, 112.
//! - \[Gärtner 1999\] B. Gärtner, Fast and robust smallest enclosing balls, *Proc. 7th ESA*, LNCS 1643, 325.
//! - \[Golub & Van Loan 2013\] G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th ed.
//! - \[Heywood 1988\] J. B. Heywood, *Internal Combustion Engine Fundamentals*.
//! - \[IACS UR M53\] International Association of Classification Societies, Unified Requirement M53, *Calculations for I.C. Engine
//!   Crankshafts*, Rev. 2, 2011.
//! - \[Nelder & Mead 1965\] J. A. Nelder, R. Mead, A simplex method for function minimization, *Computer J.* 7, 308.
//! - \[Newmark 1959\] N. M. Newmark, A method of computation for structural dynamics, *J. Eng. Mech. Div. ASCE* 85, EM3, 67.
//! - \[Nishihara & Asami 2002\] O. Nishihara, T. Asami, Closed-form solutions to the exact optimizations of dynamic vibration absorbers,
//!   *J. Vib. Acoust.* 124, 576.
//! - \[Nocedal & Wright 2006\] J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd ed.
//! - \[Friswell et al. 2010\] M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, *Dynamics of Rotating Machines*, chapter 9.
//! - \[Higham 2005\] N. J. Higham, The scaling and squaring method for the matrix exponential revisited, *SIAM J. Matrix Anal. Appl.* 26, 1179.
//! - \[Keller 1977\] H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems, in *Applications of Bifurcation Theory*.
//! - \[Ker Wilson 1956\] W. Ker Wilson, *Practical Solution of Torsional Vibration Problems*, 3rd ed., vol. 1.
//! - \[Kraus 1984\] G. Kraus, Mechanical losses in carbon-black-filled rubbers, *J. Appl. Polym. Sci.: Appl. Polym. Symp.* 39, 75.
//! - \[Lindley 1978\] P. B. Lindley, *Engineering Design with Natural Rubber*, 4th ed., table of hardness and moduli.
//! - \[Nestorides 1958\] E. J. Nestorides, *A Handbook on Torsional Vibration*, BICERA, chapter 2.
//! - \[Pasricha & Carnegie 1976\] M. S. Pasricha, W. D. Carnegie, Effects of variable inertia on the damped torsional vibrations of diesel engine
//!   systems, *J. Sound Vib.* 46, 339.
//! - \[Fialho & Almeida 2019\] the thesis behind slider-crank sizing: endurance factors, notch sensitivity, sections of pin, rod and crank.
//! - \[Norton 2013\] R. L. Norton, *Machine Design*, 4th ed., chapters 6 and 10, appendix C.
//! - \[Shigley 2004\] J. E. Shigley, C. R. Mischke, R. G. Budynas, *Mechanical Engineering Design*, 7th ed., section 6-12.
//! - \[Minucci 2010\] the dissertation on multiaxial fatigue of crankshafts, chapter 4.
//! - \[Papadopoulos et al. 1997\] I. V. Papadopoulos, P. Davoli, C. Gorla, M. Filippini, A. Bernasconi, A comparative study of multiaxial high-cycle
//!   fatigue criteria for metals, *Int. J. Fatigue* 19, 219.
//! - \[Trefethen 2013\] L. N. Trefethen, *Approximation Theory and Approximation Practice*, chapter 8.
//! - \[Titterington 1978\] D. M. Titterington, Estimation of correlation coefficients by ellipsoidal trimming, *Applied Statistics* 27, 227.
//! - \[Timoshenko 1956\] S. Timoshenko, *Strength of Materials*, part I, 3rd ed., chapter 12.
//! - \[Villalva 2014\] the dissertation behind CrankLab, chapters 3 to 6: geometry, chains, absorbers and tables of the shipped engines.

#![deny(missing_docs)]

pub mod absorber;
pub mod analysis;
pub mod benchmark;
pub mod cli;
pub mod crankshaft;
pub mod drivetrain;
pub mod engine;
pub mod fatigue;
pub mod input;
pub mod numerics;
pub mod objective;
pub mod optimise;
pub mod report;
pub mod response;
pub mod sizing;
pub mod units;
pub mod validation;

pub use analysis::{Results, RunError};
pub use input::{InputError, Study};
