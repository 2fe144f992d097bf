//! Kinematics of another module behind the frame: robots, hexapods, tables and whatever else LinuxCNC's users have.
//!
//! joints = inner(frame(position)), and back. They may fail, iterate from a guess, keep a state, and be switchable
//! themselves: nothing is known of them but what they answer.

use crate::axes::{AXIS_COUNT, Axes};
use crate::frame::ActiveFrame;
use crate::machine::JOINT_COUNT;

/// motion is asked for this many times the slot of the frame, plus the type of the inner kinematics.
pub const TYPES: i32 = 16;

/// How far an axis is moved to see whether the machine has it, machine units: little for a machine, much for kinematics
/// that iterate.
const NUDGE: f64 = 1e-3;

/// How far a joint may be from where it was, machine units or degrees: nothing for a machine, much for kinematics that
/// iterate.
const SAME_JOINT: f64 = 1e-5;

/// How far rounding may lead beside a place, machine units or degrees: more than it does.
const ROUNDING: f64 = 1e-9;

/// How far joints may be apart for two places that rounding cannot tell apart, machine units or degrees: a stretched arm
/// bends by less, a straight wrist turns over.
const TURNED_OVER: f64 = 1e-2;

/// The kinematics of another module. What they return is 0 for success, as LinuxCNC has it.
pub trait InnerKinematics {
    /// Joints for axes, from the joints of before.
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) -> i32;

    /// Axes for joints, from a guess at them. Axes that they do not have stay as they are.
    fn forward(&mut self, joints: &[f64; JOINT_COUNT], axes: &mut Axes) -> i32;
}

/// The type that inner kinematics are switched to, and which of their types turn the tool's length themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InnerType {
    number: i32,
    tool_types: u16,
}

impl InnerType {
    /// Type 0, with which all begin. `tool_types` has a bit for each type that turns the tool's length itself.
    pub fn first(tool_types: u16) -> Self {
        Self {
            number: 0,
            tool_types,
        }
    }

    /// The same kinematics switched to another type.
    pub fn with(self, number: i32) -> Self {
        Self { number, ..self }
    }

    /// From 0 to 15.
    pub fn number(self) -> i32 {
        self.number
    }

    /// Whether the tool's length is theirs.
    pub fn turns_tool(self) -> bool {
        let bit = u32::try_from(self.number)
            .ok()
            .and_then(|number| 1_u16.checked_shl(number));
        bit.is_some_and(|bit| self.tool_types & bit != 0)
    }

    /// Whether a type other than the first is named as one that turns the tool's length.
    pub fn has_other_tool_types(self) -> bool {
        self.tool_types & !1 != 0
    }

    /// The type for the tool centre point: the one in force, if it is theirs to turn the tool, or the first such one; `None`
    /// if none is named.
    pub fn for_tool_centre(self) -> Option<i32> {
        self.nearest(true)
    }

    /// The type for the machine's own axes: the one in force, if it does not turn the tool, or the first such one.
    pub fn for_axes(self) -> Option<i32> {
        self.nearest(false)
    }

    /// The type in force, or the first one, of those that turn the tool or of the others.
    fn nearest(self, turning: bool) -> Option<i32> {
        core::iter::once(self.number)
            .chain(0..TYPES)
            .find(|number| self.with(*number).turns_tool() == turning)
    }

    /// The number that a pin says; `None` if it cannot be one.
    pub fn on_pin(value: f64) -> Option<i32> {
        let number = value as i32;
        (f64::from(number) == value && (0..TYPES).contains(&number)).then_some(number)
    }
}

/// The bits of a list of types like `0,2`; `None` if it is none.
pub fn tool_types(list: &[u8]) -> Option<u16> {
    if list.is_empty() {
        return Some(0);
    }
    let bit = |word: &[u8]| {
        let number: u32 = core::str::from_utf8(word).ok()?.parse().ok()?;
        1_u16.checked_shl(number)
    };
    list.split(|letter| *letter == b',')
        .try_fold(0, |bits, word| Some(bits | bit(word)?))
}

/// Joints for a position of the program, and what the inner kinematics returned; `axes` become those of the machine.
pub fn inverse(
    frame: Option<&ActiveFrame>,
    inner: &mut impl InnerKinematics,
    axes: &mut Axes,
    joints: &mut [f64; JOINT_COUNT],
) -> i32 {
    if let Some(frame) = frame {
        *axes = frame.to_machine(axes);
    }
    inner.inverse(axes, joints)
}

/// Where the forward kinematics begin that iterate.
#[derive(Clone, Copy, Debug)]
pub enum Guess<'a> {
    /// At the position of the program that motion had before, as if there was no frame.
    Before,
    /// At these axes of the machine: motion's position may be one of another frame, which leads far away.
    At(&'a Axes),
}

/// The position of the program for joints, with the axes of the machine, and what the inner kinematics returned.
/// `position` is the one before, and becomes the new one.
pub fn forward(
    frame: Option<&ActiveFrame>,
    inner: &mut impl InnerKinematics,
    joints: &[f64; JOINT_COUNT],
    guess: Guess<'_>,
    position: &mut Axes,
) -> (Axes, i32) {
    let mut axes = match guess {
        Guess::Before => *position,
        Guess::At(axes) => *axes,
    };
    let result = inner.forward(joints, &mut axes);
    *position = frame.map_or(axes, |frame| frame.to_world(&axes));
    (axes, result)
}

