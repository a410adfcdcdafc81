//! Steady torsional response: phasors of any quantity, per order, over speed.
//!
//! Every method offers the same verbs ([`Response`]). Phasors of a sweep lie speed by speed, the orders of a speed together.

#[doc(hidden)]
pub mod about_frequency;
mod batch;
pub mod bodies;
pub mod closed_form;
pub mod dense;
pub mod direct;
#[doc(hidden)]
pub mod enclosed;
pub mod error;
pub mod exponential;
pub(crate) mod factored;
mod flexible_point;
pub mod grid;
pub mod holzer;
mod host_receptance;
pub mod joint;
mod joint_lanes;
mod kernel;
mod known_points;
mod lane;
pub mod large_twist;
pub mod method;
pub mod method_enum;
pub mod modal;
pub mod newmark;
pub mod operation;
mod output;
#[doc(hidden)]
pub mod pair;
pub mod periodic;
pub mod power;
pub mod quantity;
pub mod quasi_static;
pub mod receptance;
pub mod reduced;
mod ring_sensitivity;
mod shaft_torques;
#[doc(hidden)]
pub mod tangent;
pub mod work;

pub use closed_form::ClosedForm;
pub use dense::Dense;
pub use direct::Direct;
pub use error::ResponseError;
pub use exponential::Exponential;
pub use grid::Grid;
pub use holzer::Holzer;
pub use host_receptance::Hosts;
pub(crate) use host_receptance::single;
pub use joint::JointReceptance;
pub use method::Response;
pub use method_enum::Method;
pub use modal::Modal;
pub use newmark::Newmark;
pub use quantity::{Quantity, Rate};
pub use quasi_static::{Unamplified, quasi_static};
pub use receptance::Receptance;
pub use reduced::Reduced;
pub use work::Work;
