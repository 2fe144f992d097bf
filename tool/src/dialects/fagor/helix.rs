//! Helices of several turns: `G2 X Y I J Z K`, where K, along the axis of the tool, is how far a turn goes.
//! (Fagor, CNC 8055 Programming Manual, "Helical interpolation".)

use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use framepath::frame::angle::sin_cos_degrees;

/// How far turns and pitch may be off the end point, turns: pitches are rounded.
const TURNS: f64 = 0.01;

impl Interpreter<'_> {
    /// Replaces the pitch of a helix by its turns, and by its end if that is not given.
    pub(super) fn resolve_helix(&mut self, motion: &mut MotionWords, kind: Option<Motion>) -> Done {
        let [first, second, normal] = self.control.modal.plane.axes();
        let clockwise = match kind {
            Some(Motion::Clockwise) => true,
            Some(Motion::Counterclockwise) => false,
            _ => return Ok(()),
        };
        let Some(pitch) = motion.centre[normal].take() else {
            return Ok(());
        };
        let places = [first, second, normal].map(|axis| self.control.present(axis));
        let ([Some(x), Some(y), Some(z)], None) = (places, motion.radius) else {
            return Err(Diagnostic::unknown_place(
                    pitch.span,
                    "the pitch of a helix by its radius, or from a place that is not known ahead of time",
                )
                .help("give the centre with I and J, and program the axes absolute before: not both R and K"));
        };
        let incremental = self.control.modal.incremental;
        let end = |axis: usize, start: f64| {
            motion.axes[axis].map_or(start, |word| match word.value {
                (value, Dimension::Absolute) => value,
                (value, Dimension::Incremental) => start + value,
                (value, Dimension::Modal) if incremental => start + value,
                (value, Dimension::Modal) => value,
            })
        };
        let depth = (end(normal, z) - z).abs();
        if pitch.value.0 <= 0.0 || depth == 0.0 {
            return Err(Diagnostic::error(
                pitch.span,
                "a helix needs K above 0 and a way along its axis",
            )
            .help("write G2 X25 Y0 I-25 J0 Z-30 K5"));
        }
        let turns = depth / pitch.value.0;
        let centre = [(first, x), (second, y)].map(|(axis, start)| {
            motion.centre[axis].map_or(start, |word| match word.value {
                (value, Dimension::Absolute) => value,
                (value, _) => start + value,
            })
        });
        let from = [x - centre[0], y - centre[1]];
        let sign = if clockwise { -1.0 } else { 1.0 };
        let given = motion.axes[first].is_some() || motion.axes[second].is_some();
        let part = match given {
            true => {
                let to = [end(first, x) - centre[0], end(second, y) - centre[1]];
                let turned = sign * (to[1].atan2(to[0]) - from[1].atan2(from[0])).to_degrees();
                let part = turned.rem_euclid(360.0) / 360.0;
                // The end is the start: a turn.
                if part < TURNS / 2.0 { 1.0 } else { part }
            }
            false => match turns.fract() < TURNS / 2.0 {
                true => 1.0,
                false => turns.fract(),
            },
        };
        let further = (turns - part).round();
        if further < 0.0 || (turns - part - further).abs() > TURNS {
            return Err(Diagnostic::error(
                pitch.span,
                format!("this pitch makes {turns} turns, which do not lead to the end point"),
            )
            .help("leave the end point out, or correct K"));
        }
        if !given {
            let (sin, cos) = sin_cos_degrees(sign * 360.0 * part);
            let place = [
                centre[0] + from[0] * cos - from[1] * sin,
                centre[1] + from[0] * sin + from[1] * cos,
            ];
            let span = pitch.span;
            for (axis, value) in [first, second].into_iter().zip(place) {
                let value = (value, Dimension::Absolute);
                motion.axes[axis] = Some(At { value, span });
            }
        }
        motion.turns = Some(At {
            value: further,
            span: pitch.span,
        });
        Ok(())
    }
}
