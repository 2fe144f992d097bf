//! Programs with rotary axes and with U V W.

use super::Options;
use super::dense::Contour;
use super::random::Random;
use super::text::Text;
use std::f64::consts::TAU;

/// A wavy drawing on a cylinder: X along it, A around it, Z for its depth.
pub(super) fn wrapped(options: &Options) -> String {
    const LINES: usize = 1100;
    let mut text = Text::start("wrapped 4-axis", options, options.tolerance_or(0.02), 4);
    for line in 1..=LINES {
        let along = line as f64 * 0.5;
        text.line(&[
            ('X', 10.0 * (1.0 - (TAU * along / 90.0).cos())),
            ('Z', 0.5 * (TAU * along / 37.0).sin()),
            ('A', 0.8 * along + 6.0 * (TAU * along / 23.0).sin()),
        ]);
    }
    text.end()
}

/// Moves of X and of A in turn, to and fro.
pub(super) fn zigzag(options: &Options) -> String {
    let mut text = Text::start("4-axis zig-zag", options, options.tolerance_or(0.02), 4);
    let mut a = 0.0;
    for pass in 0..38 {
        let x = if pass % 2 == 0 { 20.0 } else { 0.0 };
        text.line(&[('X', x), ('A', a)]);
        a += 5.0;
        text.line(&[('X', x), ('A', a)]);
    }
    text.end()
}

/// Along a blade: the tool tilts by A while C turns.
pub(super) fn blade(options: &Options) -> String {
    let mut text = Text::start("5-axis blade", options, options.tolerance_or(0.02), 4);
    for point in Contour::new(0.3).take(1300) {
        text.line(&[
            ('X', point.x),
            ('Y', point.y),
            ('Z', 2.0 * (0.15 * point.along).sin()),
            ('A', 20.0 * (0.12 * point.along).sin()),
            (
                'C',
                0.9 * point.along + 15.0 * ((0.1 * point.along).cos() - 1.0),
            ),
        ]);
    }
    text.end()
}

/// X Y Z A C at random: how long moves are, how much the direction turns from one to the next, how fast the tool tilts and P
/// hang on the seed as well.
pub(super) fn random_five_axes(options: &Options) -> String {
    const GREATEST_TILT: f64 = 60.0;
    const HALF_CUBE: f64 = 30.0;
    let mut random = Random::new(options.seed);
    let tolerance = (1e3 * random.between_logarithmic(0.01, 0.1)).round() / 1e3;
    let greatest_length = random.between_logarithmic(0.5, 10.0);
    let turn = random.between_logarithmic(0.1, 3.0);
    let greatest_step = random.between_logarithmic(0.5, 10.0);
    let mut text = Text::start(
        "random X Y Z A C",
        options,
        options.tolerance_or(tolerance),
        4,
    );
    let (mut at, mut direction) = ([0.0f64; 3], random.direction());
    let (mut tilt, mut table) = (0.0f64, 0.0);
    for _ in 0..300 {
        for (part, other) in direction.iter_mut().zip(random.direction()) {
            *part += turn * other;
        }
        let size = direction.iter().map(|part| part * part).sum::<f64>().sqrt();
        let length = random.between_logarithmic(0.1 * greatest_length, greatest_length);
        for (coordinate, part) in at.iter_mut().zip(&mut direction) {
            *part /= size;
            // what would leave the cube turns back
            if (*coordinate + length * *part).abs() > HALF_CUBE {
                *part = -*part;
            }
            *coordinate += length * *part;
        }
        tilt = (tilt + random.between(-greatest_step, greatest_step))
            .clamp(-GREATEST_TILT, GREATEST_TILT);
        table += random.between(-greatest_step, greatest_step);
        let [x, y, z] = at;
        text.line(&[('X', x), ('Y', y), ('Z', z), ('A', tilt), ('C', table)]);
    }
    text.end()
}

/// A B C only; F is in degrees per minute then.
pub(super) fn rotary_only(options: &Options) -> String {
    let mut text = Text::start("A B C only", options, options.tolerance_or(0.0), 4);
    text.block("G20");
    for step in 1..=100 {
        let along = f64::from(step);
        text.line(&[
            ('A', 10.0 * along),
            ('B', 20.0 * (TAU * along / 12.0).sin()),
            ('C', if step % 4 < 2 { 5.0 } else { 0.0 }),
        ]);
    }
    text.end()
}

/// A contour at two heights, as a hot wire cuts it: X Y below, U V above, W now and then.
pub(super) fn uvw(options: &Options) -> String {
    const LINES: usize = 1500;
    let mut text = Text::start("X Y U V W", options, options.tolerance_or(0.02), 4);
    for line in 1..=LINES {
        let angle = TAU * line as f64 / 500.0;
        let below = 20.0 + 3.0 * (5.0 * angle).sin();
        let above = 14.0 + 2.0 * (5.0 * angle + 0.4).sin();
        text.line(&[
            ('X', below * angle.cos() - 20.0),
            ('Y', below * angle.sin()),
            ('U', above * angle.cos() - 14.0),
            ('V', above * angle.sin()),
            ('W', 0.2 * (3.0 * angle).sin()),
        ]);
    }
    text.end()
}

/// All nine axes at once, in short lines.
pub(super) fn nine_axes(options: &Options) -> String {
    const LINES: usize = 1500;
    let mut text = Text::start("all nine axes", options, options.tolerance_or(0.02), 4);
    for line in 1..=LINES {
        let angle = TAU * line as f64 / 500.0;
        let wave = |size: f64, times: f64, phase: f64| {
            size * ((times * angle + phase).sin() - phase.sin())
        };
        text.line(&[
            ('X', wave(20.0, 1.0, 1.5)),
            ('Y', wave(20.0, 1.0, 0.0)),
            ('Z', wave(2.0, 3.0, 0.3)),
            ('A', wave(10.0, 2.0, 0.6)),
            ('B', wave(8.0, 3.0, 0.9)),
            ('C', 40.0 * angle / TAU + wave(5.0, 2.0, 1.2)),
            ('U', wave(3.0, 2.0, 0.2)),
            ('V', wave(3.0, 2.0, 1.8)),
            ('W', wave(1.0, 4.0, 0.5)),
        ]);
    }
    text.end()
}
