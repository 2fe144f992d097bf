//! Limits of axes above those of the joints that these are.

use crate::support::{Bench, MILL};

#[test]
fn joints_are_judged_by_their_own_limits() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 G90 F60000\nG1 X100\nM2\n");
    let above = MILL.replacen("MAX_ACCELERATION = 1000", "MAX_ACCELERATION = 2000", 1);
    bench.write("mill.ini", &above);
    let machine = ["part.ngc", "--ini", "mill.ini", "--check"];
    let output = bench.plan(&machine);
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(1), "{told}");
    let warning = "warning: mill.ini:14:1: [AXIS_X]MAX_ACCELERATION = 2000 asks more of the joint than \
                   [JOINT_0]MAX_ACCELERATION = 1000: write MAX_ACCELERATION = 1000\n";
    assert!(told.starts_with(warning), "{told}");
    let judged = "not kept: part.ngc: joint.0: acceleration is 1.4";
    let reason = "line 2: [AXIS_X]MAX_ACCELERATION = 2000 is above it\n";
    assert!(told.contains(judged) && told.ends_with(reason), "{told}");
    // Y keeps to both.
    bench.write("part.ngc", "G21 G90 F60000\nG1 Y100\nM2\n");
    assert!(bench.plan(&machine).status.success());
    // In place of what the axes have.
    let output = bench.plan(&[&machine[..], &["--limits", "A=1000"]].concat());
    assert!(output.status.success() && output.stderr.is_empty());
}
