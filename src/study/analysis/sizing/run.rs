//! Sizes, response, front, files and figures of a sizing file.

use super::results::{SizeError, SizingResults};
use super::{figures, files, front, response};
use crate::analysis::progress::Progress;
use crate::input::SizingStudy;
use crate::sizing::size;

/// Sizes, and what follows.
///
/// # Errors
/// [`SizeError`] where there are no dimensions that hold or agree.
pub fn run(study: &SizingStudy, progress: &dyn Progress) -> Result<SizingResults, SizeError> {
    progress.stage("sizes", 1);
    let rigid = size(&study.specification)?;
    progress.step();
    let by_response = study.by_response.then(|| response::agree(study, rigid.clone(), study.absorber, progress)).transpose()?;
    let front = if study.front.is_empty() { Vec::new() } else { front::front(study, &rigid, progress)? };
    let (sized, by_response) = match by_response {
        Some((sized, by_response)) => (sized, Some(by_response)),
        None => (rigid, None),
    };
    // what is written is what `hartog run` takes
    files::study_of(study, sized.last(), study.absorber)?;
    let files = files::files(study, &sized);
    let figures = figures::figures(study, &sized);
    Ok(SizingResults { sized, by_response, front, files, figures })
}
