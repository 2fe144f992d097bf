//! What blendtp, framekins and frame_guard need in the INI and HAL files of a machine, line by line: `check` looks
//! for it, `configure` writes it.

pub mod abort;
pub mod blendtp;
pub mod codes;
pub mod comments;
pub mod framekins;
pub mod installed;
#[cfg(feature = "linuxcnc")]
pub mod joints;
pub mod outputs_line;
pub mod own_files;
pub mod previews;
#[cfg(feature = "linuxcnc")]
pub mod same_series;
pub mod screens;
pub mod settings;
pub mod subject;
pub mod subroutine_files;
pub mod told_the_tool;
pub mod turning_axes;
#[cfg(feature = "linuxcnc")]
pub mod user_codes;

/// A jerk limit for a start: so many accelerations in a second, as in the samples.
pub const USUAL_JERK: f64 = 20.0;
