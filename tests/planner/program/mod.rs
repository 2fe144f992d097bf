//! A program for the planner: the machine, the moves, what an operator does meanwhile, and what is asked of the run.
//! `reader.rs` has how it is written as text.

mod asked;
mod checked;
mod feed;
mod operator;
pub mod queue;
pub mod reader;
mod rests;
pub mod run;
mod written;

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};

pub use asked::{Asked, RestsAsked};
pub use checked::checked;

/// Everything that a run depends on, and what is asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Units, units/s, units/s2 and units/s3, for each axis.
    pub limits: AxisLimits,
    /// No move is faster, units/s.
    pub max_velocity: f64,
    /// Where the slider of the velocity stands, units/s; `None` where it was never set.
    pub slider: Option<f64>,
    /// In force before the first move.
    pub mode: TerminationCondition,
    /// Servo periods from one move to the next; 0: all of them come before the first period.
    pub supply: usize,
    pub moves: Vec<Programmed>,
    /// What happens before a servo period, counted from 0; in this order.
    pub events: Vec<(usize, Event)>,
    pub asked: Asked,
}

/// Where a move goes, from the end of the one before it.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Line(Axes),
    /// An arc or helix anywhere in space. The plane is that of `radial`, from the center to the start, and `tilt`.
    Arc {
        radial: [f64; 3],
        tilt: [f64; 3],
        radius: f64,
        /// Of the end from the start, radians; whole turns are `revolutions`.
        angle: f64,
        height: f64,
        revolutions: i32,
        /// The way of A B C U V W.
        others: [f64; 6],
    },
    /// An arc or helix as G2 and G3 make it, across X, Y or Z.
    Turn {
        /// From the start, along the two axes of the plane.
        center: [f64; 2],
        /// The axis across the plane: 0 to 2.
        across: usize,
        /// Radians, more than one turn too; negative clockwise.
        angle: f64,
        height: f64,
        /// The way of A B C U V W.
        others: [f64; 6],
    },
}

/// A move with its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Programmed {
    pub shape: Shape,
    /// Units/s.
    pub feed: f64,
    pub motion_type: MotionType,
    /// LinuxCNC's bits: [`ALL_ENABLED`], or [`FEED_OVERRIDE_OFF`].
    pub enables: u8,
    pub wait_for_spindle: bool,
    /// G61, G61.1 or G64 before it.
    pub mode: Option<TerminationCondition>,
}

/// Overrides, adaptive feed and feed hold are enabled.
pub const ALL_ENABLED: u8 = 0x0f;

/// All but the feed override: M50 P0.
pub const FEED_OVERRIDE_OFF: u8 = 0x0d;

impl Programmed {
    /// A move at feed with all overrides enabled.
    pub fn feed(shape: Shape, feed: f64) -> Self {
        Self {
            shape,
            feed,
            motion_type: MotionType::Feed,
            enables: ALL_ENABLED,
            wait_for_spindle: false,
            mode: None,
        }
    }
}

/// What the operator does, or the machine around the planner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    Pause,
    Resume,
    Abort,
    FeedOverride(f64),
    RapidOverride(f64),
    Slider(f64),
    Adaptive(f64),
    Spindles(bool),
    Step,
    /// The operator goes home and leaves everything at 100 %.
    Gone,
}
