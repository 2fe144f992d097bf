//! What the tests of `framepath compare` share.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// LinuxCNC's own planner.
pub const STOCK: &str = "/usr/lib/linuxcnc/modules/tpmod.so";

/// A folder for programs and modules of a test.
pub struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    pub fn new() -> Bench {
        Bench {
            folder: tempfile::tempdir().expect("a folder"),
        }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a program.
    pub fn program(&self, name: &str, text: &str) -> PathBuf {
        let file = self.path().join(name);
        std::fs::write(&file, text).expect("written");
        file
    }

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
        Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(self.path())
            .arg("compare")
            .args(arguments)
            .output()
            .expect("the program runs")
    }

    /// The figures of a module on a program.
    pub fn measure(&self, program: &str, module: &Path, more: &[&str]) -> Value {
        let file = self.program("program.ngc", program);
        let mut arguments = vec![
            file.to_str().expect("text"),
            "--with",
            module.to_str().expect("text"),
            "--json",
        ];
        arguments.extend(more);
        let mut report = json(&self.compare(&arguments));
        report["programs"][0]["runs"][0].take()
    }

    /// What a run that is refused says; there is nothing on standard output then.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let output = self.compare(arguments);
        assert!(!output.status.success());
        assert!(output.stdout.is_empty());
        String::from_utf8(output.stderr).expect("text")
    }
}

/// The JSON of a run that succeeded.
pub fn json(output: &Output) -> Value {
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaints}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A number of a report.
pub fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
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
