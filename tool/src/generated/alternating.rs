//! Lines that alternate between two feeds, or between two path modes.

use super::Options;
use super::text::Text;
use std::f64::consts::PI;

/// Lines of 2 mm that turn by 0.1 radians to and fro: every other one has a quarter of the feed.
pub(super) fn feeds(options: &Options) -> String {
    let feeds = [options.feed / 4.0, options.feed];
    write("feeds in turn", options, 0.1, |line| {
        format!("F{}", feeds[line % 2])
    })
}

/// Lines of 2 mm that turn by a right angle to and fro, in G64 P and in G61.
pub(super) fn modes(options: &Options) -> String {
    let blend = format!("G64 P{}", options.tolerance_or(TOLERANCE));
    write("G64 and G61 in turn", options, PI / 2.0, |line| {
        if line % 2 == 0 {
            blend.clone()
        } else {
            "G61".to_owned()
        }
    })
}

/// mm
const TOLERANCE: f64 = 0.05;

fn write(about: &str, options: &Options, turn: f64, block: impl Fn(usize) -> String) -> String {
    const LINES: usize = 200;
    const LENGTH: f64 = 2.0;
    let mut text = Text::start(about, options, options.tolerance_or(TOLERANCE), 4);
    let (mut x, mut y) = (0.0, 0.0);
    for line in 0..LINES {
        // to and fro in pairs, so that corners of both kinds turn both ways
        let (sine, cosine) = if line / 2 % 2 == line % 2 {
            (0.0, 1.0)
        } else {
            turn.sin_cos()
        };
        x += LENGTH * cosine;
        y += LENGTH * sine;
        text.block(&block(line));
        text.line(&[('X', x), ('Y', y)]);
    }
    text.end()
}
