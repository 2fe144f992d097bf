//! Frames composed with kinematics that iterate, remember, or lack an axis.

use crate::common::Motion;
use framepath::axes::Axes;
use framepath::kinematics::inner::{
    Guess, InnerKinematics, fixed_axes, forward, inverse, other_joints,
};

/// Joints are the axes times two, of which Y may be none. The forward kinematics go from the guess at most one unit.
struct Halving {
    has_y: bool,
    fails: bool,
    asked: Vec<Axes>,
}

impl Halving {
    fn new(has_y: bool) -> Self {
        Self {
            has_y,
            fails: false,
            asked: Vec::new(),
        }
    }
}

impl InnerKinematics for Halving {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; 16]) -> i32 {
        self.asked.push(*axes);
        joints[0] = axes[0] * 2.0;
        joints[2] = axes[2] * 2.0;
        if self.has_y {
            joints[1] = axes[1] * 2.0;
        }
        if self.fails { -3 } else { 0 }
    }

    fn forward(&mut self, joints: &[f64; 16], axes: &mut Axes) -> i32 {
        for axis in (0..3).filter(|axis| self.has_y || *axis != 1) {
            let step = joints[axis] / 2.0 - axes[axis];
            axes[axis] += step.clamp(-1.0, 1.0);
        }
        0
    }
}

fn at(x: f64, y: f64, z: f64) -> Axes {
    Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// Shifted by a metre in X.
fn shifted() -> Motion {
    let mut motion = Motion::new("identity", "XYZ");
    assert_eq!(motion.send(1, [1000.0, 0.0, 0.0]), None);
    motion
}

#[test]
fn joints_are_those_of_the_framed_position() {
    let (motion, mut inner) = (shifted(), Halving::new(true));
    let (mut axes, mut joints) = (at(1.0, 2.0, 3.0), [9.0; 16]);
    let result = inverse(motion.control.active(), &mut inner, &mut axes, &mut joints);
    assert_eq!((result, axes), (0, at(1001.0, 2.0, 3.0)));
    assert_eq!(joints[..4], [2002.0, 4.0, 6.0, 9.0]);
    inner.fails = true;
    let result = inverse(None, &mut inner, &mut axes, &mut joints);
    assert_eq!((result, axes), (-3, at(1001.0, 2.0, 3.0)));
}

#[test]
fn a_guess_at_the_machine_leads_where_one_of_another_frame_does_not() {
    let (motion, mut inner) = (shifted(), Halving::new(true));
    let mut joints = [0.0; 16];
    joints[..3].copy_from_slice(&[2002.0, 4.0, 6.0]);
    let (near, frame) = (at(1000.5, 1.5, 2.5), motion.control.active());
    let mut position = at(0.0, 0.0, 0.0);
    let (axes, result) = forward(frame, &mut inner, &joints, Guess::At(&near), &mut position);
    assert_eq!((result, axes), (0, at(1001.0, 2.0, 3.0)));
    assert_eq!(position, at(1.0, 2.0, 3.0));
    let mut position = at(0.0, 0.0, 0.0);
    let (axes, _) = forward(frame, &mut inner, &joints, Guess::Before, &mut position);
    assert_ne!(axes, at(1001.0, 2.0, 3.0));
}

#[test]
fn without_a_frame_nothing_is_touched() {
    let mut inner = Halving::new(false);
    let mut position = at(0.1 + 0.2, -0.0, f64::MIN_POSITIVE);
    let (axes, _) = forward(None, &mut inner, &[0.0; 16], Guess::Before, &mut position);
    assert_eq!(position.map(f64::to_bits), axes.map(f64::to_bits));
    assert_eq!(position[1].to_bits(), (-0.0_f64).to_bits());
}

#[test]
fn an_axis_that_stands_is_found_and_the_kinematics_are_asked_last_where_the_machine_is() {
    let here = at(10.0, 0.0, -4.0);
    let joints = {
        let mut joints = [0.0; 16];
        joints[..3].copy_from_slice(&[20.0, 0.0, -8.0]);
        joints
    };
    for has_y in [true, false] {
        let mut inner = Halving::new(has_y);
        assert_eq!(
            fixed_axes(&mut inner, &here, &joints),
            [false, !has_y, false]
        );
        assert_eq!(inner.asked.last(), Some(&here));
    }
}

#[test]
fn an_axis_that_is_not_known_is_not_taken_for_one_that_stands() {
    let mut inner = Halving::new(false);
    inner.fails = true;
    assert_eq!(
        fixed_axes(&mut inner, &at(0.0, 0.0, 0.0), &[0.0; 16]),
        [false; 3]
    );
}

/// An arm with its wrist straight: beside the place where it is, the wrist turns over.
struct StraightWrist;

impl InnerKinematics for StraightWrist {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; 16]) -> i32 {
        if joints[..3] != axes.as_slice()[..3] {
            joints[3] += 79.0;
            joints[5] -= 79.0;
        }
        joints[..3].copy_from_slice(&axes.as_slice()[..3]);
        0
    }

    fn forward(&mut self, joints: &[f64; 16], axes: &mut Axes) -> i32 {
        axes.as_mut_slice()[..3].copy_from_slice(&joints[..3]);
        0
    }
}

/// An arm of two parts, 100 together, with its elbow in degrees: what is too far is taken for stretched.
struct Elbow;

impl InnerKinematics for Elbow {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; 16]) -> i32 {
        let reach = axes[0].hypot(axes[1]);
        joints[0] = axes[1].atan2(axes[0]).to_degrees();
        joints[1] = 2.0 * (reach / 100.0).min(1.0).acos().to_degrees();
        joints[2] = axes[2];
        0
    }

    fn forward(&mut self, joints: &[f64; 16], axes: &mut Axes) -> i32 {
        let reach = 100.0 * (joints[1] / 2.0).to_radians().cos();
        let (sine, cosine) = joints[0].to_radians().sin_cos();
        (axes[0], axes[1], axes[2]) = (reach * cosine, reach * sine, joints[2]);
        0
    }
}

#[test]
fn a_frame_does_not_come_where_rounding_turns_a_wrist_over() {
    let joints = {
        let mut joints = [0.0; 16];
        joints[..3].copy_from_slice(&[517.3, 0.1, 203.7]);
        joints
    };
    let here = at(517.3, 0.1, 203.7);
    // without a frame the place is the same to the last bit
    assert!(!other_joints(&mut StraightWrist, None, &here, &joints));
    // by a shift it may be as well, by luck
    for (code, value) in [(2, [0.0, 0.0, 30.0]), (1, [10.0, 0.0, 0.0]), (1, [0.0; 3])] {
        let mut motion = Motion::new("identity", "XYZ");
        assert_eq!(motion.send(code, value), None);
        let coming = motion.control.active();
        assert!(other_joints(&mut StraightWrist, coming, &here, &joints));
        assert!(!other_joints(&mut Halving::new(true), coming, &here, &{
            let mut twice = joints;
            twice[..3].iter_mut().for_each(|joint| *joint *= 2.0);
            twice
        }));
    }
}

#[test]
fn a_stretched_arm_has_its_axes_and_takes_frames() {
    let (here, joints) = (at(100.0, 0.0, 5.0), {
        let mut joints = [0.0; 16];
        joints[2] = 5.0;
        joints
    });
    assert_eq!(fixed_axes(&mut Elbow, &here, &joints), [false; 3]);
    let mut motion = Motion::new("identity", "XYZ");
    assert_eq!(motion.send(2, [0.0, 0.0, 30.0]), None);
    assert!(!other_joints(
        &mut Elbow,
        motion.control.active(),
        &here,
        &joints
    ));
}
