//! Distances from the program as they are shown: lengths in machine units, degrees where nothing but rotary axes moves.

use super::deviation::{Deviation, Farthest};
use super::setup::Setup;
use super::speed::SpeedFigure;
use crate::machine::length_unit::INCH;
use serde::Serialize;

/// A largest distance.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DistanceFigure {
    /// In the unit of [`DeviationFigures`].
    pub distance: f64,
    /// What is allowed there; `None`: G64 without P.
    pub tolerance: Option<f64>,
    /// Line of the program.
    pub line: i32,
}

impl DistanceFigure {
    /// What to write where G64 without P has led farther from the program than programs commonly allow.
    /// `unit` is that of the distance: a degree counts as a millimetre.
    pub fn advice(&self, length_unit: &str, unit: &str) -> Option<String> {
        let usual = if length_unit == "mm" { 0.05 } else { 0.002 };
        let within = match (unit, length_unit) {
            ("deg", "in") => usual * INCH,
            _ => usual,
        };
        (self.tolerance.is_none() && self.distance > within)
            .then(|| format!("G64 P{usual} keeps it within {within} {unit}"))
    }
}

/// Distance from the program.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DeviationFigures {
    /// `mm` or `in`; `deg` where nothing but rotary axes moves in all of the program.
    pub unit: &'static str,
    /// Of the planned path from the program.
    pub planned: DistanceFigure,
    /// Of the ends of programmed moves from the planned path.
    pub programmed: DistanceFigure,
    /// Where P is used up most.
    pub tightest: Option<DistanceFigure>,
    /// In exact modes (G61, G61.1).
    pub exact: Option<DistanceFigure>,
}

/// What distances from the program are shown in.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// `mm`, `in` or `deg`.
    pub unit: &'static str,
    /// How many millimetres, or degrees, that is.
    size: f64,
}

impl Measure {
    /// Degrees where nothing but rotary axes moves, unless they have a tolerance of their own: their distances are then what
    /// they count beside P.
    pub fn new(setup: &Setup, speed: &SpeedFigure) -> Measure {
        match speed.unit == "deg" && setup.rotary_tolerance == 0.0 {
            true => Measure {
                unit: "deg",
                size: 1.0,
            },
            false => Measure {
                unit: setup.unit,
                size: setup.millimetres,
            },
        }
    }

    /// A distance in this unit.
    pub fn figure(self, farthest: &Farthest) -> DistanceFigure {
        DistanceFigure {
            distance: farthest.distance / self.size,
            tolerance: farthest.tolerance.map(|t| t / self.size),
            line: farthest.line,
        }
    }
}

impl DeviationFigures {
    /// Shows what was found.
    pub fn new(measure: Measure, deviation: &Deviation) -> DeviationFigures {
        let figure = |farthest: &Farthest| measure.figure(farthest);
        let there = |farthest: &Farthest| farthest.tolerance.map(|_| figure(farthest));
        DeviationFigures {
            unit: measure.unit,
            planned: figure(&deviation.planned),
            programmed: figure(&deviation.programmed),
            tightest: there(&deviation.tightest),
            exact: there(&deviation.exact),
        }
    }
}
