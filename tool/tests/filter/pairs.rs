//! One job in two languages: the part program through the filter, and the same moves written down in
//! plain LinuxCNC code, both through LinuxCNC's own interpreter.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted};

/// How far apart two numbers may be that LinuxCNC's interpreter prints with four decimals.
const SAME: f64 = 2e-4;

/// A motion or a wait as LinuxCNC understood it: what it is, its numbers, and the feed and path mode in
/// force (0 and none for rapid motions).
#[derive(Clone, Debug)]
struct Step {
    kind: &'static str,
    numbers: Vec<f64>,
    feed: f64,
    plane: f64,
}

const KINDS: [&str; 6] = [
    "STRAIGHT_TRAVERSE",
    "STRAIGHT_FEED",
    "ARC_FEED",
    "RIGID_TAP",
    "START_SPEED_FEED_SYNC",
    "DWELL",
];

/// What the program is run with: a tool table in which T1 has a diameter of 6.
pub const ARGUMENTS: [&str; 4] = ["--backend", "program", "--ini", "mill.ini"];

/// A folder with a program and a tool table.
pub fn shop(program: &str) -> Shop {
    Shop::new(&[
        ("part.mpf", program.as_bytes()),
        ("mill.ini", b"[EMCIO]\nTOOL_TABLE = mill.tbl\n"),
        ("mill.tbl", b"T1 P1 D6\nT2 P2\n"),
    ])
}

/// Fails unless both programs make the same moves, with the same feeds and dwells.
pub fn assert_pair(program: &str, plain: &str) {
    let shop = shop(program);
    let written = accepted(&shop.run("part.mpf", &ARGUMENTS));
    let [given, wanted] = [written.as_str(), plain].map(steps);
    for (at, (a, b)) in given.iter().zip(&wanted).enumerate() {
        let same_numbers = a.numbers.len() == b.numbers.len()
            && a.numbers
                .iter()
                .zip(&b.numbers)
                .all(|(a, b)| (a - b).abs() < SAME);
        let same = a.kind == b.kind
            && same_numbers
            && (a.feed - b.feed).abs() < SAME
            && (a.kind != "ARC_FEED" || a.plane == b.plane);
        assert!(same, "step {at}: {a:?}, not {b:?}\n{program}\n{written}");
    }
    assert_eq!(
        given.len(),
        wanted.len(),
        "{program}\n{written}\n{given:?}\n{wanted:?}"
    );
}

fn steps(program: &str) -> Vec<Step> {
    let shop = Shop::new(&[]);
    let canon = rs274::interpret(&shop.path(""), "T1 P1 D0.23622047244\n", program);
    let (mut feed, mut plane) = (0.0, 1.0);
    let mut steps: Vec<Step> = Vec::new();
    for line in &canon {
        if let Some(rate) = numbers(line, "SET_FEED_RATE") {
            feed = rate[0];
        }
        for (number, name) in ["XY", "YZ", "XZ"].iter().enumerate() {
            if line.contains(&format!("SELECT_PLANE(CANON_PLANE::{name})"))
                || line.contains(&format!("SELECT_PLANE(CANON_PLANE_{name})"))
            {
                plane = number as f64;
            }
        }
        for kind in KINDS {
            let Some(numbers) = numbers(line, kind) else {
                continue;
            };
            // Where nothing moves nothing is compared.
            let last = steps.iter().rev().find(|step| step.kind != "DWELL");
            let stays = kind.starts_with("STRAIGHT")
                && last.is_some_and(|step| {
                    step.kind.starts_with("STRAIGHT") && step.numbers == numbers
                });
            if !stays {
                steps.push(Step {
                    kind,
                    numbers,
                    feed: if kind.ends_with("FEED") { feed } else { 0.0 },
                    plane,
                });
            }
        }
    }
    assert!(!steps.is_empty(), "nothing moves\n{program}\n{canon:?}");
    steps
}
