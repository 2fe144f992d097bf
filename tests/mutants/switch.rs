//! Which of the faults in this copy of the source is switched on: the one whose number FRAMEPATH_MUTANT has, none
//! without it. With FRAMEPATH_REACHED in the environment the number of each fault that is come to is added to that file.
#![allow(missing_docs, clippy::all)]

use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

struct Setting {
    chosen: usize,
    reached: Option<std::ffi::OsString>,
}

static SETTING: OnceLock<Setting> = OnceLock::new();
static REACHED: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

pub fn on(number: usize) -> bool {
    let setting = SETTING.get_or_init(|| Setting {
        chosen: std::env::var("FRAMEPATH_MUTANT").map_or(usize::MAX, |number| number.parse().expect("a number")),
        reached: std::env::var_os("FRAMEPATH_REACHED"),
    });
    if let Some(path) = &setting.reached
        && !REACHED[number].load(Relaxed)
        && !REACHED[number].swap(true, Relaxed)
    {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
        writeln!(file.expect("the file of what is reached"), "{number}").expect("a line");
    }
    setting.chosen == number
}
