//! Paths for the tests of the look-ahead: polylines with kernel blends, circles, smooth curves.

pub mod run;

use framepath::axes::Axes;
use framepath::moves::shape::PathPoint;
use framepath::speed::look_ahead::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};

/// A polyline in XYZ whose corners are blended by the kernel 15/16 (1 - x^2)^2.
#[derive(Clone, Debug)]
pub struct Polyline {
    points: Vec<[f64; 3]>,
    /// s of each point.
    positions: Vec<f64>,
    /// Reach of the blend at each point, 0 at both ends.
    reaches: Vec<f64>,
    /// Feed of each leg.
    pub feeds: Vec<f64>,
    /// How many legs are known.
    pub known: usize,
    greatest_reach: f64,
    /// Whether blends reach beyond their legs.
    smooth: bool,
}

impl Polyline {
    /// Blends that deviate by `tolerance` at most and reach to the middle of the legs at most.
    pub fn new(points: Vec<[f64; 3]>, tolerance: f64, feed: f64) -> Self {
        let mut positions = vec![0.0];
        for pair in points.windows(2) {
            let length = (Axes3::of(pair[1]) - Axes3::of(pair[0])).norm();
            positions.push(positions[positions.len() - 1] + length);
        }
        let legs = points.len() - 1;
        let mut line = Self {
            reaches: vec![0.0; points.len()],
            feeds: vec![feed; legs],
            known: legs,
            greatest_reach: 0.0,
            smooth: false,
            points,
            positions,
        };
        for i in 1..legs {
            let turn = line.turn(i).norm();
            let before = line.positions[i] - line.positions[i - 1];
            let behind = line.positions[i + 1] - line.positions[i];
            let half = 0.499 * f64::min(before, behind);
            if turn > 1e-7 {
                line.reaches[i] = (tolerance / (0.15625 * turn)).min(half);
            }
        }
        line.greatest_reach = line.reaches.iter().copied().fold(0.0, f64::max);
        line
    }

    /// Blends of equal reach that overlap, shorter towards both ends.
    pub fn smooth(points: Vec<[f64; 3]>, reach: f64, feed: f64) -> Self {
        let mut line = Self::new(points, 0.0, feed);
        for i in 1..line.legs() {
            let to_start = line.positions[i];
            let to_end = line.length() - to_start;
            line.reaches[i] = reach.min(to_start).min(to_end);
        }
        line.greatest_reach = reach;
        line.smooth = true;
        line
    }

    pub fn legs(&self) -> usize {
        self.feeds.len()
    }

    pub fn length(&self) -> f64 {
        self.positions[self.legs()]
    }

    fn direction(&self, leg: usize) -> Axes3 {
        let d = Axes3::of(self.points[leg + 1]) - Axes3::of(self.points[leg]);
        d / d.norm()
    }

    fn turn(&self, i: usize) -> Axes3 {
        self.direction(i) - self.direction(i - 1)
    }

    fn leg_at(&self, s: f64) -> usize {
        let behind = self.positions.partition_point(|position| *position <= s);
        behind.saturating_sub(1).min(self.legs() - 1)
    }

    fn vertex(&self, i: usize) -> RouteVertex {
        RouteVertex {
            position: self.positions[i],
            reach: self.reaches[i],
            core: 0.0,
            cap_changes: i > 0 && i < self.legs() && self.feeds[i] != self.feeds[i - 1],
            may_jump: true,
        }
    }
}

/// A vector in XYZ.
type Axes3 = Spatial;

#[derive(Clone, Copy)]
struct Spatial([f64; 3]);

impl Spatial {
    fn of(values: [f64; 3]) -> Self {
        Self(values)
    }
    fn norm(self) -> f64 {
        self.0.iter().map(|x| x * x).sum::<f64>().sqrt()
    }
    fn axes(self) -> Axes {
        let [x, y, z] = self.0;
        Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }
}

impl std::ops::Sub for Spatial {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl std::ops::Div<f64> for Spatial {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self(self.0.map(|x| x / divisor))
    }
}

impl Route for Polyline {
    fn point(&self, s: f64) -> PathPoint {
        let leg = self.leg_at(s);
        let direction = self.direction(leg).axes();
        let mut point = PathPoint {
            position: Spatial::of(self.points[leg]).axes() + direction * (s - self.positions[leg]),
            first: direction,
            second: Axes::zeros(),
            third: Axes::zeros(),
        };
        let from = self
            .positions
            .partition_point(|x| *x < s - self.greatest_reach);
        let to = self
            .positions
            .partition_point(|x| *x <= s + self.greatest_reach);
        for i in from.max(1)..to.min(self.legs()) {
            let w = self.reaches[i];
            let d = s - self.positions[i];
            let x = d.abs() / w;
            if w == 0.0 || x >= 1.0 {
                continue;
            }
            let sign = d.signum();
            let turn = self.turn(i).axes();
            let xx = x * x;
            let phi = 0.15625 - 0.5 * x + xx * (0.46875 + xx * (-0.15625 + xx * 0.03125));
            let slope = -0.5 + x * (0.9375 + xx * (-0.625 + xx * 0.1875));
            let kernel = 0.9375 * (1.0 - xx) * (1.0 - xx);
            let change = -3.75 * x * (1.0 - xx);
            point.position += turn * (w * phi);
            point.first += turn * (sign * slope);
            point.second += turn * (kernel / w);
            point.third += turn * (sign * change / (w * w));
        }
        point
    }

