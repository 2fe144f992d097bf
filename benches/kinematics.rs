//! What the kinematics cost in the servo thread, next to LinuxCNC's own: goals 100 ns for an inverse
//! with a frame, 200 ns for a forward.

mod machines;
mod stock;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use framepath::abi::linuxcnc::{EmcPose, PmCartesian};
use framepath::axes::Axes;
use framepath::machine::{Coordinates, Identity, JOINT_COUNT, Machine, TiltAxis};
use machines::{frame, table};
use stock::StockKinematics;

fn identity() -> Machine {
    Machine::Identity(Identity::new(Coordinates::parse(b"XYZ").unwrap()))
}

fn kinematics(c: &mut Criterion) {
    let frame = frame();
    let world = Axes::from([12.0, 34.0, 56.0, 27.0, 0.0, 123.0, 0.0, 0.0, 0.0]);
    for (name, machine) in [
        ("identity", identity()),
        ("table tilting", table(TiltAxis::A, b"XYZAC")),
    ] {
        let mut joints = [0.0; JOINT_COUNT];
        c.bench_function(&format!("inverse, {name}"), |b| {
            b.iter(|| machine.inverse(black_box(&world), &mut joints));
        });
        c.bench_function(&format!("forward, {name}"), |b| {
            b.iter(|| machine.forward(black_box(&joints)));
        });
        c.bench_function(&format!("inverse with frame, {name}"), |b| {
            b.iter(|| machine.inverse(&frame.to_machine(black_box(&world)), &mut joints));
        });
        c.bench_function(&format!("forward with frame, {name}"), |b| {
            b.iter(|| frame.to_world(&machine.forward(black_box(&joints))));
        });
    }
}

fn linuxcnc(c: &mut Criterion) {
    let tran = PmCartesian {
        x: 12.0,
        y: 34.0,
        z: 56.0,
    };
    let mut world = EmcPose {
        tran,
        a: 27.0,
        b: 0.0,
        c: 123.0,
        u: 0.0,
        v: 0.0,
        w: 0.0,
    };
    for (name, coordinates) in [("trivkins", "XYZ"), ("xyzac-trt-kins", "XYZAC")] {
        let module = StockKinematics::load(name, coordinates);
        let mut joints = [0.0; JOINT_COUNT];
        c.bench_function(&format!("inverse, LinuxCNC's {name}"), |b| {
            b.iter(|| module.inverse(black_box(&world), &mut joints));
        });
        c.bench_function(&format!("forward, LinuxCNC's {name}"), |b| {
            b.iter(|| module.forward(black_box(&joints), &mut world));
        });
    }
}

criterion_group!(benches, kinematics, linuxcnc);
criterion_main!(benches);
