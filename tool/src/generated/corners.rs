//! Corners between straight legs.

use super::Options;
use super::text::Text;

/// Legs of 1 mm, in X and in Y in turn.
pub(super) fn zigzag(options: &Options) -> String {
    let mut text = Text::start(
        "zig-zag of short legs",
        options,
        options.tolerance_or(0.05),
        4,
    );
    let (mut x, mut y) = (0.0, 0.0);
    for leg in 0..200 {
        if leg % 2 == 0 {
            x += 1.0
        } else {
            y += 1.0
        }
        text.line(&[('X', x), ('Y', y)]);
    }
    text.end()
}

/// 15 times around a square with legs of 5 mm.
pub(super) fn squares(options: &Options, tolerance: f64) -> String {
    let mut text = Text::start(
        "squares of 5 mm",
        options,
        options.tolerance_or(tolerance),
        4,
    );
    for _ in 0..15 {
        for (x, y) in [(5.0, 0.0), (5.0, 5.0), (0.0, 5.0), (0.0, 0.0)] {
            text.line(&[('X', x), ('Y', y)]);
        }
    }
    text.end()
}
