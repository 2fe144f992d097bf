//! Threads and taps of ISG programs, against plain LinuxCNC code.

use crate::linuxcnc::interpret;
use crate::rs274::numbers;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// Motions and what is in step with the spindle, as LinuxCNC understands them.
fn motions(shop: &Shop, program: &str) -> Vec<(&'static str, Vec<f64>)> {
    let names = [
        "STRAIGHT_TRAVERSE",
        "STRAIGHT_FEED",
        "RIGID_TAP",
        "START_SPEED_FEED_SYNC",
        "STOP_SPEED_FEED_SYNC",
        "SET_SPINDLE_SPEED",
        "START_SPINDLE_CLOCKWISE",
        "START_SPINDLE_COUNTERCLOCKWISE",
        "STOP_SPINDLE_TURNING",
    ];
    let canon = interpret(shop, program);
    let call = |line: &String| {
        let mut named = names
            .into_iter()
            .filter_map(|name| numbers(line, name).map(|list| (name, list)));
        named.next()
    };
    let mut list: Vec<(&str, Vec<f64>)> = canon.iter().filter_map(call).collect();
    list.dedup();
    list
}

#[test]
fn threads_and_taps_are_those_of_linuxcnc() {
    for (program, plain) in [
        (
            "S500 M03\nG00 X20 Y0 Z5\nG33 Z-20 K2\nZ-40 K1\nX30 Z-50\nG00 Z5\n",
            "S500 M3\nG0 X20 Y0 Z5\nG33 Z-20 K2\nG33 Z-40 K1\nG33 X30 Z-50 K1.41421356\nG0 Z5\n",
        ),
        (
            "G00 X10 Y10 Z2\nG63 Z-15 F250 S200\nZ2 S-200\nG00 Z50\n",
            "G0 X10 Y10 Z2\nS200 M3\nG33.1 Z-15 K1.25\nM5\nS200\nG0 Z50\n",
        ),
        // To the left, and with increments.
        (
            "G00 X10 Y10 Z2\nG91 G63 Z-10 F300 S-300\nG63 Z10 S300\nG90 G00 Z50\n",
            "G0 X10 Y10 Z2\nS300 M4\nG33.1 Z-8 K1\nM5\nS300\nG0 Z50\n",
        ),
    ] {
        let shop = Shop::with(Dialect::Isg, &format!("{program}M30\n"));
        let given = motions(&shop, &shop.accepted(&["--backend", "program"]));
        let wanted = motions(&shop, &format!("G21 G90 G61\n{plain}M30\n"));
        let near = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
        };
        let same = given.len() == wanted.len()
            && given
                .iter()
                .zip(&wanted)
                .all(|(a, b)| a.0 == b.0 && near(&a.1, &b.1));
        assert!(same, "{program}\n{given:?}\n{wanted:?}");
        let special = wanted
            .iter()
            .any(|(name, _)| matches!(*name, "RIGID_TAP" | "START_SPEED_FEED_SYNC"));
        assert!(special, "{wanted:?}");
    }
}

#[test]
fn what_is_no_thread_and_no_tap() {
    for (program, text) in [
        (
            "G00 X0 Y0 Z0\nG33 Z-20 K2\nM30\n",
            "the spindle does not turn",
        ),
        ("S9 M3\nG00 Z0\nG33 Z-20\nM30\n", "needs its pitch"),
        ("G00 Z2\nG63 Z-5 S200\nZ2 S-200\nM30\n", "F in mm/min"),
        ("G00 Z2\nG63 Z-5 F200\nZ2\nM30\n", "F in mm/min"),
        ("G63 Z-5 F200 S200\nZ2 S-200\nM30\n", "where the tap begins"),
        (
            "G00 Z2\nG63 Z-5 X1 F200 S200\nZ2 S-200\nM30\n",
            "no other axis",
        ),
        (
            "S9 M3\nG00 Z2\nG63 Z-5 F200 S200\nZ2 S-200\nM30\n",
            "stop it before G63",
        ),
        ("G00 Z2\nG63 Z-5 F200 S200\nZ2\nM30\n", "does not come back"),
        (
            "G00 Z2\nG63 Z-5 F200 S200\nZ3 S-200\nM30\n",
            "does not come back",
        ),
        (
            "G00 Z2\nG63 Z-5 F200 S200\nZ2 S-100\nM30\n",
            "does not come back",
        ),
        (
            "G00 Z2\nG63 Z-5 F200 S200\nG00 Z2\nM30\n",
            "does not come out next",
        ),
        (
            "G00 Z2\nG63 Z-5 F200 S200\nG70 Z2 F200 S-200\nM30\n",
            "does not come out next",
        ),
        ("G00 Z2\nG63 Z-5 F200 S200\nM30\n", "does not come out next"),
        ("G00 Z2\nG63 Z-5 F200 S200\n", "does not come out next"),
    ] {
        let shown = Shop::with(Dialect::Isg, program).refused(&[]);
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}
