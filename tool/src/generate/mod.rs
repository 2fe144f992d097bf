//! `framepath generate`: programs that show what a planner does, the same every time.
//!
//! [`text`] writes G-code; the programs are in [`corners`] (legs and squares), [`dense`] (runs of
//! short lines), [`random_shapes`] (random lines and arcs) and [`more_axes`] (rotary axes, U V W).

mod corners;
mod dense;
mod more_axes;
pub(crate) mod random;
mod random_shapes;
mod text;

use crate::arguments::{not_negative, positive};
use std::io::Write;

/// A program that can be generated.
struct Generator {
    name: &'static str,
    about: &'static str,
    write: fn(&Options) -> String,
}

/// How a program is to be made.
#[derive(Clone, Copy, Debug)]
struct Options {
    seed: u64,
    /// G64 P, mm; each program has its own otherwise.
    tolerance: Option<f64>,
    /// F, mm/min.
    feed: f64,
}

impl Options {
    const DEFAULT: Options = Options {
        seed: 1,
        tolerance: None,
        feed: 6000.0,
    };

    fn tolerance_or(&self, own: f64) -> f64 {
        self.tolerance.unwrap_or(own)
    }
}

const GENERATORS: [Generator; 15] = [
    Generator {
        name: "zigzag",
        about: "200 legs of 1 mm that turn by 90 degrees to and fro, P .05",
        write: corners::zigzag,
    },
    Generator {
        name: "squares-p.005",
        about: "15 squares with legs of 5 mm, P .005",
        write: |options| corners::squares(options, 0.005),
    },
    Generator {
        name: "squares-p.05",
        about: "the same with P .05",
        write: |options| corners::squares(options, 0.05),
    },
    Generator {
        name: "squares-p.5",
        about: "the same with P .5",
        write: |options| corners::squares(options, 0.5),
    },
    Generator {
        name: "dense",
        about: "a contour of 10,000 lines of .018 mm, rounded to 4 decimals, no P",
        write: dense::contour,
    },
    Generator {
        name: "spiral",
        about: "a spiral of lines, P .05",
        write: dense::spiral,
    },
    Generator {
        name: "trochoidal",
        about: "advancing loops of 3000 lines, P .01",
        write: dense::trochoidal,
    },
    Generator {
        name: "polyline",
        about: "300 random lines in space from .003 to 20 mm with turns to 180 degrees, P .01",
        write: random_shapes::polyline,
    },
    Generator {
        name: "arcs",
        about: "300 arcs and helices of all radii in G17, G18 and G19 that meet at all angles, P .01",
        write: random_shapes::arcs,
    },
    Generator {
        name: "wrapped",
        about: "a drawing wrapped around A in short lines, P .02",
        write: more_axes::wrapped,
    },
    Generator {
        name: "zigzag-4-axis",
        about: "moves of X and of A in turn, P .02",
        write: more_axes::zigzag,
    },
    Generator {
        name: "blade",
        about: "a blade in short lines of X Y Z A C, P .02",
        write: more_axes::blade,
    },
    Generator {
        name: "abc",
        about: "moves of A B C only, in inches, no P",
        write: more_axes::rotary_only,
    },
    Generator {
        name: "uvw",
        about: "a tapered contour of X Y U V W in short lines, P .02",
        write: more_axes::uvw,
    },
    Generator {
        name: "nine-axes",
        about: "a wavy contour in short lines in which all nine axes move, P .02",
        write: more_axes::nine_axes,
    },
];

/// The names of all programs.
pub fn names() -> Vec<&'static str> {
    GENERATORS.iter().map(|generator| generator.name).collect()
}

/// A program with its own settings; `None` if there is none of this name.
pub fn program(name: &str) -> Option<String> {
    let generator = GENERATORS.iter().find(|generator| generator.name == name)?;
    Some((generator.write)(&Options::DEFAULT))
}

/// Arguments of `framepath generate`.
#[derive(Clone, Debug, clap::Args)]
pub struct GenerateArguments {
    /// Name of the program; without it all are listed
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// Other random numbers, where there are some
    #[arg(long, value_name = "SEED", default_value = "1")]
    pub seed: u64,
    /// G64 P in place of the program's own; 0 for a G64 without P
    #[arg(long, value_name = "MM", value_parser = not_negative)]
    pub tolerance: Option<f64>,
    /// F
    #[arg(long, value_name = "MM_MIN", default_value = "6000", value_parser = positive)]
    pub feed: f64,
}

/// Why no program was generated.
#[derive(Debug, thiserror::Error)]
pub enum GenerateError {
    /// No program has this name.
    #[error("{name}: there is no such program; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// All names.
        known: String,
    },
    /// Standard output cannot be written.
    #[error("the program cannot be written: {0}")]
    Write(std::io::Error),
}

/// Prints a program, or the list of all.
///
/// # Errors
/// A name that is not known, an output that cannot be written.
pub fn run(arguments: &GenerateArguments) -> Result<(), GenerateError> {
    let text = match &arguments.name {
        None => {
            let width = names().iter().map(|name| name.len()).max().unwrap_or(0);
            let line = |g: &Generator| format!("{:<width$}  {}\n", g.name, g.about);
            GENERATORS.iter().map(line).collect()
        }
        Some(name) => {
            let options = Options {
                seed: arguments.seed,
                tolerance: arguments.tolerance,
                feed: arguments.feed,
            };
            let generator = GENERATORS.iter().find(|generator| generator.name == name);
            let generator = generator.ok_or_else(|| GenerateError::Unknown {
                name: name.clone(),
                known: names().join(", "),
            })?;
            (generator.write)(&options)
        }
    };
    std::io::stdout()
        .lock()
        .write_all(text.as_bytes())
        .map_err(GenerateError::Write)
}
