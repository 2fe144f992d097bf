//! Whether external offsets (`axis.L.eoffset`) move the axes while motion stands.
//!
//! Motion adds them behind its planner, which knows nothing of them and is in position meanwhile. What shows them are the
//! positions that the kinematics are asked for.

use super::release::SETTLED;
use crate::axes::AXIS_COUNT;

/// Looks at the position that motion asks for in each servo period.
#[derive(Clone, Copy, Debug)]
pub struct OffsetMotion {
    /// What motion asked for last, `None` where the next position says nothing: others are meant behind a switch.
    asked: Option<[f64; AXIS_COUNT]>,
    /// Motion stood in the period before.
    stood: bool,
    /// Periods in which joints may still follow: motion's interpolator runs on behind the position.
    left: u32,
}

impl OffsetMotion {
    /// Nothing has been asked for.
    pub const fn new() -> Self {
        Self {
            asked: None,
            stood: false,
            left: 0,
        }
    }

    /// One servo period in which motion asked for this position last, and says whether it stands: whether offsets move the
    /// axes, or have just done so.
    pub fn watch(&mut self, asked: Option<&[f64; AXIS_COUNT]>, stands: bool) -> bool {
        let elsewhere = match (&self.asked, asked) {
            // What is no number has not moved: nothing follows it.
            (Some(before), Some(now)) => before.iter().zip(now).any(|(a, b)| (a - b).abs() > 0.0),
            _ => false,
        };
        self.left = if stands && self.stood && elsewhere {
            SETTLED - 1
        } else {
            self.left.saturating_sub(1)
        };
        (self.asked, self.stood) = (asked.copied(), stands);
        self.left > 0
    }

    /// The kinematics have been switched: the same place has another position.
    pub fn switched(&mut self) {
        self.asked = None;
    }
}

impl Default for OffsetMotion {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is seen of these places, one a period, while motion stands.
    fn seen<const COUNT: usize>(motion: &mut OffsetMotion, places: [f64; COUNT]) -> [bool; COUNT] {
        places.map(|place| motion.watch(Some(&[place; AXIS_COUNT]), true))
    }

    #[test]
    fn positions_that_change_while_motion_stands_are_offsets() {
        let mut motion = OffsetMotion::new();
        assert_eq!(seen(&mut motion, [0.0, 0.0]), [false, false]);
        assert_eq!(seen(&mut motion, [1e-6, 2e-6]), [true, true]);
        // four equal positions, and the interpolator is there
        assert_eq!(seen(&mut motion, [2e-6; 3]), [true, true, false]);
    }

    #[test]
    fn the_end_of_a_move_and_a_switch_are_none() {
        let mut motion = OffsetMotion::new();
        assert!(!motion.watch(None, true));
        for place in [1.0, 2.0] {
            assert!(!motion.watch(Some(&[place; AXIS_COUNT]), false));
        }
        assert_eq!(seen(&mut motion, [3.0, 3.0]), [false, false]);
        motion.switched();
        assert_eq!(seen(&mut motion, [7.0, 7.0, 8.0]), [false, false, true]);
        let mut motion = OffsetMotion::new();
        assert_eq!(seen(&mut motion, [f64::NAN; 2]), [false, false]);
    }
}
