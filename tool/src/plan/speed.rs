//! The greatest speed along the path, of lengths and of turns.

use super::collector::Collected;
use super::setup::Setup;
use serde::Serialize;

/// The greatest speed along the path.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SpeedFigure {
    /// In its unit per second.
    pub value: f64,
    /// `mm` or `in`; `deg` where nothing but rotary axes moves in all of the program.
    pub unit: &'static str,
    /// s.
    pub time: f64,
    /// Line of the program.
    pub line: i32,
}

/// How drawings show the speed.
#[derive(Clone, Debug)]
pub struct DrawnSpeed {
    /// The greatest of all, in whatever unit.
    pub greatest: f64,
    /// `mm/s`, and what else it is in where only rotary axes move.
    pub unit: String,
}

impl SpeedFigure {
    /// Of lengths; of degrees where no linear axis moves.
    pub fn new(setup: &Setup, collected: &Collected) -> SpeedFigure {
        let (peak, unit) = match collected.speed.value > 0.0 {
            true => (&collected.speed, setup.unit),
            false => (&collected.turning, "deg"),
        };
        SpeedFigure {
            value: peak.value,
            unit,
            time: peak.time,
            line: peak.line,
        }
    }
}

impl DrawnSpeed {
    /// Of all that moves.
    pub fn new(setup: &Setup, collected: &Collected) -> DrawnSpeed {
        let unit = SpeedFigure::new(setup, collected).unit;
        let also = match unit != "deg" && collected.turning.value > 0.0 {
            true => ", deg/s where only A, B, C move",
            false => "",
        };
        DrawnSpeed {
            greatest: collected.speed.value.max(collected.turning.value),
            unit: format!("{unit}/s{also}"),
        }
    }
}
