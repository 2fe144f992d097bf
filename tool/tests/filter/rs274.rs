//! LinuxCNC's own interpreter, to see what it understands.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The names of all subroutines that the kinematics backend calls.
const SUBROUTINES: [&str; 20] = [
    "frame_off",
    "frame_refresh",
    "trans",
    "atrans",
    "rot",
    "arot",
    "rot_rpl",
    "arot_rpl",
    "rots_xy",
    "rots_zx",
    "rots_yz",
    "arots_xy",
    "arots_zx",
    "arots_yz",
    "scale",
    "ascale",
    "ascale_off",
    "mirror",
    "amirror",
    "unused",
];

/// The canonical calls that LinuxCNC makes of a program; its files go to the folder. `tools`: the tool
/// table, in inches, as the interpreter has it without a machine. Fails on any error of the interpreter.
pub fn interpret(folder: &Path, tools: &str, program: &str) -> Vec<String> {
    for name in SUBROUTINES {
        let text = format!("o<{name}> sub\n(MSG, called {name} #1 #2 #3)\no<{name}> endsub\nM2\n");
        std::fs::write(folder.join(format!("{name}.ngc")), text).expect("a file");
    }
    run(folder, tools, program);
    let read = |name| std::fs::read_to_string(folder.join(name)).expect("a file");
    let errors: Vec<String> = read("errors.txt")
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.contains("executing"))
        .map(String::from)
        .collect();
    assert!(errors.is_empty(), "rs274 says: {errors:?}\n{program}");
    let canon: Vec<String> = read("canon.txt").lines().map(String::from).collect();
    let ended = canon.iter().any(|line| line.contains("PROGRAM_END"));
    assert!(
        ended,
        "the program did not reach its end: {:?}\n{program}",
        canon.last()
    );
    canon
}

/// Runs a program; what the interpreter calls goes to `canon.txt`, what it says to `errors.txt`.
pub fn run(folder: &Path, tools: &str, program: &str) {
    let ini = format!("[RS274NGC]\nSUBROUTINE_PATH={}\n", folder.display());
    std::fs::write(folder.join("machine.ini"), ini).expect("a file");
    std::fs::write(folder.join("tool.tbl"), tools).expect("a file");
    std::fs::write(folder.join("out.ngc"), program).expect("a file");
    let log = std::fs::File::create(folder.join("canon.txt")).expect("a file");
    let errors = std::fs::File::create(folder.join("errors.txt")).expect("a file");
    let mut interpreter = Command::new("rs274")
        .current_dir(folder)
        // LinuxCNC's tool table lies in a file of the home folder: the tests run at the same time
        .env("HOME", folder)
        .args([
            "-n",
            "0",
            "-g",
            "-i",
            "machine.ini",
            "-t",
            "tool.tbl",
            "out.ngc",
        ])
        .stdin(Stdio::null())
        .stdout(log)
        .stderr(errors)
        .spawn()
        .expect("rs274 of LinuxCNC is installed");
    let begun = Instant::now();
    loop {
        match interpreter
            .try_wait()
            .expect("the interpreter can be waited for")
        {
            Some(_) => break,
            None if begun.elapsed() > Duration::from_secs(30) => {
                interpreter.kill().expect("the interpreter can be stopped");
                panic!("rs274 does not end");
            }
            None => std::thread::sleep(Duration::from_millis(10)),
        }
    }
}

/// The numbers of a canonical call with this name.
pub fn numbers(line: &str, name: &str) -> Option<Vec<f64>> {
    let (_, rest) = line.split_once(&format!("{name}("))?;
    let list = rest.trim_end_matches(')').split(',');
    Some(
        list.filter_map(|number| number.trim().parse().ok())
            .collect(),
    )
}
