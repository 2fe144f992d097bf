//! Why there is no plan.

use super::lines::Line;
use crate::canon::CanonError;
use crate::canon::tool_table::ToolTableError;
use crate::joints::JointsError;
use crate::machine::IniError;
use framepath::axes::AXIS_LETTERS;
use framepath::moves::shape::ShapeError;
use framepath::planner::{AddError, SpindleError, Status};
use std::io;
use std::path::{Path, PathBuf};

/// Why there is no plan. Every message says where and what to do.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The program cannot be read, or the interpreter refuses it.
    #[error(transparent)]
    Program(#[from] CanonError),
    /// The INI file cannot be used.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// The tool table cannot be used.
    #[error(transparent)]
    ToolTable(#[from] ToolTableError),
    /// Limits of joints cannot be used.
    #[error(transparent)]
    Joints(#[from] JointsError),
    /// An option cannot be used.
    #[error("{0}")]
    Option(String),
    /// Nothing moves in the program.
    #[error("{}: nothing moves in this program", .0.display())]
    NoMoves(PathBuf),
    /// An axis moves that the machine does not have.
    #[error(
        "{}:{line}: axis {letter} moves, which the machine does not have: [TRAJ]COORDINATES (or [KINS]KINEMATICS) of {} names \
         no {letter}",
        file.display(), ini.display()
    )]
    NoAxis {
        /// The program, or a file of subroutines.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// The axis.
        letter: char,
        /// The INI file.
        ini: PathBuf,
    },
    /// The planner refused a move.
    #[error("{}:{line}: the planner refuses the move: {reason}", file.display())]
    MoveRefused {
        /// The program, or a file of subroutines.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// Why.
        reason: String,
    },
    /// The planner stopped the motion.
    #[error("{}:{line}: the planner stops the motion: {reason}", file.display())]
    Stopped {
        /// The program, or a file of subroutines.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// Why.
        reason: String,
    },
    /// A dwell takes longer than anybody waits.
    #[error(
        "{}: {} the program dwells for {seconds:e} s, which is too long to be planned",
        file.display(), behind_line(*line)
    )]
    Dwell {
        /// The program, or a file of subroutines.
        file: PathBuf,
        /// Line of the last move before it, 0 for none.
        line: i32,
        /// How long, s.
        seconds: f64,
    },
    /// A file that cannot be a program, or is too long.
    #[error("{}: cannot be read: {problem}", file.display())]
    Unfit {
        /// The program.
        file: PathBuf,
        /// Why.
        problem: String,
    },
    /// The plan takes too long.
    #[error(
        "{}:{line}: the plan has not come to its end after {seconds} s: check the feeds and loops of the \
         program; --most-seconds raises the limit",
        file.display()
    )]
    Slow {
        /// The program, or a file of subroutines.
        file: PathBuf,
        /// The line that runs.
        line: i32,
        /// How long was waited, s.
        seconds: u64,
    },
    /// --check, and the plan exceeds a limit or a tolerance. The plan itself has been told.
    #[error("not kept: {0}")]
    NotKept(String),
    /// A file cannot be written.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Where nothing has moved yet there is no line.
fn behind_line(line: i32) -> String {
    match line {
        0 => "before its first move".to_owned(),
        line => format!("behind line {line}"),
    }
}

impl PlanError {
    /// A file that cannot be written, and why.
    pub(super) fn unwritable(file: &Path, source: io::Error) -> PlanError {
        PlanError::Write {
            file: file.to_owned(),
            source,
        }
    }
}

/// The planner refuses the move of this line.
pub(super) fn move_refused(line: &Line, reason: String) -> PlanError {
    PlanError::MoveRefused {
        file: line.file.to_path_buf(),
        line: line.number,
        reason,
    }
}

/// The planner stops in this line, or before it.
pub(super) fn stopped(line: &Line, reason: String) -> PlanError {
    PlanError::Stopped {
        file: line.file.to_path_buf(),
        line: line.number,
        reason,
    }
}

/// Why the planner refuses a move.
pub(super) fn refusal(error: &AddError) -> String {
    match error {
        AddError::Feed { .. } => "it has no feed: F is zero".to_owned(),
        AddError::RigidTap => "a rigid tap (G33.1) has no pitch to follow".to_owned(),
        AddError::PerTurn(pitch) => format!("{pitch} is no pitch: it has to be above 0"),
        AddError::AxisLimits { axis } => format!(
            "axis {} has no limits",
            AXIS_LETTERS.get(*axis).copied().unwrap_or('?')
        ),
        AddError::Shape(shape) => match shape {
            ShapeError::ZeroLength => "it goes nowhere",
            ShapeError::NotFinite | ShapeError::TooFar => "its coordinates are too large",
            ShapeError::NoNormal => "its plane has no direction",
            ShapeError::RadiusTooSmall => "an end of the arc lies on its axis",
            ShapeError::TooManyRevolutions => "it has too many turns",
        }
        .to_owned(),
        AddError::ScaledPitch => "the frame would scale its pitch as well".to_owned(),
        AddError::Spindle { spindle } => format!("the machine has no spindle {spindle}"),
        AddError::Aborting
        | AddError::QueueFull
        | AddError::NotConfigured
        | AddError::PathJerk(_)
        | AddError::Tripped => {
            format!("{error:?}. This is a fault of framepath: please report it with the program")
        }
    }
}

/// Why the planner stopped a motion that follows the spindle. Speeds are machine units per second.
pub(super) fn spindle_error(error: &SpindleError) -> String {
    match error {
        SpindleError::Stalled => "the spindle has come to a stop".to_owned(),
        SpindleError::Reversed => "the spindle has turned back".to_owned(),
        SpindleError::Jumped => "the angle of the spindle has jumped".to_owned(),
        SpindleError::Outrun { asked, greatest } => format!(
            "to follow the spindle takes {asked:.3} units/s, the axes allow {greatest:.3} units/s"
        ),
        SpindleError::NotReversed => {
            "the spindle does not turn back at the end of a tap".to_owned()
        }
        SpindleError::NoIndex => "the spindle does not turn, or has no index".to_owned(),
    }
}

/// Why the planner stands still with moves to go. `without_turns`: the move follows the turns of a spindle that stands.
pub(super) fn stuck(status: &Status, without_turns: bool) -> &'static str {
    if without_turns {
        "it follows the turns of a spindle that stands (M5, or S0), and LinuxCNC waits there until somebody starts the spindle: \
         write M3 or M4 with an S before it, or G94 with an F per minute"
    } else if status.waiting_for_index {
        "it waits for the index of a spindle that does not turn"
    } else {
        "it stands still with moves to go. This is a fault of blendtp: please report it with the program"
    }
}
