//! The list of all languages, and what each of them brings along.

use super::control::About;
use super::guess::Evidence;
use super::settings::Settings;
use super::{fagor, fanuc, isg, mefi, sinumerik};
use std::path::Path;

/// What the rest of the tool asks of a language. Lines are in upper case and without blanks at their
/// ends.
pub trait Language: Sync {
    /// Evaluates the part program in file 0 of the sources, which lies at `path`; see
    /// [`super::evaluate`].
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>);

    /// What speaks for this language in the first lines of a program and in the ending of its file, which
    /// is in lower case; see [`super::guess`].
    fn evidence(&self, lines: &[String], extension: &str) -> Evidence;
}

/// Makes the languages known: the module, its name for users, and what it is. The module has a `LANGUAGE`.
macro_rules! languages {
    ($($module:ident $dialect:ident $about:tt;)*) => {
        /// A language of part programs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
        pub enum Dialect {
            $(#[doc = $about] $dialect,)*
            /// Whichever of the others the program seems to be written in.
            Auto,
        }

        impl Dialect {
            /// All languages.
            pub const ALL: &'static [Dialect] = &[$(Dialect::$dialect),*];

            /// The name as it is given on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Dialect::$dialect => stringify!($module),)*
                    Dialect::Auto => "auto",
                }
            }

            /// What it brings along; `None` for a language that is still to be guessed.
            pub fn language(self) -> Option<&'static dyn Language> {
                match self {
                    $(Dialect::$dialect => Some(&$module::LANGUAGE),)*
                    Dialect::Auto => None,
                }
            }
        }
    };
}

languages! {
    sinumerik Sinumerik "Sinumerik-like controls: TRANS, ROT, SCALE, MIRROR, subprograms L10.";
    fagor Fagor "Fagor 8055: G10 to G14, G72, G73, (RPT N10,N20), (CALL 10), P parameters.";
    mefi Mefi "MEFI controls: G34 to G37, subprograms G79 L100, comments after a quotation mark.";
    fanuc Fanuc "Fanuc-like controls: O1234, G65, M98 P1234, IF[#1EQ0]GOTO, G68, G51, G51.1, G68.2.";
    isg Isg "ISG kernels and TwinCAT CNC: G20 to G23, #commands, $IF, subprograms %L NAME.";
}
