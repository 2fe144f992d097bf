//! A LinuxCNC of another series than the one that the command is built for: refused, since its interpreter and planners are
//! called otherwise.

use crate::bench::refusal;
use crate::support::{Bench, STOCK};
use std::path::Path;
use std::process::Command;

/// The word that a module of ours has before the version that it is built for.
const MARK: &str = "framepath built for LinuxCNC ";

/// Writes what the script `linuxcnc` of LinuxCNC 2.10 says of itself, for modules in `folder`.
fn write_script(bench: &Bench, folder: &Path) {
    std::fs::create_dir_all(bench.path().join("bin")).expect("made");
    let folder = folder.display();
    let text = format!("LINUXCNC_RTLIB_DIR={folder}\nLINUXCNCVERSION=\"2.10.0~pre1\"\n");
    bench.write("bin/linuxcnc", &text);
}

/// What `framepath` says that refuses, with that script in front of others.
fn refused(bench: &Bench, arguments: &[&str]) -> String {
    let path = std::env::var("PATH").expect("a PATH");
    let command = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(bench.path())
        .env("PATH", format!("{}/bin:{path}", bench.path().display()))
        .args(arguments)
        .output();
    refusal(command.expect("the program runs"))
}

#[test]
fn where_it_is_installed_neither_interpreter_nor_planner_is_called() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 G90 F600\nG1 X10\nM2\n");
    write_script(&bench, Path::new(STOCK).parent().expect("a folder"));
    for command in ["plan", "compare"] {
        let message = refused(&bench, &[command, "part.ngc"]);
        assert!(
            message.starts_with("this framepath is built for LinuxCNC 2.9"),
            "{message}"
        );
        assert!(
            message.contains(
                "and 2.10.0~pre1 is installed: in framepath's sources: make install again"
            ),
            "{message}"
        );
    }
}

#[test]
fn a_module_of_it_is_not_called() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 G90 F600\nG1 X10\nM2\n");
    let folder = bench.path().join("modules");
    std::fs::create_dir(&folder).expect("made");
    write_script(&bench, &folder);
    std::fs::copy(STOCK, folder.join("tpmod.so")).expect("copied");
    bench.write("ours.so", &format!("{MARK}2.10.0~pre1\0"));
    for module in ["modules/tpmod.so", "ours.so"] {
        let message = refused(&bench, &["compare", "part.ngc", "--with", module]);
        assert!(
            message.contains(&format!(
                "{module}: it belongs to LinuxCNC 2.10.0~pre1, and this framepath is built for 2.9"
            )),
            "{message}"
        );
    }
}