    fn known_end(&self) -> f64 {
        if self.is_complete() {
            self.length()
        } else {
            // What the next vertex does to the known legs is not known yet.
            let end = self.positions[self.known];
            let half = 0.5 * (end - self.positions[self.known - 1]);
            let reach = if self.smooth {
                self.greatest_reach
            } else {
                half
            };
            (end - reach).max(0.0)
        }
    }

    fn is_complete(&self) -> bool {
        self.known == self.legs()
    }

    fn speed_cap(&self, s: f64, first: &Axes) -> SpeedCap {
        let leg = self.leg_at(s);
        let mut feed = self.feeds[leg];
        if leg > 0 && s - self.positions[leg] < 1e-9 {
            feed = feed.min(self.feeds[leg - 1]);
        }
        let slope = first.norm();
        SpeedCap {
            programmed: feed / slope,
            greatest: 1e4,
        }
    }

    fn vertex_after(&self, s: f64) -> Option<RouteVertex> {
        let i = self
            .positions
            .partition_point(|position| *position <= s)
            .max(1);
        (i < self.legs()).then(|| self.vertex(i))
    }

    fn vertex_before(&self, s: f64) -> Option<RouteVertex> {
        let i = self.positions.partition_point(|position| *position < s);
        (i > 1).then(|| self.vertex(i - 1))
    }

    fn greatest_reach(&self) -> f64 {
        self.greatest_reach
    }

    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        let edges = (1..self.legs()).flat_map(|i| {
            let (center, reach) = (self.positions[i], self.reaches[i]);
            [center - reach, center + reach]
        });
        let inside = edges.filter(|place| from < *place && *place < to);
        places
            .iter_mut()
            .zip(inside)
            .map(|(place, edge)| *place = edge)
            .count()
    }
}

/// A curve in closed form, known as a whole.
pub struct Curve<F: Fn(f64) -> PathPoint> {
    pub point: F,
    pub length: f64,
    pub feed: f64,
}

impl<F: Fn(f64) -> PathPoint> Route for Curve<F> {
    fn point(&self, s: f64) -> PathPoint {
        (self.point)(s)
    }
    fn known_end(&self) -> f64 {
        self.length
    }
    fn is_complete(&self) -> bool {
        true
    }
    fn speed_cap(&self, _: f64, first: &Axes) -> SpeedCap {
        let speed = self.feed / first.norm();
        SpeedCap {
            programmed: speed,
            greatest: 10.0 * speed,
        }
    }
    fn vertex_after(&self, _: f64) -> Option<RouteVertex> {
        None
    }
    fn vertex_before(&self, _: f64) -> Option<RouteVertex> {
        None
    }
    fn greatest_reach(&self) -> f64 {
        0.0
    }
    fn breakpoints(&self, _: f64, _: f64, _: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        0
    }
}

fn planar(x: f64, y: f64) -> Axes {
    Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// Turns of a circle.
pub fn circle(radius: f64, turns: f64, feed: f64) -> Curve<impl Fn(f64) -> PathPoint> {
    Curve {
        point: move |s: f64| {
            let (sine, cosine) = (s / radius).sin_cos();
            PathPoint {
                position: planar(radius * cosine, radius * sine),
                first: planar(-sine, cosine),
                second: planar(-cosine, -sine) / radius,
                third: planar(sine, -cosine) / (radius * radius),
            }
        },
        length: std::f64::consts::TAU * radius * turns,
        feed,
    }
}

/// A curve of Lissajous, with varying |q'|: X and Y cross 20 mm with frequencies 1 and 2.
pub fn lissajous(feed: f64) -> Curve<impl Fn(f64) -> PathPoint> {
    Curve {
        point: move |s: f64| {
            let (f, g) = (0.1, 0.2);
            PathPoint {
                position: planar(10.0 * (f * s).sin(), 10.0 * (g * s).sin()),
                first: planar(10.0 * f * (f * s).cos(), 10.0 * g * (g * s).cos()),
                second: planar(-10.0 * f * f * (f * s).sin(), -10.0 * g * g * (g * s).sin()),
                third: planar(
                    -10.0 * f * f * f * (f * s).cos(),
                    -10.0 * g * g * g * (g * s).cos(),
                ),
            }
        },
        length: 55.0,
        feed,
    }
}

/// `legs` legs of 10 mm, each perpendicular to the one before.
pub fn zigzag(legs: usize, tolerance: f64, feed: f64) -> Polyline {
    let mut points = vec![[0.0; 3]];
    let mut last = [0.0; 3];
    for leg in 0..legs {
        last[leg % 2] += 10.0;
        points.push(last);
    }
    Polyline::new(points, tolerance, feed)
}

/// A contour with radii of 3 to 20 mm in legs of 0.2 mm, smoothed over 1.5 mm.
pub fn contour(legs: usize, feed: f64) -> Polyline {
    let (mut heading, mut x, mut y) = (0.0f64, 0.0, 0.0);
    let mut points = vec![[0.0; 3]];
    for leg in 0..legs {
        let s = 0.2 * leg as f64;
        let curvature =
            0.08 + 0.22 * (s * 0.11).sin() * (s * 0.037 + 1.0).cos() + 0.1 * (0.31 * s).sin();
        heading += 0.2 * curvature;
        x += 0.2 * heading.cos();
        y += 0.2 * heading.sin();
        points.push([x, y, 0.0]);
    }
    Polyline::smooth(points, 1.5, feed)
}

/// A straight line of this length along X.
pub fn line(length: f64, feed: f64) -> Polyline {
    Polyline::new(vec![[0.0; 3], [length, 0.0, 0.0]], 0.01, feed)
}
