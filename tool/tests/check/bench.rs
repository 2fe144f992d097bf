//! A copy of the samples to change and to look at.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// Names of the samples.
pub const SAMPLES: [&str; 8] = [
    "framepath-sim",
    "framepath-fagor",
    "framepath-isg",
    "framepath-mefi",
    "framepath-xyzac",
    "framepath-lathe",
    "framepath-gantry",
    "framepath-inch",
];

/// Where users get them.
pub fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../hal-component")
}

/// The version of the LinuxCNC of the tests.
pub const VERSION: &str = "2.9.4";

/// A LinuxCNC with both modules, as far as `check` looks at it: the folder of its script `linuxcnc` and of its modules.
pub fn linuxcnc(folder: &Path) {
    let script = format!(
        "LINUXCNC_RTLIB_DIR={}\nLINUXCNCVERSION=\"{VERSION}\"; export LINUXCNCVERSION\n",
        folder.display()
    );
    fs::write(folder.join("linuxcnc"), script).expect("written");
    for module in ["blendtp", "framekins"] {
        build_module(folder, module, VERSION);
    }
}

/// A module that says that it is built for a LinuxCNC.
pub fn build_module(folder: &Path, module: &str, version: &str) {
    let text = format!("\0framepath built for LinuxCNC {version}\0");
    fs::write(folder.join(format!("{module}.so")), text).expect("written");
}

/// Runs `framepath` in a folder, with itself and a LinuxCNC in PATH.
pub fn framepath(folder: &Path, arguments: &[&str]) -> Output {
    static LINUXCNC: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
        let folder = tempfile::tempdir().expect("a folder");
        linuxcnc(folder.path());
        folder
    });
    framepath_with(LINUXCNC.path(), folder, arguments)
}

/// The same with another LinuxCNC.
pub fn framepath_with(linuxcnc: &Path, folder: &Path, arguments: &[&str]) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_framepath"));
    let own = program.parent().expect("a folder").display();
    Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .env(
            "PATH",
            format!("{}:{own}:/usr/bin:/bin", linuxcnc.display()),
        )
        .output()
        .expect("framepath runs")
}

/// A folder with the files of the samples.
pub struct Bench {
    folder: tempfile::TempDir,
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        match path.is_dir() {
            true => copy(&path, &target),
            false => drop(fs::copy(&path, &target).expect("copied")),
        }
    }
}

impl Bench {
    pub fn new() -> Bench {
        let folder = tempfile::tempdir().expect("a folder");
        for part in ["configs", "panel", "preview", "subroutines"] {
            copy(&samples().join(part), &folder.path().join(part));
        }
        Bench { folder }
    }

    /// The folder of a sample.
    pub fn sample(&self, name: &str) -> PathBuf {
        self.folder.path().join("configs").join(name)
    }

    /// A file of a sample: its INI or HAL file.
    pub fn file(&self, name: &str, ending: &str) -> PathBuf {
        self.sample(name).join(format!("{name}.{ending}"))
    }

    pub fn read(&self, name: &str, ending: &str) -> String {
        fs::read_to_string(self.file(name, ending)).expect("a text")
    }

    pub fn write(&self, name: &str, ending: &str, text: &str) {
        fs::write(self.file(name, ending), text).expect("written");
    }

    /// `framepath check` of a sample.
    pub fn check(&self, name: &str, options: &[&str]) -> Output {
        let ini = format!("{name}.ini");
        let mut arguments = vec!["check", &ini];
        arguments.extend_from_slice(options);
        framepath(&self.sample(name), &arguments)
    }

    /// The findings of a sample.
    pub fn findings(&self, name: &str) -> Vec<Value> {
        let output = self.check(name, &["--json"]);
        let text = String::from_utf8(output.stdout).expect("a text");
        let report: Value = serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}"));
        let findings = report["findings"].as_array().expect("findings").clone();
        let errors = findings
            .iter()
            .filter(|finding| finding["level"] == "error")
            .count();
        assert_eq!(output.status.code(), Some(i32::from(errors > 0)), "{text}");
        findings
    }

    /// The findings when `from` is replaced by `to` in a file of framepath-sim, or of `name`.
    pub fn changed(&self, name: &str, ending: &str, from: &str, to: &str) -> Vec<Value> {
        let before = self.read(name, ending);
        let after = before.replacen(from, to, 1);
        assert_ne!(before, after, "{from} is not there");
        self.write(name, ending, &after);
        let findings = self.findings(name);
        self.write(name, ending, &before);
        findings
    }
}
