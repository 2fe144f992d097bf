//! What the tests of `framepath compare` share.

use crate::bench::refusal;
pub use crate::bench::{Bench, json, number};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// LinuxCNC's own planner.
pub const STOCK: &str = "/usr/lib/linuxcnc/modules/tpmod.so";

impl Bench {
    /// Compiles planner.c with this fault (none: empty) into a module.
    pub fn module(&self, fault: &str) -> PathBuf {
        self.compile("planner.c", fault)
    }

    pub fn compile(&self, source: &str, fault: &str) -> PathBuf {
        let module = self.path().join(format!("made-up{fault}.so"));
        let source = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/compare")
            .join(source);
        let status = Command::new("cc")
            .args([
                "-shared",
                "-fPIC",
                "-O1",
                "-DRTAPI",
                "-DUSPACE",
                "-D__MODULE__",
            ])
            .arg(format!("-DFAULT_{fault}"))
            .args(["-isystem", "/usr/include/linuxcnc", "-o"])
            .args([&module, &source])
            .arg("-lm")
            .status()
            .expect("cc runs");
        assert!(status.success());
        module
    }

    /// Runs `framepath compare`.
    pub fn compare(&self, arguments: &[&str]) -> Output {
        self.run("compare", arguments)
    }

    /// The figures of a module on a program.
    pub fn measure(&self, program: &str, module: &Path, more: &[&str]) -> Value {
        let file = self.write("program.ngc", program);
        let mut arguments = vec![
            file.to_str().expect("text"),
            "--with",
            module.to_str().expect("text"),
            "--json",
        ];
        arguments.extend(more);
        let output = self.compare(&arguments);
        let mut report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        report["programs"][0]["runs"][0].take()
    }

    /// What a run that is refused says.
    pub fn refused(&self, arguments: &[&str]) -> String {
        refusal(self.compare(arguments))
    }
}

/// Asserts that a number is within `within` of what is expected.
#[track_caller]
pub fn assert_near(value: &Value, expected: f64, within: f64) {
    let found = number(value);
    assert!(
        (found - expected).abs() <= within,
        "{found}, expected {expected}"
    );
}
