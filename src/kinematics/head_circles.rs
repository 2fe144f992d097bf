//! How a head turns the tool whose axes do not meet, found from the circles on which it runs round the tip.
//!
//! While one axis of a head turns, its linear joints go round a circle about the line of that axis, whatever the head is
//! made of behind it. Three places on the circle give the line, and which way the axis turns.

use nalgebra::{Rotation3, Unit, Vector3};

use super::rotary_chain::{RotaryAxis, RotaryChain};

/// Machine units.
const CLOSE: f64 = 1e-7;
/// Of directions.
const PARALLEL: f64 = 1e-6;
/// Between the places on a circle, degrees.
const STEP: f64 = 20.0;
/// Where the other axis stands, degrees, while circles are compared.
const ASIDE: [f64; 3] = [20.0, -65.0, 110.0];

/// The axes that turn the tool, for a head that puts the linear joints to `place` while the tip stands and A B C have these
/// angles. `is_of_head` says which of A B C do not turn the table, `table` is the axis that does, where there is one.
/// `None`: circles do not tell.
pub fn chain_by_circles(
    place: impl FnMut([f64; 3]) -> Option<Vector3<f64>>,
    is_of_head: [bool; 3],
    table: Option<RotaryAxis>,
) -> Option<RotaryChain> {
    let mut head = Head { place, is_of_head };
    let (first, second) = head.axes()?;
    match (table, second) {
        (Some(table), None) => {
            // The table does not turn the head.
            head.keeps(&first, table.letter)?;
            Some(RotaryChain {
                rotary: Some(table),
                tilt: first,
            })
        }
        (None, None) => Some(RotaryChain {
            rotary: None,
            tilt: first,
        }),
        (None, Some(second)) => head.in_order(first, second),
        (Some(_), Some(_)) => None,
    }
}

struct Head<F> {
    place: F,
    is_of_head: [bool; 3],
}

impl<F: FnMut([f64; 3]) -> Option<Vector3<f64>>> Head<F> {
    /// The axis that tilts the tool by itself, and another one that turns the head.
    fn axes(&mut self) -> Option<(RotaryAxis, Option<RotaryAxis>)> {
        let mut tilting = None;
        for axis in self.letters() {
            let found = self.axis(axis, [0.0; 3])?;
            tilting = tilting.or(found.filter(|axis| !is_along(&axis.line, &Vector3::z_axis())));
        }
        let tilting = tilting?;
        let mut other = None;
        for axis in self.letters().filter(|axis| *axis != tilting.letter) {
            let aside = at(tilting.letter, STEP, [0.0; 3]);
            let Some(found) = self.axis(axis, aside)? else {
                continue;
            };
            let tool = tilting.turned(STEP, &Vector3::z());
            if is_along(&found.line, &Unit::new_unchecked(tool)) {
                // A spindle that turns about itself.
                continue;
            }
            if other.replace(found).is_some() {
                return None;
            }
        }
        Some((tilting, other))
    }

    fn letters(&self) -> impl Iterator<Item = usize> + use<F> {
        let is_of_head = self.is_of_head;
        (0..3).filter(move |axis| is_of_head.get(*axis).copied().unwrap_or(false))
    }

    /// The line of an axis with the others at these angles; `Some(None)` where it moves nothing, `None` where it is no circle.
    fn axis(&mut self, letter: usize, angles: [f64; 3]) -> Option<Option<RotaryAxis>> {
        let before = (self.place)(at(letter, -STEP, angles))?;
        let here = (self.place)(at(letter, 0.0, angles))?;
        let after = (self.place)(at(letter, STEP, angles))?;
        let (coming, going) = (here - before, after - here);
        if coming.norm() < CLOSE && going.norm() < CLOSE {
            return Some(None);
        }
        let line = Unit::try_new(coming.cross(&going), CLOSE * CLOSE)?;
        let axis = RotaryAxis {
            letter,
            line,
            is_of_head: true,
        };
        let is_circle = (axis.turned(STEP, &coming) - going).norm() < CLOSE;
        is_circle.then_some(Some(axis))
    }

    /// That the line of this axis stands, wherever another axis does.
    fn keeps(&mut self, axis: &RotaryAxis, other: usize) -> Option<()> {
        for angle in ASIDE {
            let found = self.axis(axis.letter, at(other, angle, [0.0; 3]))??;
            is_same(&found.line, &axis.line).then_some(())?;
        }
        Some(())
    }

    /// The one that carries the other: its own line stands, and it turns the other's.
    fn in_order(&mut self, one: RotaryAxis, other: RotaryAxis) -> Option<RotaryChain> {
        [(other, one), (one, other)]
            .into_iter()
            .find_map(|(rotary, tilt)| self.carries(rotary, tilt))
    }

    fn carries(&mut self, rotary: RotaryAxis, tilt: RotaryAxis) -> Option<RotaryChain> {
        self.keeps(&rotary, tilt.letter)?;
        let level = self.axis(tilt.letter, [0.0; 3])??;
        for angle in ASIDE {
            let found = self.axis(tilt.letter, at(rotary.letter, angle, [0.0; 3]))??;
            let turned = Rotation3::from_axis_angle(&rotary.line, angle.to_radians()) * level.line;
            is_same(&found.line, &turned).then_some(())?;
        }
        Some(RotaryChain {
            rotary: Some(rotary),
            tilt: level,
        })
    }
}

/// The angles with this one changed.
fn at(letter: usize, angle: f64, mut angles: [f64; 3]) -> [f64; 3] {
    if let Some(changed) = angles.get_mut(letter) {
        *changed = angle;
    }
    angles
}

fn is_same(one: &Unit<Vector3<f64>>, other: &Unit<Vector3<f64>>) -> bool {
    (one.as_ref() - other.as_ref()).norm() < PARALLEL
}

fn is_along(one: &Unit<Vector3<f64>>, other: &Unit<Vector3<f64>>) -> bool {
    is_same(one, other) || is_same(one, &-*other)
}
