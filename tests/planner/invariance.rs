//! The same program takes the same time whatever the units, the servo period, and the directions
//! of the axes.

use crate::common::with_room;
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, StateTag, TerminationCondition};
use framepath::planner::{Added, CycleInputs, MoveRequest, Planner};
use nalgebra::Vector3;

/// Both take or leave half a percent.
const DIFFERENCE: f64 = 5e-3;

#[derive(Clone, Debug)]
enum Step {
    Line(Vector3<f64>),
    /// End, centre, and the sense of the turn about Z: 1 or -1.
    Arc(Vector3<f64>, Vector3<f64>, f64),
}

/// How a program is given to the planner.
#[derive(Clone, Debug)]
struct Setting {
    period: f64,
    /// Machine units in a millimetre.
    millimetre: f64,
    /// Which axis takes X, Y, Z.
    order: [usize; 3],
    /// Factor of each, 1 or -1.
    sign: [f64; 3],
}

const PLAIN: Setting = Setting {
    period: 1e-3,
    millimetre: 1.0,
    order: [0, 1, 2],
    sign: [1.0; 3],
};

impl Setting {
    fn vector(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let mut result = Vector3::zeros();
        for ((value, to), sign) in v.iter().zip(self.order).zip(self.sign) {
            result[to] = value * sign * self.millimetre;
        }
        result
    }

    /// Right-handed turns stay so, or are reversed.
    fn handedness(&self) -> f64 {
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()].map(|v| self.vector(&v));
        x.cross(&y).dot(&z).signum()
    }

    /// Seconds from the first to the last motion.
    fn time(&self, program: &[Step], jerk: f64, tolerance: f64) -> f64 {
        with_room(|| {
            let scaled = |value: f64| Axes::repeat(value * self.millimetre);
            let mut planner = Planner::new();
            assert!(planner.set_cycle_time(self.period));
            planner.set_limits(&AxisLimits {
                velocity: scaled(100.0),
                acceleration: scaled(1000.0),
                jerk: scaled(jerk),
            });
            planner
                .set_blending(self.millimetre, 0.0, 0.02 * self.millimetre)
                .expect("sound");
            planner.set_termination(TerminationCondition::Continuous {
                tolerance: tolerance * self.millimetre,
            });
            let request = MoveRequest {
                motion_type: MotionType::Feed,
                feed: 100.0 * self.millimetre,
                max_velocity: 1e3 * self.millimetre,
                path_jerk: f64::INFINITY,
                enables: 0x0f,
                wait_for_spindle: false,
                indexer_joint: None,
                tag: StateTag::EMPTY,
            };
            let mut program = program.iter();
            let (mut moving, mut still) = (0, true);
            for _ in 0..200_000 {
                let added = match program.next() {
                    None => Added::Queued,
                    Some(Step::Line(end)) => {
                        let end = axes(&self.vector(end));
                        planner.add_line(&end, &request).expect("a line")
                    }
                    Some(Step::Arc(end, center, sense)) => {
                        let normal = self.vector(&Vector3::z()).normalize();
                        let circle = Circle {
                            center: self.vector(center),
                            normal: normal * *sense * self.handedness(),
                            revolutions: 0,
                        };
                        let end = axes(&self.vector(end));
                        planner.add_circle(&end, &circle, &request).expect("an arc")
                    }
                };
                assert_eq!(added, Added::Queued);
                let before = planner.status().position;
                let status = *planner.cycle(&CycleInputs::default());
                assert_eq!(status.fault, None);
                still &= before == status.position;
                moving += usize::from(!still);
                if status.done && program.len() == 0 {
                    return moving as f64 * self.period;
                }
            }
            panic!("not done");
        })
    }
}

fn axes(v: &Vector3<f64>) -> Axes {
    let mut axes = Axes::zeros();
    axes.fixed_rows_mut::<3>(0).copy_from(v);
    axes
}

fn zigzag() -> Vec<Step> {
    (1..=30)
        .map(|n| {
            let n = f64::from(n);
            Step::Line(Vector3::new(7.0 * n, 11.0 * (n % 2.0), 3.0 * (n % 3.0)))
        })
        .collect()
}

fn slots() -> Vec<Step> {
    let mut steps = Vec::new();
    for n in 0..8 {
        let y = 12.0 * f64::from(n);
        let corner = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        steps.push(Step::Line(corner(30.0, y)));
        steps.push(Step::Arc(corner(30.0, y + 6.0), corner(30.0, y + 3.0), 1.0));
        steps.push(Step::Line(corner(0.0, y + 6.0)));
        steps.push(Step::Arc(corner(0.0, y + 12.0), corner(0.0, y + 9.0), -1.0));
    }
    steps
}

/// 0.6 mm a move, so that one each 2 ms is enough.
fn contour() -> Vec<Step> {
    (1..=1200)
        .map(|n| {
            let s = 0.6 * f64::from(n);
            Step::Line(Vector3::new(
                40.0 * (s / 40.0).sin(),
                9.0 * (s / 13.0).sin(),
                s / 60.0,
            ))
        })
        .collect()
}

#[test]
fn times_do_not_depend_on_how_the_program_is_given() {
    let inches = Setting {
        millimetre: 1.0 / 25.4,
        ..PLAIN
    };
    let mirrored = Setting {
        sign: [-1.0, 1.0, 1.0],
        ..PLAIN
    };
    let turned = Setting {
        order: [1, 0, 2],
        sign: [1.0, -1.0, 1.0],
        ..PLAIN
    };
    let reversed = Setting {
        order: [2, 1, 0],
        ..PLAIN
    };
    let settings = [
        ("inches", inches),
        ("mirrored", mirrored),
        ("turned by 90 degrees", turned),
        ("axes in reversed order", reversed),
    ];
    for (name, program, tolerance) in [
        ("zig-zag", zigzag(), 0.05),
        ("slots", slots(), 0.02),
        ("contour", contour(), 0.01),
    ] {
        for jerk in [20_000.0, f64::INFINITY] {
            let plain = PLAIN.time(&program, jerk, tolerance);
            for (change, setting) in &settings {
                let time = setting.time(&program, jerk, tolerance);
                println!("{name}, jerk {jerk}, {change}: {time} s, plain {plain} s");
                assert!(
                    (time / plain - 1.0).abs() < DIFFERENCE,
                    "{name}, jerk {jerk}, {change}: {time} s, plain {plain} s"
                );
            }
        }
    }
}

#[test]
fn times_do_not_depend_on_the_servo_period() {
    for (name, program, tolerance) in [
        ("zig-zag", zigzag(), 0.05),
        ("slots", slots(), 0.02),
        ("contour", contour(), 0.01),
    ] {
        let plain = PLAIN.time(&program, 20_000.0, tolerance);
        for period in [0.25e-3, 0.5e-3, 2e-3] {
            let time = Setting { period, ..PLAIN }.time(&program, 20_000.0, tolerance);
            println!("{name}, {period} s: {time} s, plain {plain} s");
            assert!(
                (time / plain - 1.0).abs() < DIFFERENCE,
                "{name}, period {period} s: {time} s, plain {plain} s"
            );
        }
    }
}
