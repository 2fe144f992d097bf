//! Programs written as `reader.rs` reads them.

use std::fmt::{Display, Formatter, Result};

use framepath::axes::Axes;
use framepath::moves::{MotionType, TerminationCondition};

use super::reader::LETTERS;
use super::{ALL_ENABLED, Asked, Event, FEED_OVERRIDE_OFF, Program, Programmed, RestsAsked, Shape};

impl Display for Program {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(f, "velocity {}", Each(&self.limits.velocity))?;
        writeln!(f, "acceleration {}", Each(&self.limits.acceleration))?;
        writeln!(f, "jerk {}", Each(&self.limits.jerk))?;
        writeln!(f, "max_velocity {:?}", self.max_velocity)?;
        if let Some(velocity) = self.slider {
            writeln!(f, "slider {velocity:?}")?;
        }
        writeln!(f, "mode {}", Mode(self.mode))?;
        writeln!(f, "supply {}\n", self.supply)?;
        for programmed in &self.moves {
            writeln!(f, "{programmed}")?;
        }
        writeln!(f)?;
        for (period, event) in &self.events {
            writeln!(f, "at {period} {event}")?;
        }
        if !self.events.is_empty() {
            writeln!(f)?;
        }
        self.asked.fmt(f)
    }
}

/// A number for all axes, or nine.
struct Each<'a>(&'a Axes);

impl Display for Each<'_> {
    fn fmt(&self, f: &mut Formatter) -> Result {
        write!(f, "{:?}", self.0[0])?;
        if self.0.iter().any(|value| *value != self.0[0]) {
            for value in self.0.iter().skip(1) {
                write!(f, " {value:?}")?;
            }
        }
        Ok(())
    }
}

struct Mode(TerminationCondition);

impl Display for Mode {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self.0 {
            TerminationCondition::Stop => write!(f, "G61.1"),
            TerminationCondition::Exact => write!(f, "G61"),
            TerminationCondition::Continuous { tolerance } => write!(f, "P{tolerance:?}"),
        }
    }
}

impl Display for Programmed {
    fn fmt(&self, f: &mut Formatter) -> Result {
        write!(f, "{} F{:?}", self.shape, self.feed)?;
        write!(
            f,
            "{}{}{}",
            match self.motion_type {
                MotionType::Feed => "",
                MotionType::Traverse => " G0",
                MotionType::Arc => " G2",
                other => panic!("no program has {other:?}"),
            },
            match self.enables {
                ALL_ENABLED => "",
                FEED_OVERRIDE_OFF => " M50P0",
                other => panic!("no program has enables {other:#x}"),
            },
            if self.wait_for_spindle {
                " spindle"
            } else {
                ""
            }
        )?;
        self.mode
            .map_or(Ok(()), |mode| write!(f, " {}", Mode(mode)))
    }
}

impl Display for Shape {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Self::Line(displacement) => {
                write!(f, "line{}", Letters(&LETTERS, displacement.as_slice()))
            }
            Self::Arc {
                radial: [x, y, z],
                tilt: [i, j, k],
                radius,
                angle,
                height,
                revolutions,
                others,
            } => write!(
                f,
                "arc radial {x:?} {y:?} {z:?} tilt {i:?} {j:?} {k:?} radius {radius:?} angle {angle:?} \
                 height {height:?} revolutions {revolutions}{}",
                Letters(&LETTERS[3..], others)
            ),
            Self::Turn {
                center: [first, second],
                across,
                angle,
                height,
                others,
            } => write!(
                f,
                "turn center {first:?} {second:?} across {} angle {angle:?} height {height:?}{}",
                LETTERS[*across],
                Letters(&LETTERS[3..], others)
            ),
        }
    }
}

/// What is not 0, behind the letter of its axis.
struct Letters<'a>(&'a [char], &'a [f64]);

impl Display for Letters<'_> {
    fn fmt(&self, f: &mut Formatter) -> Result {
        for (letter, value) in self.0.iter().zip(self.1) {
            if *value != 0.0 {
                write!(f, " {letter}{value:?}")?;
            }
        }
        Ok(())
    }
}

impl Display for Event {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Self::Pause => write!(f, "pause"),
            Self::Resume => write!(f, "resume"),
            Self::Abort => write!(f, "abort"),
            Self::Step => write!(f, "step"),
            Self::Gone => write!(f, "gone"),
            Self::FeedOverride(scale) => write!(f, "feed {scale:?}"),
            Self::RapidOverride(scale) => write!(f, "rapid {scale:?}"),
            Self::Slider(velocity) => write!(f, "slider {velocity:?}"),
            Self::Adaptive(scale) => write!(f, "adaptive {scale:?}"),
            Self::Spindles(true) => write!(f, "spindles on"),
            Self::Spindles(false) => write!(f, "spindles off"),
        }
    }
}

impl Display for Asked {
    fn fmt(&self, f: &mut Formatter) -> Result {
        for (name, most) in [
            ("velocity", self.velocity),
            ("acceleration", self.acceleration),
            ("jerk", self.jerk),
            ("feed", self.feed),
        ] {
            if let Some(most) = most {
                writeln!(f, "ask {name} {most:?}")?;
            }
        }
        for (line, asked) in [
            ("ask path", self.path),
            ("ask rests explained", self.rests == RestsAsked::Explained),
            ("ask rests none", self.rests == RestsAsked::None),
            ("ask same_periods", self.same_periods),
        ] {
            if asked {
                writeln!(f, "{line}")?;
            }
        }
        match self.periods {
            Some(periods) => writeln!(f, "ask periods {periods}"),
            None => Ok(()),
        }
    }
}
