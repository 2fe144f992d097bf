//! What the tests of `framepath plan` share.

pub use crate::bench::{Bench, number};
use crate::bench::{json, refusal};
use serde_json::Value;
use std::process::Output;

/// A three-axis mill in mm: 100 mm/s, 1000 mm/s2, 20000 mm/s3; Z slower.
pub const MILL: &str = "\
[EMC]
MACHINE = Test mill
[EMCMOT]
SERVO_PERIOD = 1000000
[TRAJ]
LINEAR_UNITS = mm
COORDINATES = XYZ
[KINS]
KINEMATICS = trivkins coordinates=XYZ
[RS274NGC]
RS274NGC_STARTUP_CODE = G61.1 G21
[AXIS_X]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[AXIS_Y]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[AXIS_Z]
MAX_VELOCITY = 50
MAX_ACCELERATION = 500
MAX_JERK = 5000
[JOINT_0]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
[JOINT_1]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
[JOINT_2]
MAX_VELOCITY = 50
MAX_ACCELERATION = 500
";

impl Bench {
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path().join(name)).expect("a file")
    }

    /// Runs `framepath plan`.
    pub fn plan(&self, arguments: &[&str]) -> Output {
        self.run("plan", arguments)
    }

    /// The figures of a program.
    pub fn figures(&self, program: &str, more: &[&str]) -> Value {
        self.write("part.ngc", program);
        let mut all = json(&self.plan(&[&["part.ngc", "--json"], more].concat()));
        all["programs"][0].take()
    }

    /// The same on a machine with this INI file.
    pub fn figures_on(&self, ini: &str, program: &str) -> Value {
        self.write("mill.ini", ini);
        self.figures(program, &["--ini", "mill.ini"])
    }

    /// What a run that is refused says.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let output = self.plan(arguments);
        assert_eq!(output.status.code(), Some(1));
        refusal(output)
    }
}

/// Seconds of a share of the time.
pub fn time_of(shares: &Value, name: &str) -> f64 {
    let shares = shares.as_array().expect("shares");
    let found = shares.iter().find(|share| share["name"] == name);
    found.map_or(0.0, |share| number(&share["time"]))
}
