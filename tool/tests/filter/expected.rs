//! Paths that are written down by hand, and their comparison with what the filter makes of a program.

use crate::shop::{Shop, accepted};
use crate::simulator::{PARTS, Point, Step, distance, simulate};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::part_program::contour;
use framepath_tool::program::trace::Setup;
use std::f64::consts::TAU;

/// How far apart two points may be that are the same: what is written has six decimals.
const SAME: f64 = 1e-6;

/// A path, as the specification says it.
#[derive(Clone, Debug)]
pub struct Path {
    start: Point,
    at: Point,
    steps: Vec<Step>,
    feed: Option<f64>,
}

impl Path {
    /// The tool is at this place.
    pub fn from(start: Point) -> Path {
        Path {
            start,
            at: start,
            steps: Vec::new(),
            feed: None,
        }
    }

    /// The feed of the moves that follow is checked.
    pub fn feed(mut self, feed: f64) -> Path {
        self.feed = Some(feed);
        self
    }

    /// A rapid move.
    pub fn rapid(self, end: Point) -> Path {
        let start = self.at;
        self.add(true, end, |t| mix(start, end, t))
    }

    /// A line with feed.
    pub fn line(self, end: Point) -> Path {
        let start = self.at;
        self.add(false, end, |t| mix(start, end, t))
    }

    /// Lines with feed at the present height.
    pub fn lines(mut self, ends: &[(f64, f64)]) -> Path {
        for (x, y) in ends {
            let z = self.at[2];
            self = self.line([*x, *y, z]);
        }
        self
    }

    /// A clockwise arc in the XY plane about a centre.
    pub fn cw(self, end: Point, centre: (f64, f64)) -> Path {
        self.arc_in([0, 1], end, centre.into(), true)
    }

    /// A counterclockwise arc in the XY plane about a centre.
    pub fn ccw(self, end: Point, centre: (f64, f64)) -> Path {
        self.arc_in([0, 1], end, centre.into(), false)
    }

    /// An arc or a helix in the plane of two axes: 0 and 1 for G17, 2 and 0 for G18, 1 and 2 for G19. The
    /// centre has its coordinates along these.
    pub fn arc_in(
        self,
        [first, second]: [usize; 2],
        end: Point,
        [x, y]: [f64; 2],
        clockwise: bool,
    ) -> Path {
        let start = self.at;
        let normal = 3 - first - second;
        let begin = (start[second] - y).atan2(start[first] - x);
        let finish = (end[second] - y).atan2(end[first] - x);
        let mut sweep = (finish - begin).rem_euclid(TAU);
        if clockwise {
            sweep -= TAU;
        }
        if sweep.abs() < 1e-7 || (sweep.abs() - TAU).abs() < 1e-7 {
            sweep = if clockwise { -TAU } else { TAU };
        }
        let radius = (start[first] - x).hypot(start[second] - y);
        self.add(false, end, |t| {
            let (sin, cos) = (begin + t * sweep).sin_cos();
            let mut point = start;
            point[first] = x + radius * cos;
            point[second] = y + radius * sin;
            point[normal] += t * (end[normal] - start[normal]);
            point
        })
    }

    fn add(mut self, rapid: bool, end: Point, point: impl Fn(f64) -> Point) -> Path {
        let points: Vec<Point> = (0..=PARTS)
            .map(|part| point(part as f64 / PARTS as f64))
            .collect();
        self.at = end;
        let moves = points
            .windows(2)
            .any(|pair| distance(pair[0], pair[1]) > 0.0);
        if moves {
            self.steps.push(Step {
                rapid,
                feed: match rapid {
                    true => 0.0,
                    false => self.feed.unwrap_or(f64::NAN),
                },
                points,
            });
        }
        self
    }

    /// Checks a program: its contour, what both backends write, and thereby that they agree.
    /// `files`: the program first. `what` is shown where they differ.
    pub fn check(&self, dialect: Dialect, files: &[(&str, &str)], what: &str) {
        self.check_backends(dialect, files, &["program", "kinematics"], what);
    }

    /// Checks a program with these backends only.
    pub fn check_backends(
        &self,
        dialect: Dialect,
        files: &[(&str, &str)],
        backends: &[&str],
        what: &str,
    ) {
        let bytes: Vec<(&str, &[u8])> = files
            .iter()
            .map(|(name, text)| (*name, text.as_bytes()))
            .collect();
        let shop = Shop::new(&bytes);
        let name = files[0].0;
        let setup = Setup {
            start: self.start,
            ..Setup::default()
        };
        let moves = contour(dialect, &shop.path(name), &Settings::default(), &setup)
            .unwrap_or_else(|refused| panic!("{what}\n{refused}"));
        let traced: Vec<Step> = moves
            .iter()
            .map(|step| Step {
                rapid: step.rapid,
                feed: step.feed,
                points: (0..=PARTS)
                    .map(|part| step.shape.point(part as f64 / PARTS as f64))
                    .collect(),
            })
            .collect();
        self.compare(&traced, &format!("{what}, contour"));
        for backend in backends {
            let output = shop.run_in(dialect.name(), name, &["--backend", backend]);
            let written = accepted(&output);
            let steps = simulate(&written, self.start);
            self.compare(&steps, &format!("{what}, {backend}\n{written}"));
        }
    }

    fn compare(&self, steps: &[Step], what: &str) {
        for (number, (given, wanted)) in steps.iter().zip(&self.steps).enumerate() {
            let number = number + 1;
            assert_eq!(given.rapid, wanted.rapid, "{what}: move {number}");
            for (part, (a, b)) in given.points.iter().zip(&wanted.points).enumerate() {
                assert!(
                    distance(*a, *b) < SAME,
                    "{what}: move {number} at {part}/{PARTS}: {a:?}, not {b:?}"
                );
            }
            if !wanted.feed.is_nan() {
                assert!(
                    (given.feed - wanted.feed).abs() < 1e-4,
                    "{what}: move {number}: feed {}, not {}",
                    given.feed,
                    wanted.feed
                );
            }
        }
        let ends: Vec<&Point> = steps.iter().filter_map(|step| step.points.last()).collect();
        assert_eq!(steps.len(), self.steps.len(), "{what}: moves to {ends:?}");
    }
}

fn mix(start: Point, end: Point, t: f64) -> Point {
    std::array::from_fn(|axis| start[axis] + t * (end[axis] - start[axis]))
}
