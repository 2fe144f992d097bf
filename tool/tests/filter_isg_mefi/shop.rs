//! Running the filter on programs that the tests write.

use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::part_program::contour;
use framepath_tool::program::contour::ContourMove;
use framepath_tool::program::trace::Setup;
use std::path::PathBuf;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder with programs; the first file is the program that is run.
pub struct Shop {
    folder: TempDir,
    dialect: Dialect,
    program: String,
}

impl Shop {
    /// With one program.
    pub fn with(dialect: Dialect, program: &str) -> Shop {
        Shop::new(dialect, &[("part.nc", program)])
    }

    /// With these files.
    pub fn new(dialect: Dialect, files: &[(&str, &str)]) -> Shop {
        let folder = TempDir::new().expect("a temporary folder");
        for (name, content) in files {
            std::fs::write(folder.path().join(name), content).expect("a file");
        }
        Shop {
            folder,
            dialect,
            program: files[0].0.to_string(),
        }
    }

    /// Path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Runs `framepath filter --dialect .. ARGUMENTS PROGRAM`.
    pub fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(self.folder.path())
            .args(["filter", "--dialect", self.dialect.name()])
            .args(arguments)
            .arg(&self.program)
            .output()
            .expect("the tool runs")
    }

    /// What the tool writes; fails when it refuses the program.
    pub fn accepted(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "refused:\n{errors}");
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// The error text; fails when the tool accepts the program or writes half of it.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "accepted:\n{text}");
        assert!(text.is_empty(), "half a program was written:\n{text}");
        String::from_utf8(output.stderr).expect("UTF-8")
    }

    /// The contour of the program, machine coordinates.
    pub fn contour(&self) -> Vec<ContourMove> {
        let path = self.path(&self.program);
        contour(self.dialect, &path, &Settings::default(), &Setup::default())
            .unwrap_or_else(|refused| panic!("{refused}"))
    }
}
