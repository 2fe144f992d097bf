//! Runs of short lines, as CAM systems write them.

use super::Options;
use super::text::Text;
use std::f64::consts::TAU;

/// A wavy contour of 10,000 lines of 0.0185 mm, radii of curvature from 2.5 mm up. Rounded to four
/// decimals, the direction of each line jitters by some thousandths of a radian.
pub(super) fn contour(options: &Options) -> String {
    let mut text = Text::start(
        "10,000 lines of 0.018 mm",
        options,
        options.tolerance_or(0.0),
        4,
    );
    for point in Contour::new(0.0185).take(10_000) {
        text.line(&[('X', point.x), ('Y', point.y)]);
    }
    text.end()
}

/// Points of a smooth wavy curve, a given length of it apart.
#[derive(Clone, Debug)]
pub(super) struct Contour {
    step: f64,
    heading: f64,
    at: ContourPoint,
}

/// A point of the curve.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContourPoint {
    pub x: f64,
    pub y: f64,
    /// Length of the curve up to here, mm.
    pub along: f64,
}

impl Contour {
    pub(super) fn new(step: f64) -> Self {
        Contour {
            step,
            heading: 0.0,
            at: ContourPoint::default(),
        }
    }
}

impl Iterator for Contour {
    type Item = ContourPoint;

    fn next(&mut self) -> Option<ContourPoint> {
        const PARTS: usize = 20;
        let part = self.step / PARTS as f64;
        for _ in 0..PARTS {
            let along = self.at.along;
            let curvature = 0.08 + 0.25 * (0.09 * along).sin() + 0.1 * (0.31 * along).sin();
            self.heading += curvature * part;
            self.at.x += part * self.heading.cos();
            self.at.y += part * self.heading.sin();
            self.at.along += part;
        }
        Some(self.at)
    }
}

/// A spiral from the middle outwards, in lines of 1 mm.
pub(super) fn spiral(options: &Options) -> String {
    const TURNS: f64 = 16.75;
    const PITCH: f64 = 2.0;
    const STEP: f64 = 1.0;
    let mut text = Text::start("spiral of lines", options, options.tolerance_or(0.05), 4);
    let mut angle: f64 = 0.5;
    while angle < TURNS * TAU {
        let radius = PITCH * angle / TAU;
        text.line(&[('X', radius * angle.cos()), ('Y', radius * angle.sin())]);
        angle += STEP / radius.hypot(PITCH / TAU);
    }
    text.end()
}

/// Loops of 60 lines that advance: a trochoid.
pub(super) fn trochoidal(options: &Options) -> String {
    const LINES: usize = 3000;
    const LINES_PER_LOOP: f64 = 60.0;
    const RADIUS: f64 = 2.0;
    const ADVANCE: f64 = 0.4;
    let mut text = Text::start("trochoidal milling", options, options.tolerance_or(0.01), 4);
    for line in 1..=LINES {
        let turns = line as f64 / LINES_PER_LOOP;
        let (sine, cosine) = (turns * TAU).sin_cos();
        text.line(&[
            ('X', RADIUS * (cosine - 1.0) + ADVANCE * turns),
            ('Y', RADIUS * sine),
        ]);
    }
    text.end()
}
