//! Where a plan begins: with the joints at home.

use crate::support::{Bench, MILL, number};

/// A linear delta whose carriages stand 270 mm up.
fn delta(kinematics: &str) -> String {
    MILL.replace("trivkins coordinates=XYZ", kinematics)
        .replace("[JOINT_0]", "[JOINT_0]\nHOME = 270")
        .replace("[JOINT_1]", "[JOINT_1]\nHOME = 270")
        .replace("[JOINT_2]", "[JOINT_2]\nHOME = 270")
}

const PROGRAM: &str = "G21 G90 G53 G0 X0 Y0 Z15\nM2\n";

#[test]
fn kinematics_say_where_the_machine_is_with_its_joints_at_home() {
    let figures = Bench::new().figures_on(&delta("lineardeltakins"), PROGRAM);
    let axes = figures["axes"].as_array().expect("axes");
    let names: Vec<&str> = axes
        .iter()
        .filter_map(|axis| axis["name"].as_str())
        .collect();
    assert_eq!(names, ["axis.z"]);
    // by hand: rods of 269 mm to a circle of 130.25 mm
    let height = 270.0 - (269.0_f64.powi(2) - 130.25_f64.powi(2)).sqrt();
    let top = number(&axes[0]["to"]);
    assert!((top - height).abs() < 1e-6, "{top} {height}");
}

#[test]
fn kinematics_that_cannot_be_asked_are_told() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write("delta.ini", &delta("nowherekins"));
    let output = bench.plan(&["part.ngc", "--ini", "delta.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{told}");
    assert!(
        told.starts_with("warning: delta.ini: [KINS]KINEMATICS: where the machine is with its joints at [JOINT_n]HOME is not known, since nowherekins"),
        "{told}"
    );
}
