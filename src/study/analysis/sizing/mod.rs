//! What `hartog size` does: sizes, the chain and study that follow from them, the crank by the response of its chain, and how light an absorber lets it be.

mod figures;
mod files;
mod front;
mod response;
mod results;
mod run;

pub use figures::front_figure;
pub use results::{ByResponse, FrontPoint, SizeError, SizingResults, StudyFiles, crank_mass};
pub use run::run;
