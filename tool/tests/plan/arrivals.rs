//! Plans with moves that come when they were recorded to come.

use crate::support::{Bench, MILL};

const PROGRAM: &str = "G21 G64 P0.1 F4000\nG1 X10\nY10\nX20\nY20\nG4 P0.1\nX30\nM2\n";

/// The places of the cycles in which anything moves.
fn motion(table: &str) -> Vec<String> {
    let place = |row: &str| -> String {
        let words: Vec<&str> = row.split(',').skip(3).take(3).collect();
        words.join(" ")
    };
    let places: Vec<String> = table.lines().skip(1).map(place).collect();
    let moves = |pair: &[String]| pair[0] != pair[1];
    let moving = places.windows(2).filter(|pair| moves(pair));
    moving.map(|pair| pair[1].clone()).collect()
}

fn planned(bench: &Bench, options: &[&str]) -> (u64, String) {
    let figures = bench.figures(
        PROGRAM,
        &[&["--ini", "mill.ini", "--csv", "plan.csv"], options].concat(),
    );
    (
        figures["cycles"].as_u64().expect("a number"),
        bench.read("plan.csv"),
    )
}

#[test]
fn a_move_in_each_cycle_is_what_is_planned_without_a_recording() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    let (cycles, table) = planned(&bench, &[]);
    let first_rest = "0 1 1\n1 2 1\n2 3 1\n3 4 1\n";
    // the dwell is over long before
    let recorded = format!("{first_rest}{} 5 1\n", cycles + 500);
    bench.write("arrivals.txt", &recorded);
    let (later, same) = planned(&bench, &["--arrivals", "arrivals.txt"]);
    assert!(later > cycles);
    assert_eq!(motion(&same), motion(&table));
}

#[test]
fn a_scale_of_0_holds_the_machine_at_the_start() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    bench.write(
        "arrivals.txt",
        "0 1 0\n1 2 0\n2 3 0\n3 4 0\n250 4 1\n2000 5 1\n",
    );
    let (_, table) = planned(&bench, &["--arrivals", "arrivals.txt"]);
    let still = table.lines().skip(1).take_while(|row| {
        let words: Vec<&str> = row.split(',').collect();
        words[3] == "0" && words[4] == "0"
    });
    // the start, and the cycles before the change
    assert_eq!(still.count(), 251);
}

#[test]
fn a_full_queue_is_the_same_as_a_hold_until_nothing_more_comes() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    let (cycles, full) = planned(&bench, &["--fill-queue"]);
    bench.write(
        "arrivals.txt",
        "0 1 0\n1 2 0\n2 3 0\n3 4 0\n1003 4 1\n9000 5 1\n",
    );
    let (later, held) = planned(&bench, &["--arrivals", "arrivals.txt"]);
    assert!(later > cycles);
    assert_eq!(motion(&held), motion(&full));
}

#[test]
fn a_hold_for_good_is_no_fault_of_the_planner() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    bench.write("part.ngc", PROGRAM);
    bench.write("arrivals.txt", "0 5 1\n100 5 0\n");
    let arguments = [
        "part.ngc",
        "--ini",
        "mill.ini",
        "--arrivals",
        "arrivals.txt",
    ];
    let error = bench.refused(&arguments);
    assert!(
        error.starts_with("arrivals.txt: holds the machine for good from cycle 100 on"),
        "{error}"
    );
}

#[test]
fn a_recording_of_another_program_is_refused() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    bench.write("part.ngc", PROGRAM);
    bench.write("arrivals.txt", "0 1 1\n1 2 1\n");
    let arguments = ["part.ngc", "--ini", "mill.ini", "--arrivals"];
    let short = bench.refused(&[&arguments[..], &["arrivals.txt"]].concat());
    assert!(
        short.contains("arrivals.txt: ends with 2 moves, the program has more"),
        "{short}"
    );
    let missing = bench.refused(&[&arguments[..], &["nowhere.txt"]].concat());
    assert!(missing.contains("nowhere.txt: cannot be read"), "{missing}");
}
