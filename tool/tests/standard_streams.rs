//! Standard output and standard error that cannot be written.

use std::fs::File;
use std::process::{Command, Stdio};

fn full() -> File {
    File::options()
        .write(true)
        .open("/dev/full")
        .expect("a device")
}

/// What is said to nobody changes neither what is done nor the exit status.
#[test]
fn messages_that_cannot_be_written_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("part.nc"), "O1\nG1 X1 F100\nM30\n").expect("written");
    std::fs::write(folder.path().join("bad.nc"), "O1\nG1 X1 F100 ?\nM30\n").expect("written");
    for (program, code) in [("part.nc", 0), ("bad.nc", 1)] {
        let output = |errors: Stdio| {
            Command::new(env!("CARGO_BIN_EXE_framepath"))
                .current_dir(folder.path())
                .args(["filter", "--dialect", "fanuc", program])
                .stderr(errors)
                .output()
                .expect("the program runs")
        };
        let (heard, unheard) = (output(Stdio::piped()), output(full().into()));
        assert_eq!(heard.status.code(), Some(code));
        assert_eq!(unheard.status.code(), Some(code));
        assert_eq!(heard.stdout, unheard.stdout);
    }
}

#[test]
fn help_that_cannot_be_written_is_an_error() {
    for arguments in [&["--help"][..], &["--version"], &["filter", "--help"]] {
        let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
            .args(arguments)
            .stdout(full())
            .stderr(Stdio::piped())
            .output()
            .expect("the program runs");
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.contains("standard output: cannot be written"),
            "{said}"
        );
    }
}

/// As behind `| head -1`, with a reader that has gone already.
#[test]
fn help_of_which_enough_is_read_is_no_error() {
    for arguments in [&["--help"][..], &["--version"], &["filter", "--help"]] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
            .args(arguments)
            .stdout(writer)
            .stderr(Stdio::piped())
            .output()
            .expect("the program runs");
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!((output.status.code(), said.as_str()), (Some(0), ""));
    }
}
