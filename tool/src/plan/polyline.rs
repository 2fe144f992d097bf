//! The planned path as a polyline of limited length, made while the path goes by.

use crate::path::pieces::{Point, distance_to_segment};

/// Points that a drawing gets, at most.
const MOST_POINTS: usize = 60_000;

/// A point of the path.
#[derive(Clone, Copy, Debug)]
pub struct PathPoint {
    /// X Y Z, machine units.
    pub point: Point,
    /// s.
    pub time: f64,
    /// Machine units per second.
    pub speed: f32,
    /// Line of the program.
    pub line: i32,
    /// Whether the move is a rapid.
    pub is_rapid: bool,
    /// What keeps the machine from being faster, see [`Cause::index`](super::cause::Cause::index).
    pub cause: u8,
}

/// Thins out the path: a point stays where the polyline would be off by more than the tolerance
/// without it, where the speed bends, and, in short programs, where line or cause change.
#[derive(Clone, Debug)]
pub struct Polyline {
    kept: Vec<PathPoint>,
    thinning: Thinning,
}

/// How far the drawing may be off.
#[derive(Clone, Debug)]
struct Thinning {
    /// Machine units.
    tolerance: f64,
    /// Machine units per second.
    speed_tolerance: f32,
    /// Whether changes of line and cause count.
    marks: bool,
    /// Some of the points that the growing chord skips: they stand for all.
    probes: Vec<Point>,
    skipped: usize,
    before: Option<PathPoint>,
}

impl Polyline {
    /// `tolerance` in machine units, `speed_tolerance` in machine units per second: what the drawing
    /// may be off as long as it is short.
    pub fn new(tolerance: f64, speed_tolerance: f64) -> Self {
        Polyline {
            kept: Vec::new(),
            thinning: Thinning {
                tolerance,
                speed_tolerance: speed_tolerance as f32,
                marks: true,
                probes: Vec::new(),
                skipped: 0,
                before: None,
            },
        }
    }

    /// The next point.
    pub fn note(&mut self, point: PathPoint) {
        self.thinning.note(&mut self.kept, point);
        while self.kept.len() > 2 * MOST_POINTS {
            self.thin_out();
        }
    }

    /// Doubles the tolerances and does it again with what is there.
    fn thin_out(&mut self) {
        let before = self.thinning.before;
        let all = std::mem::take(&mut self.kept);
        self.thinning = Thinning {
            tolerance: 2.0 * self.thinning.tolerance,
            speed_tolerance: 2.0 * self.thinning.speed_tolerance,
            marks: false,
            probes: Vec::new(),
            skipped: 0,
            before: None,
        };
        for point in all.into_iter().chain(before) {
            self.thinning.note(&mut self.kept, point);
        }
    }

    /// All points, in order.
    pub fn finish(mut self) -> Vec<PathPoint> {
        while self.kept.len() > MOST_POINTS {
            self.thin_out();
        }
        self.kept.extend(self.thinning.before);
        self.kept
    }
}

impl Thinning {
    fn note(&mut self, kept: &mut Vec<PathPoint>, point: PathPoint) {
        let (Some(start), Some(before)) = (kept.last(), self.before) else {
            if kept.is_empty() {
                kept.push(point);
            } else {
                self.before = Some(point);
            }
            return;
        };
        let away = |probe: Point| distance_to_segment(probe, start.point, point.point).0;
        let off_path = away(before.point) > self.tolerance
            || self
                .probes
                .iter()
                .any(|probe| away(*probe) > self.tolerance);
        let share = (before.time - start.time) / (point.time - start.time).max(1e-12);
        let straight = start.speed + share as f32 * (point.speed - start.speed);
        let off_speed = (before.speed - straight).abs() > self.speed_tolerance
            || (point.speed - start.speed).abs() > 4.0 * self.speed_tolerance;
        let marked = before.is_rapid != point.is_rapid
            || (self.marks && (before.line != point.line || before.cause != point.cause));
        if off_path || off_speed || marked {
            kept.push(before);
            self.probes.clear();
            self.skipped = 0;
        } else {
            // At 1, 2, 4, 8.. points behind the start.
            self.skipped += 1;
            if self.skipped.is_power_of_two() {
                self.probes.push(before.point);
            }
        }
        self.before = Some(point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(count: usize, at: impl Fn(f64) -> Point) -> Vec<PathPoint> {
        let mut polyline = Polyline::new(1e-3, 1.0);
        for k in 0..count {
            let time = k as f64 * 0.001;
            polyline.note(PathPoint {
                point: at(time),
                time,
                speed: 10.0,
                line: 1 + k as i32 / 7,
                is_rapid: false,
                cause: 0,
            });
        }
        polyline.finish()
    }

    #[test]
    fn both_ends_and_corners_stay() {
        let points = path(2001, |t| {
            [(10.0 * t).min(10.0), (10.0 * t - 10.0).max(0.0), 0.0]
        });
        assert_eq!(points.first().map(|p| p.point), Some([0.0; 3]));
        assert_eq!(points.last().map(|p| p.point), Some([10.0, 10.0, 0.0]));
        assert!(points.iter().any(|p| p.point == [10.0, 0.0, 0.0]));
    }

    #[test]
    fn long_paths_stay_short_and_near() {
        let at = |t: f64| [50.0 * t.cos() + (37.0 * t).sin(), 50.0 * t.sin(), 0.01 * t];
        let points = path(1_000_000, at);
        assert!(
            points.len() <= MOST_POINTS + 1 && points.len() > 1000,
            "{}",
            points.len()
        );
        assert!(points.windows(2).all(|pair| pair[0].time < pair[1].time));
        for pair in points.windows(2) {
            let middle = at(0.5 * (pair[0].time + pair[1].time));
            let (away, _) = distance_to_segment(middle, pair[0].point, pair[1].point);
            assert!(away < 0.1, "{away} at {}", pair[0].time);
        }
    }
}
