//! Whether LinuxCNC, and a module of it, are of the series that this command is built for: interpreter and planners of
//! another one are called otherwise, and nothing but a crash or senseless numbers would tell.

use super::installed::{LinuxCnc, built_for, series};
use std::path::{Path, PathBuf};

/// The version of the LinuxCNC whose headers the build script has read; empty where it found none.
const BUILT_FOR: &str = env!("FRAMEPATH_BUILT_FOR");

/// The modules of the LinuxCNC whose interpreter this command runs.
const MODULES: &str = env!("LINUXCNC_MODULES");

/// What this command would call, and call otherwise than it wants to be called.
#[derive(Debug, thiserror::Error)]
pub enum OtherSeries {
    /// The LinuxCNC that is there now.
    #[error(
        "this framepath is built for LinuxCNC {BUILT_FOR}, and {0} is installed: in framepath's sources: make install again"
    )]
    Installed(String),
    /// A planner module.
    #[error(
        "{}: it belongs to LinuxCNC {version}, and this framepath is built for {BUILT_FOR}: name a module for that one, or in \
         framepath's sources: make install again",
        file.display()
    )]
    Module {
        /// Its file.
        file: PathBuf,
        /// The version that it is of, or built for.
        version: String,
    },
}

/// Looks at the LinuxCNC whose interpreter this command runs.
///
/// # Errors
/// One of another series than that of its headers when this was built.
pub fn check_installed() -> Result<(), OtherSeries> {
    match LinuxCnc::of_modules(Path::new(MODULES)) {
        Some(found) if is_other(&found.version) => Err(OtherSeries::Installed(found.version)),
        _ => Ok(()),
    }
}

/// Looks at a planner module: one of ours says what it is built for, others belong to the LinuxCNC in whose folder they are.
///
/// # Errors
/// One of another series. Where nothing is known of it there is none.
pub fn check_module(file: &Path) -> Result<(), OtherSeries> {
    // A file that cannot be read is told of where it is loaded.
    let said = built_for(file).ok().flatten();
    let version = said.or_else(|| Some(LinuxCnc::of_modules(file.parent()?)?.version));
    match version {
        Some(version) if is_other(&version) => Err(OtherSeries::Module {
            file: file.to_owned(),
            version,
        }),
        _ => Ok(()),
    }
}

/// Whether both versions are known and of different series.
fn is_other(version: &str) -> bool {
    match (series(BUILT_FOR), series(version)) {
        (Some(needed), Some(found)) => needed != found,
        _ => false,
    }
}
