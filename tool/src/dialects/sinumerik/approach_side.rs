//! How a smooth approach meets what comes before it, and the contour behind it.
//!
//! With G41 or G42 in its block the control leads the tool to the place beside where the approach begins, wherever it comes from.
//! LinuxCNC goes there too, or is led there (see [`contour_start`](crate::program::contour_start)), unless the way turns away from
//! the side of the tool there: then it goes round that place, and would go down beside another one.

use super::approach::{Smooth, unit};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::program::contour_start::{SAME_DIRECTION, turn_to_tool};
use crate::program::moves::{Move, MoveKind};
use crate::program::trace::frame_arc;
use crate::program::{Action, Compensation};
use nalgebra::Vector3;

impl Interpreter<'_> {
    /// Whether G41 or G42 stands in the block under way.
    pub(super) fn begins_compensation(&self) -> bool {
        self.control.actions.iter().any(|action| {
            matches!(
                action,
                Action::Compensation(Compensation::Left | Compensation::Right)
            )
        })
    }

    /// The direction of a motion at its start in the plane, length 1.
    pub(super) fn start_direction(&self, path: &Move) -> Option<[f64; 2]> {
        let plane = self.control.modal.plane;
        let [first, second, _] = plane.axes();
        let point = |ends: bool| -> Option<Vector3<f64>> {
            let at = |axis: usize| match ends {
                true => path.end(axis),
                false => path.start[axis],
            };
            Some(Vector3::new(at(0)?, at(1)?, at(2)?))
        };
        let (start, end) = (point(false)?, point(true)?);
        let direction = match &path.kind {
            MoveKind::Arc(arc) => {
                let tolerance = &self.control.settings.arc_tolerance;
                let shape = frame_arc(arc, start, end, plane, tolerance).ok()?;
                shape.start_direction()
            }
            _ => end - start,
        };
        let direction = [direction[first], direction[second]];
        (direction != [0.0; 2]).then(|| unit(direction))
    }
}

impl Smooth {
    /// Refuses an approach with which compensation begins, where LinuxCNC would not lead the tool to beside its start. `before`: where
    /// the tool is; `from`: where the approach begins; `tangent`: the direction of the contour; along both axes of the plane.
    pub(super) fn check_side(
        &self,
        before: [Option<f64>; 2],
        from: [f64; 2],
        tangent: [f64; 2],
    ) -> Result<(), Diagnostic> {
        let [Some(x), Some(y)] = before else {
            return Ok(());
        };
        let way = [from[0] - x, from[1] - y];
        if way == [0.0; 2] {
            return Ok(());
        }
        let comes = unit(way);
        let goes = self.outward(tangent, -1.0).map(|part| -part);
        if turn_to_tool(comes, goes, self.left) >= -SAME_DIRECTION {
            return Ok(());
        }
        let [x, y] = comes;
        Err(Diagnostic::error(
            self.span,
            "G41 or G42 with an approach that the tool does not come to from its side: LinuxCNC would lead it elsewhere",
        )
        .help(format!(
            "go before to a place from where the way to the start of the approach (without radius at {:.3}, {:.3} in the plane; from \
             direction {x:.3}, {y:.3} now) turns to the side of the tool",
            from[0], from[1]
        )))
    }
}
