//! A long program.

use std::fmt::Write;

/// Lines of 0.2 mm over a wavy surface.
pub fn surface(moves: usize) -> String {
    let mut text = "G21 G90 G64 P0.01 Q0\nG0 Z10\nF6000\n".to_owned();
    for k in 0..moves {
        let (row, place) = (k / 1000, k % 1000);
        let x = 0.2 * if row % 2 == 0 { place } else { 999 - place } as f64;
        let z = 4.0 * (x / 15.0).sin() + 0.5 * (x / 3.1).sin();
        let y = 0.3 * row as f64;
        writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4}").expect("a string");
    }
    text + "M2\n"
}
