//! Continuous path: G64, G641 to G645, and the tolerance that ADIS, CTOL and CYCLE832 give it. (Siemens,
//! SINUMERIK 840D sl, Programming Manual, "Continuous-path mode" and "Programmable contour tolerance".)

use super::interpreter::Interpreter;
use super::syntax::Call;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::dialects::expression::{Expression, ExpressionKind};
use crate::program::PathControl;
use crate::source::Span;

/// By how much corners may be rounded, machine units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothing {
    /// CTOL or CYCLE832: holds until it ends, whichever of G64 to G645 follows.
    tolerance: Option<f64>,
    /// ADIS: how far before the corner G641 begins to round, which is more than it rounds.
    distance: Option<f64>,
    /// G641.
    pub(super) by_distance: bool,
    /// The mode that CYCLE832 has taken the place of, until it ends.
    before: Option<PathControl>,
}

impl Interpreter<'_> {
    /// G60, G64, G641 to G645; `code`: ten times the number.
    pub(super) fn path_mode(&mut self, code: u32, span: Span) -> Done {
        self.smoothing.before = None;
        self.smoothing.by_distance = code == 6410;
        match code {
            600 => self.control.path_control(PathControl::ExactStop, span),
            _ => self.round_corners(span),
        }
    }

    /// CTOL: a negative one ends it. The mode stays.
    pub(super) fn contour_tolerance(&mut self, word: At<f64>) -> Done {
        self.smoothing.tolerance = match word.value < 0.0 {
            true => None,
            false => Some(self.control.tolerance(word.value, word.span)?),
        };
        self.refresh(word.span)
    }

    /// ADIS: 0 leaves the rounding to the control. The mode stays.
    pub(super) fn rounding_distance(&mut self, word: At<f64>) -> Done {
        let distance = self.control.tolerance(word.value, word.span)?;
        self.smoothing.distance = Some(distance).filter(|distance| *distance > 0.0);
        self.refresh(word.span)
    }

    /// `CYCLE832(tolerance, technology, ..)`. Without a technology (units digit 0) or a value it ends.
    pub(super) fn high_speed_settings(&mut self, call: &Call) -> Done {
        let given = |at: usize| call.arguments.get(at).and_then(Option::as_ref);
        let ends = match given(1) {
            Some(technology) => self.is_off(technology),
            None => given(0).is_none(),
        };
        if ends {
            self.smoothing.tolerance = None;
            match self.smoothing.before.take() {
                Some(PathControl::Continuous { .. }) | None => self.refresh(call.span)?,
                Some(before) => self.control.path_control(before, call.span)?,
            }
        } else {
            let tolerance = match given(0) {
                Some(tolerance) => tolerance.number(&self.variables)?,
                None => 0.0,
            };
            let tolerance = self.control.tolerance(tolerance, call.span)?;
            // 0 is the tolerance that the machine has set for the technology.
            self.smoothing.tolerance = Some(tolerance).filter(|tolerance| *tolerance > 0.0);
            self.smoothing.by_distance = false;
            let before = self.control.modal.path_control;
            self.smoothing.before.get_or_insert(before);
            self.round_corners(call.span)?;
        }
        self.control.apply_states(false);
        Ok(())
    }

    fn is_off(&self, technology: &Expression) -> bool {
        match &technology.kind {
            ExpressionKind::Variable(name, _) if name.starts_with('_') => name == "_OFF",
            _ => technology
                .number(&self.variables)
                .is_ok_and(|technology| technology.rem_euclid(10.0) == 0.0),
        }
    }

    /// The mode as it is, with the tolerance of now.
    fn refresh(&mut self, span: Span) -> Done {
        match self.control.modal.path_control {
            PathControl::Continuous { .. } => self.round_corners(span),
            _ => Ok(()),
        }
    }

    pub(super) fn round_corners(&mut self, span: Span) -> Done {
        let Smoothing {
            tolerance,
            distance,
            by_distance,
            ..
        } = self.smoothing;
        let distance = distance.filter(|_| by_distance);
        let least = match (tolerance, distance) {
            (Some(tolerance), Some(distance)) => Some(tolerance.min(distance)),
            (tolerance, distance) => tolerance.or(distance),
        };
        self.control.continuous_path(least, span)
    }
}
