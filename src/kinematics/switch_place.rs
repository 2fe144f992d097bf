//! The place that motion goes on from behind a switch of the kinematics.
//!
//! Behind a switch motion asks where its joints are, and gives its planner that place. In each period it adds the external offsets
//! (`axis.L.eoffset`) to where the planner is: LinuxCNC 2.9 does not take them off that place, so that joints would jump by them.
//! They are taken off here, and what motion asks for next is to be the place of its joints again.

use crate::axes::{AXIS_COUNT, Axes};

/// How far rounding may lead beside a place that an offset was taken off and added again, machine units or degrees.
const BESIDE: f64 = 1e-8;

/// Where joints would jump: motion goes on from another place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceJump {
    /// The first axis that does, in the order X Y Z A B C U V W, from 0.
    pub axis: usize,
    /// Where that is, machine units or degrees.
    pub place: f64,
    /// Where motion goes on from.
    pub goes_on: f64,
}

/// What is known from a switch to the end of its period.
#[derive(Clone, Copy, Debug)]
pub struct SwitchPlace {
    /// The place of the joints, and which pose motion asked with: the planner asks with another one.
    asked: Option<(usize, [f64; AXIS_COUNT])>,
}

impl SwitchPlace {
    /// Nothing was switched.
    pub const fn new() -> Self {
        Self { asked: None }
    }

    /// Motion has switched, and asks with the `pose` at this address for the place of its joints: what it is to give its planner,
    /// without these external offsets.
    pub fn of_planner(
        &mut self,
        pose: usize,
        place: &Axes,
        offsets: &[f64; AXIS_COUNT],
    ) -> [f64; AXIS_COUNT] {
        let place: [f64; AXIS_COUNT] = (*place).into();
        self.asked = Some((pose, place));
        let mut without = place;
        for (value, offset) in without.iter_mut().zip(offsets) {
            *value -= offset;
        }
        without
    }

    /// Whether motion goes on from another place than that of its joints, which would jump: by an offset that is not known here,
    /// or a limit that motion holds the axis within as long as it has one. Said once, of the first place that is asked for with
    /// the `pose` of the switch.
    pub fn jump(&mut self, pose: usize, goes_on: &Axes) -> Option<PlaceJump> {
        let (_, place) = self.asked.take_if(|(asked_with, _)| *asked_with == pose)?;
        let goes_on: [f64; AXIS_COUNT] = (*goes_on).into();
        let is_beside = |place: f64, goes_on: f64| (goes_on - place).abs() <= BESIDE;
        let places = place.into_iter().zip(goes_on).enumerate();
        let mut jumps = places.filter(|(_, (place, goes_on))| !is_beside(*place, *goes_on));
        jumps.next().map(|(axis, (place, goes_on))| PlaceJump {
            axis,
            place,
            goes_on,
        })
    }

    /// The period is over: from the next one on motion moves.
    pub fn forget(&mut self) {
        self.asked = None;
    }
}

impl Default for SwitchPlace {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Addresses of poses: that of motion and another one.
    const MOTION: usize = 1;
    const OTHER: usize = 2;

    fn place(y: f64) -> Axes {
        let mut place = Axes::from([7.0; AXIS_COUNT]);
        place[1] = y;
        place
    }

    /// Behind a switch at Y 5 with an offset of 2 in Y.
    fn switched() -> SwitchPlace {
        let mut switch = SwitchPlace::new();
        let mut offsets = [0.0; AXIS_COUNT];
        offsets[1] = 2.0;
        let without = switch.of_planner(MOTION, &place(5.0), &offsets);
        assert_eq!(Axes::from(without), place(3.0));
        switch
    }

    #[test]
    fn what_goes_on_elsewhere_would_jump() {
        for (goes_on, jumps) in [(5.0, false), (5.0 + 1e-9, false), (3.0, true)] {
            let jump = PlaceJump {
                axis: 1,
                place: 5.0,
                goes_on,
            };
            let found = switched().jump(MOTION, &place(goes_on));
            assert_eq!(found, jumps.then_some(jump), "{goes_on}");
        }
        let found = switched().jump(MOTION, &place(f64::NAN));
        assert!(found.is_some_and(|jump| jump.axis == 1));
    }

    #[test]
    fn only_the_first_place_of_motion_in_the_period_of_a_switch_is_looked_at() {
        assert_eq!(SwitchPlace::new().jump(MOTION, &place(3.0)), None);
        let mut switch = switched();
        assert_eq!(switch.jump(OTHER, &place(3.0)), None);
        assert!(switch.jump(MOTION, &place(3.0)).is_some());
        assert_eq!(switch.jump(MOTION, &place(3.0)), None);
        let mut switch = switched();
        switch.forget();
        assert_eq!(switch.jump(MOTION, &place(3.0)), None);
    }
}
