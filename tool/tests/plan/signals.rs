//! A plan that is not wanted any more leaves nothing behind.

use crate::processes::{ENDLESS, await_that, interpreters, signal, start};
use crate::support::Bench;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn a_plan_that_is_ended_leaves_nothing() {
    let silent = "o1 while [1]\n#1=1\no1 endwhile\nM2\n";
    let moving = "G21 F1000\no1 while [1]\nG1 X9\nG1 X0\no1 endwhile\nM2\n";
    for (program, signal) in [(silent, "-TERM"), (moving, "-INT"), (moving, "-HUP")] {
        let bench = Bench::new();
        bench.write("part.ngc", program);
        let room = bench.path().join("tmp");
        std::fs::create_dir(&room).expect("a folder");
        let mut plan = Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(bench.path())
            .env("TMPDIR", &room)
            .args([
                "plan",
                "part.ngc",
                "--csv",
                "plan.csv",
                "--html",
                "plan.html",
            ])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let entries = || std::fs::read_dir(bench.path()).expect("a folder").count();
        let begun = Instant::now();
        while entries() < 4 && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(20));
        }
        assert_eq!(entries(), 4, "the program, tmp, and what is written");
        let killed = Command::new("kill")
            .args([signal, &plan.id().to_string()])
            .status();
        assert!(killed.is_ok_and(|status| status.success()));
        assert_eq!(plan.wait().expect("an end").code(), Some(1), "{signal}");
        assert_eq!(entries(), 2, "{signal}");
        assert_eq!(std::fs::read_dir(&room).expect("a folder").count(), 0);
    }
}

/// Nobody can clean up behind that; but LinuxCNC's interpreter would run through a loop for ever.
#[test]
fn the_interpreter_ends_with_a_plan_that_is_killed() {
    let bench = Bench::new();
    bench.write("part.ngc", ENDLESS);
    let mut plan = start(bench.path(), &["plan", "part.ngc"]);
    await_that("it reads", || interpreters(bench.path()) == 1);
    signal(&plan, "-KILL");
    assert_eq!(plan.wait().expect("an end").code(), None);
    await_that("the interpreter ends", || interpreters(bench.path()) == 0);
}
