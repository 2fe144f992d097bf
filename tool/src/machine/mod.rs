//! The machine: what its INI file says ([`ini`], [`configuration`]) and what its axes are able to do
//! ([`limits`]).

pub(crate) mod above_joints;
pub(crate) mod angles;
pub(crate) mod configuration;
mod coordinates;
mod error;
mod include;
pub(crate) mod ini;
mod ini_lines;
pub(crate) mod jerk;
pub(crate) mod lathe;
pub(crate) mod length_unit;
#[cfg(feature = "linuxcnc")]
pub(crate) mod limits;
pub(crate) mod numbers;
pub(crate) mod place;
pub(crate) mod text_file;

pub use error::IniError;

/// Tells the user what an INI file does not say and what is taken instead.
pub(crate) fn warn_of<'a>(assumed: impl IntoIterator<Item = &'a String>) {
    for text in assumed {
        crate::output::tell(format_args!("warning: {text}"));
    }
}
