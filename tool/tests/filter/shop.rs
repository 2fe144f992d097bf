//! Running the filter on programs that the tests write.

use std::path::PathBuf;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder with programs.
pub struct Shop {
    folder: TempDir,
}

impl Shop {
    /// With these files; the first is the program.
    pub fn new(files: &[(&str, &[u8])]) -> Shop {
        let folder = TempDir::new().expect("a temporary folder");
        let shop = Shop { folder };
        for (name, content) in files {
            let path = shop.path(name);
            std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
            std::fs::write(path, content).expect("a file");
        }
        shop
    }

    /// Path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Runs `framepath filter --dialect sinumerik ARGUMENTS NAME`.
    pub fn run(&self, name: &str, arguments: &[&str]) -> Output {
        self.run_in("sinumerik", name, arguments)
    }

    /// Runs `framepath filter NAME`.
    pub fn run_without_dialect(&self, name: &str) -> Output {
        self.filter(&[], name, &[])
    }

    /// Runs `framepath filter --dialect DIALECT ARGUMENTS NAME`.
    pub fn run_in(&self, dialect: &str, name: &str, arguments: &[&str]) -> Output {
        self.filter(&["--dialect", dialect], name, arguments)
    }

    fn filter(&self, dialect: &[&str], name: &str, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(self.folder.path())
            .arg("filter")
            .args(dialect)
            .args(arguments)
            .arg(name)
            .output()
            .expect("the tool runs")
    }
}

/// The output for a program without subprogram files; fails when it is refused.
pub fn translate(program: &str, arguments: &[&str]) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    accepted(&shop.run("part.mpf", arguments))
}

/// The output of a run that must have succeeded.
pub fn accepted(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "refused:\n{errors}");
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

/// The error text of a run that must have been refused, with nothing on standard output.
pub fn refused(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "accepted:\n{text}");
    assert!(text.is_empty(), "half a program was written:\n{text}");
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// The lines of an output that move or command something: without comments, numbers and header.
pub fn commands(output: &str) -> Vec<String> {
    output
        .lines()
        .map(|line| {
            let code = match line.contains("(MSG,") {
                true => line,
                false => line.split('(').next().unwrap_or(""),
            };
            let words = code.split_whitespace().filter(|word| {
                let number = word.strip_prefix('N').unwrap_or("");
                number.is_empty() || !number.chars().all(|c| c.is_ascii_digit())
            });
            words.collect::<Vec<&str>>().join(" ")
        })
        .filter(|line| !line.is_empty() && !line.starts_with("G21 ") && !line.starts_with("G20 "))
        .collect()
}
