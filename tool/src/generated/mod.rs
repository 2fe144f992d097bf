//! Programs that show what a planner does, the same every time.
//!
//! [`text`] writes G-code; the programs are in [`corners`] (legs and squares), [`dense`] (runs of
//! short lines), [`random_shapes`] (random lines and arcs), [`more_axes`] (rotary axes, U V W) and
//! [`alternating`] (feeds and path modes in turn).

mod alternating;
mod corners;
mod dense;
mod more_axes;
pub(crate) mod random;
mod random_shapes;
mod text;

/// A program that can be generated.
pub(crate) struct Generator {
    pub name: &'static str,
    /// What it is, for a list.
    pub about: &'static str,
    pub write: fn(&Options) -> String,
}

/// How a program is to be made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    pub seed: u64,
    /// G64 P, mm; each program has its own otherwise.
    pub tolerance: Option<f64>,
    /// F, mm/min.
    pub feed: f64,
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

/// How many of them `all` means.
const COMPARED: usize = 15;

/// Those that `all` means, and behind them two in which LinuxCNC's planner is no measure, since it leaves
/// the feed, or a G61 line, and one for the joints of a table.
pub(crate) const GENERATORS: [Generator; COMPARED + 3] = [
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
    Generator {
        name: "alternating-feeds",
        about: "200 lines of 2 mm, every other one with a quarter of the feed, P .05",
        write: alternating::feeds,
    },
    Generator {
        name: "alternating-modes",
        about: "200 lines of 2 mm in G64 P .05 and in G61 in turn",
        write: alternating::modes,
    },
    Generator {
        name: "random-five-axes",
        about: "300 random lines of X Y Z A C; lengths, turns, tilts and P (.01 to .1) by the seed",
        write: more_axes::random_five_axes,
    },
];

/// The names of all programs.
pub fn names() -> Vec<&'static str> {
    GENERATORS.iter().map(|generator| generator.name).collect()
}

/// The names of those that `all` means.
pub fn compared() -> Vec<&'static str> {
    names().into_iter().take(COMPARED).collect()
}

/// A program with its own settings; `None` if there is none of this name.
pub fn program(name: &str) -> Option<String> {
    Some((find(name)?.write)(&Options::DEFAULT))
}

/// The program of this name.
pub(crate) fn find(name: &str) -> Option<&'static Generator> {
    GENERATORS.iter().find(|generator| generator.name == name)
}
