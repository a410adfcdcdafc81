//! Files that are there as a whole or not at all.

use super::error::CampaignError;
use crate::files::WriteError;
use crate::reason::reason;
use std::io::Write;
use std::path::Path;

/// What names of unfinished files begin with.
pub(super) const UNFINISHED: &str = ".hartog-campaign-";

/// Writes a file under a temporary name in its folder, which is made where it is missing, and renames it.
///
/// # Errors
/// [`CampaignError::File`] where that fails.
pub(super) fn write(path: &Path, content: &[u8]) -> Result<(), CampaignError> {
    let failed = |e: std::io::Error| CampaignError::File(WriteError { path: path.to_path_buf(), reason: reason(&e) });
    let folder = path.parent().unwrap_or_else(|| Path::new("."));
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // less what the mask of the process takes away
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    file.write_all(content).and_then(|()| file.as_file().sync_all()).map_err(failed)?;
    file.persist(path).map_err(|e| failed(e.error))?;
    Ok(())
}
