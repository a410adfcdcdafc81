//! Torsional vibration absorbers: a ring tied to a hub by a law. One file a type.

pub mod closed_forms;
pub mod condensed;
pub mod dynamic_stiffness;
pub mod law;
pub mod mounted;
pub mod parameter;
pub mod rubber;
pub mod tuned;
pub mod types;
pub mod undamped;
pub mod viscous;

pub(crate) use condensed::Condensed;
pub use dynamic_stiffness::{Operating, SpringAndDamper};
pub use law::{ClosedForm, Declaration, Law};
pub use mounted::{Absorber, Host, Mounted};
pub use parameter::{Parameter, Range, Surroundings};
pub use rubber::{RUBBER, Rubber};
pub use tuned::{TUNED, Tuned};
pub use types::TYPES;
pub use undamped::{UNDAMPED, Undamped};
pub use viscous::{VISCOUS, Viscous};
