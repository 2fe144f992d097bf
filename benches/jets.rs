//! What a jet costs, three derivatives of the joints at a place of the path: goal 900 ns, exact for our machines behind a frame,
//! by numbers for LinuxCNC's. One inverse of the module is measured beside: a jet by numbers asks for some of them.

mod machines;
mod stock;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use framepath::abi::linuxcnc::KINEMATICS_TYPE;
use framepath::abi::planner::joint_kinematics::JointKinematics;
use framepath::abi::planner::kinematics_module::KinematicsModule;
use framepath::axes::{Axes, AxisLimits};
use framepath::frame::ActiveFrame;
use framepath::machine::{Coordinates, Identity, JOINT_COUNT, Machine, TiltAxis};
use framepath::machine_map::JointMap;
use machines::{frame, table};
use stock::StockKinematics;

/// What is the same wherever a jet is measured.
struct Place {
    position: Axes,
    /// By the path: a curve of 20 mm on which all axes move.
    derivatives: [Axes; 3],
    /// What a unit of each is of the limit of a joint.
    shares: [Axes; 3],
}

impl Place {
    /// Of a machine that tilts about this axis, 3 for A, 4 for B.
    fn tilting(tilt: usize) -> Self {
        let along = |x: f64, y: f64, z: f64, tilted: f64, c: f64| {
            let mut axes = Axes::from([x, y, z, 0.0, 0.0, c, 0.0, 0.0, 0.0]);
            axes[tilt] = tilted;
            axes
        };
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let joints = JointMap::new(|_, derivatives, _| *derivatives, &limits, 0.0);
        Self {
            position: along(12.0, 34.0, 56.0, 27.0, 123.0),
            derivatives: [
                along(0.8, 0.5, -0.3, 0.4, -0.6),
                along(0.03, -0.05, 0.01, 0.02, 0.03),
                along(-0.002, -0.001, 0.001, 0.003, -0.001),
            ],
            shares: *joints.shares(),
        }
    }
}

/// What framekins answers blendtp: the joints behind the frame.
fn exact(machine: &Machine, frame: &ActiveFrame, place: &Place) -> [Axes; 3] {
    let position = frame.to_machine(&place.position);
    let derivatives = place
        .derivatives
        .map(|derivative| frame.derivative_to_machine(&derivative));
    machine.joint_derivatives(&position, &derivatives)
}

fn exact_jets(c: &mut Criterion) {
    let frame = frame();
    let identity = Machine::Identity(Identity::new(Coordinates::parse(b"XYZAC").unwrap()));
    for (name, machine, tilt) in [
        ("identity", identity, 3),
        ("xyzac", table(TiltAxis::A, b"XYZAC"), 3),
        ("xyzbc", table(TiltAxis::B, b"XYZBC"), 4),
    ] {
        let place = Place::tilting(tilt);
        c.bench_function(&format!("jet, exact, {name}"), |b| {
            b.iter(|| exact(black_box(&machine), &frame, black_box(&place)));
        });
    }
}

fn numerical_jets(c: &mut Criterion) {
    for (name, coordinates, tilt) in [
        ("xyzac-trt-kins", "XYZAC", 3),
        ("xyzbc-trt-kins", "XYZBC", 4),
        ("5axiskins", "XYZBCW", 4),
    ] {
        let stock = StockKinematics::load(name, coordinates);
        let module = KinematicsModule::new(
            Some(stock.inverse),
            Some(stock.forward),
            KINEMATICS_TYPE::KINEMATICS_BOTH,
        );
        let joints = JointKinematics::of(module);
        let place = Place::tilting(tilt);
        let near = [0.0; JOINT_COUNT];
        c.bench_function(&format!("jet, one inverse, {name}"), |b| {
            b.iter(|| joints.joints(black_box(&place.position), &near));
        });
        c.bench_function(&format!("jet, by numbers, {name}"), |b| {
            b.iter(|| {
                let Place {
                    position,
                    derivatives,
                    shares,
                } = black_box(&place);
                joints.by_numbers(position, derivatives, shares)
            });
        });
    }
}

criterion_group!(benches, exact_jets, numerical_jets);
criterion_main!(benches);