/// Whether they lead back from the place of these joints to others. A switch takes the place from the joints and goes on with
/// the joints of the place, so that these would jump.
///
/// With a frame that comes the way goes through its coordinates, and rounding ends beside the place, where the joints have
/// to be the same: at a straight wrist they are not.
pub fn other_joints(
    inner: &mut impl InnerKinematics,
    coming: Option<&ActiveFrame>,
    axes: &Axes,
    joints: &[f64; JOINT_COUNT],
) -> bool {
    let mut here = *axes;
    if inner.forward(joints, &mut here) != 0 {
        return true;
    }
    let mut leads_away = |place: &Axes, most: f64| {
        let mut back = *joints;
        inner.inverse(place, &mut back) != 0 || !are_within(most, joints, &back)
    };
    let jump_in_it = coming.is_some_and(|frame| {
        let place = frame.to_machine(&frame.to_world(&here));
        let mut beside = (0..AXIS_COUNT).map(|axis| nudged(&place, axis, ROUNDING));
        leads_away(&place, SAME_JOINT) || beside.any(|place| leads_away(&place, TURNED_OVER))
    });
    // Without it last: it has to be able to go again, and some remember where they were asked.
    leads_away(&here, SAME_JOINT) || jump_in_it
}

/// Whether no joint is elsewhere.
pub fn same_joints(joints: &[f64; JOINT_COUNT], others: &[f64; JOINT_COUNT]) -> bool {
    are_within(SAME_JOINT, joints, others)
}

fn are_within(most: f64, joints: &[f64; JOINT_COUNT], others: &[f64; JOINT_COUNT]) -> bool {
    let near = |(one, other): (&f64, &f64)| (one - other).abs() <= most;
    joints.iter().zip(others).all(near)
}

/// Which of X Y Z the machine cannot move, by trying: joints for places on both sides of `axes`, and back from there. An axis
/// for which there are no joints on either side is not known, and is not taken for one that stands.
pub fn fixed_axes(
    inner: &mut impl InnerKinematics,
    axes: &Axes,
    joints: &[f64; JOINT_COUNT],
) -> [bool; 3] {
    // The arm that the machine has with these joints.
    let mut here = *axes;
    inner.forward(joints, &mut here);
    let fixed = [0, 1, 2].map(|axis| is_fixed(inner, axes, joints, axis));
    // Some remember where they were asked last.
    let mut back = *joints;
    inner.inverse(axes, &mut back);
    fixed
}

fn is_fixed(
    inner: &mut impl InnerKinematics,
    axes: &Axes,
    joints: &[f64; JOINT_COUNT],
    axis: usize,
) -> bool {
    let mut stands = false;
    for nudge in [NUDGE, -NUDGE] {
        let (beside, mut found, mut there) = (nudged(axes, axis, nudge), *joints, *axes);
        if inner.inverse(&beside, &mut found) != 0 || inner.forward(&found, &mut there) != 0 {
            continue;
        }
        let moved = value_of(&there, axis) - value_of(axes, axis);
        // A stretched arm cannot reach any farther, and goes back.
        if (moved / nudge).abs() >= 0.5 {
            return false;
        }
        stands = true;
    }
    stands
}

/// A place beside another one.
fn nudged(axes: &Axes, axis: usize, nudge: f64) -> Axes {
    let mut beside = *axes;
    if let Some(value) = beside.get_mut(axis) {
        *value += nudge;
    }
    beside
}

fn value_of(axes: &Axes, axis: usize) -> f64 {
    axes.get(axis).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_types_are_read() {
        assert_eq!(tool_types(b""), Some(0));
        assert_eq!(tool_types(b"0"), Some(1));
        assert_eq!(tool_types(b"0,2,15"), Some(0b1000_0000_0000_0101));
        for nonsense in [&b"16"[..], b"-1", b"a", b"1,", b",", b"0 1", b"0.0"] {
            assert_eq!(tool_types(nonsense), None, "{nonsense:?}");
        }
    }

    #[test]
    fn a_pin_says_a_type_or_none() {
        assert_eq!(InnerType::on_pin(0.0), Some(0));
        assert_eq!(InnerType::on_pin(15.0), Some(15));
        for nonsense in [-1.0, 16.0, 0.5, f64::NAN, f64::INFINITY, 1e300] {
            assert_eq!(InnerType::on_pin(nonsense), None, "{nonsense}");
        }
    }

    #[test]
    fn types_that_are_named_turn_the_tool() {
        let kinds = InnerType::first(0b101);
        let turning = (0..TYPES).filter(|number| kinds.with(*number).turns_tool());
        assert!(turning.eq([0, 2]));
    }

    #[test]
    fn the_type_in_force_is_kept_where_it_will_do() {
        let kinds = InnerType::first(0b110);
        for (number, tool_centre, axes) in [(0, 1, 0), (1, 1, 0), (2, 2, 0), (3, 1, 3)] {
            let kind = kinds.with(number);
            assert_eq!(kind.for_tool_centre(), Some(tool_centre), "{number}");
            assert_eq!(kind.for_axes(), Some(axes), "{number}");
        }
        assert_eq!(InnerType::first(0b1).for_axes(), Some(1));
        assert_eq!(InnerType::first(0).for_tool_centre(), None);
        assert_eq!(InnerType::first(u16::MAX).for_axes(), None);
    }
}
