//! The motions of pockets, in machine units.

use super::interpreter::Interpreter;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::source::Span;

/// How far above the floor the tool ends rapid motions, millimetres.
const CLEARANCE: f64 = 1.0;

/// Places that differ by less, in units of the program, are the same.
const SAME_PLACE: f64 = 1e-9;

impl Interpreter<'_> {
    /// To a place along the axes of the plane, unless the tool is there; `centre` of an arc: from its start.
    pub(super) fn plane_way(
        &mut self,
        place: [f64; 2],
        motion: Motion,
        centre: Option<[f64; 2]>,
        span: Span,
    ) -> Done {
        let factor = self.control.modal.length_factor;
        let [first, second, _] = self.control.modal.plane.axes();
        let mut words = MotionWords::default();
        let mut stays = centre.is_none();
        for (at, axis) in [first, second].into_iter().enumerate() {
            let value = place[at] / factor;
            stays &= self
                .control
                .present(axis)
                .is_some_and(|old| (old - value).abs() < SAME_PLACE);
            words.axes[axis] = Some(At {
                value: (value, Dimension::Absolute),
                span,
            });
            words.centre[axis] = centre.map(|centre| At {
                value: (centre[at] / factor, Dimension::Incremental),
                span,
            });
        }
        if stays {
            return Ok(());
        }
        self.control.modal.motion = Some(motion);
        self.control.motion(&words, span, false, false)
    }

    /// To a coordinate along the normal of the plane, unless the tool is there.
    pub(super) fn normal_way(&mut self, place: f64, motion: Motion, span: Span) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        if self.control.modal.position.get(normal) == Some(place) {
            return Ok(());
        }
        let value = place / self.control.modal.length_factor;
        self.control
            .move_axis(normal, value, motion == Motion::Rapid, span)
    }

    /// A feed in units of the program, unless it is in force.
    pub(super) fn cycle_feed(&mut self, value: f64, span: Span) -> Done {
        let factor = self.control.modal.feed_factor;
        if self.control.modal.feed == Some(value * factor) {
            return Ok(());
        }
        self.control.feed(At { value, span })
    }

    /// How far above the floor rapid motions end.
    pub(super) fn floor_clearance(&self) -> f64 {
        match self.control.settings.machine_in_inch {
            true => CLEARANCE / 25.4,
            false => CLEARANCE,
        }
    }
}
