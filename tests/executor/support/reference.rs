//! References: sequences of moves from rest to rest, along lines and curves, within given limits.

use super::s_curve::SCurve;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::cell::Cell;

/// Position and three derivatives.
pub type Derivatives = [Axes; 4];

/// The shape of a move over its parameter s.
#[allow(clippy::large_enum_variant)] // A few of them, made once.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Direction (any length) in all axes.
    Line(Axes),
    /// Each axis swings with an amplitude, a wave number (radians per unit of s) and a phase,
    /// on top of a line.
    Waves {
        direction: Axes,
        amplitude: Axes,
        wave_number: Axes,
        phase: Axes,
    },
}

impl Shape {
    /// A circle in X and Y.
    pub fn circle(radius: f64) -> Self {
        let mut amplitude = Axes::zeros();
        let mut wave_number = Axes::zeros();
        let mut phase = Axes::zeros();
        amplitude[0] = radius;
        amplitude[1] = radius;
        wave_number[0] = 1.0 / radius;
        wave_number[1] = 1.0 / radius;
        phase[1] = -std::f64::consts::FRAC_PI_2;
        Self::Waves {
            direction: Axes::zeros(),
            amplitude,
            wave_number,
            phase,
        }
    }

    /// Offset from the start of the move and derivatives by s.
    fn at(&self, s: f64) -> Derivatives {
        match self {
            Self::Line(direction) => [direction * s, *direction, Axes::zeros(), Axes::zeros()],
            Self::Waves {
                direction,
                amplitude,
                wave_number,
                phase,
            } => {
                let mut d = [direction * s, *direction, Axes::zeros(), Axes::zeros()];
                for i in 0..9 {
                    let (a, k, p) = (amplitude[i], wave_number[i], phase[i]);
                    let (sin, cos) = (k * s + p).sin_cos();
                    d[0][i] += a * (sin - p.sin());
                    d[1][i] += a * k * cos;
                    d[2][i] -= a * k * k * sin;
                    d[3][i] -= a * k * k * k * cos;
                }
                d
            }
        }
    }
}

/// One move of a reference, from rest to rest.
#[derive(Clone, Debug)]
pub struct Move {
    pub shape: Shape,
    pub curve: SCurve,
    /// Time is stretched by this factor so that the limits hold.
    pub stretch: f64,
    pub programmed_feed: f64,
    pub rapid: bool,
    pub override_enabled: bool,
}

impl Move {
    /// Along `shape` up to s = `length`, as fast as the limits and the feed allow: an S-curve over
    /// s, made slower as a whole until no axis exceeds `part` of a limit.
    pub fn new(shape: Shape, length: f64, feed: f64, limits: &AxisLimits, part: f64) -> Self {
        let direction = shape.at(0.0)[1];
        let along = |limit: &Axes| {
            limit
                .iter()
                .zip(direction.iter())
                .map(|(limit, d)| limit / d.abs().max(1e-9))
                .fold(f64::INFINITY, f64::min)
        };
        let v = along(&limits.velocity).min(feed / path_speed(&direction));
        let curve = SCurve::new(
            length,
            v * part,
            along(&limits.acceleration) * part,
            along(&limits.jerk) * part,
        );
        let mut made = Self {
            shape,
            curve,
            stretch: 1.0,
            programmed_feed: feed,
            rapid: false,
            override_enabled: true,
        };
        let mut stretch = 1.0_f64;
        let duration = made.curve.duration();
        let mut include = |d: Derivatives| {
            stretch = stretch.max(path_speed(&d[1]) / feed);
            let worst =
                |values: &Axes, limits: &Axes| values.abs().component_div(limits).max() / part;
            stretch = stretch.max(worst(&d[1], &limits.velocity));
            stretch = stretch.max(worst(&d[2], &limits.acceleration).sqrt());
            stretch = stretch.max(worst(&d[3], &limits.jerk).cbrt());
        };
        // The greatest values are at the ends of the phases: all of these are among the samples.
        for phase in made.curve.breaks().windows(2) {
            let length = phase[1] - phase[0];
            let count = (4000.0 * length / duration).ceil().max(100.0) as u32;
            for i in 0..count {
                include(made.derivatives(phase[0] + length * f64::from(i) / f64::from(count)));
            }
            include(made.derivatives_before(phase[1]));
        }
        if stretch > 1.0 + 1e-9 {
            made.stretch = stretch * 1.0005;
        }
        made
    }

    pub fn duration(&self) -> f64 {
        self.curve.duration() * self.stretch
    }

    fn breaks(&self) -> impl Iterator<Item = f64> {
        self.curve.breaks().iter().map(|t| t * self.stretch)
    }

    fn derivatives(&self, t: f64) -> Derivatives {
        let state = self.curve.at(t / self.stretch);
        self.chain(state)
    }

    /// The same just before `t`.
    fn derivatives_before(&self, t: f64) -> Derivatives {
        let state = self.curve.at(t / self.stretch - 1e-9);
        self.chain(state)
    }

    fn chain(&self, [s, v, a, j]: [f64; 4]) -> Derivatives {
        let k = self.stretch;
        let (v, a, j) = (v / k, a / (k * k), j / (k * k * k));
        let [q, q1, q2, q3] = self.shape.at(s);
        [
            q,
            q1 * v,
            q2 * (v * v) + q1 * a,
            q3 * (v * v * v) + q2 * (3.0 * v * a) + q1 * j,
        ]
    }
}

/// The speed that F counts: XYZ if they move, else UVW, else ABC.
pub fn path_speed(velocity: &Axes) -> f64 {
    for group in [0, 6, 3] {
        let speed = velocity.fixed_rows::<3>(group).norm();
        if speed > 1e-12 {
            return speed;
        }
    }
    0.0
}

/// Moves one behind the other, each at rest at both ends, without a pause.
#[derive(Clone, Debug)]
pub struct Reference {
    moves: Vec<Move>,
    starts: Vec<f64>,
    positions: Vec<Axes>,
}

impl Reference {
    pub fn new(moves: Vec<Move>) -> Self {
        let mut reference = Self {
            moves: Vec::new(),
            starts: vec![0.0],
            positions: vec![Axes::zeros()],
        };
        for next in moves {
            let i = reference.moves.len();
            let end = reference.positions[i] + next.derivatives(next.duration())[0];
            reference.starts.push(reference.starts[i] + next.duration());
            reference.positions.push(end);
            reference.moves.push(next);
        }
        reference
    }

    pub fn duration(&self) -> f64 {
        self.starts[self.moves.len()]
    }

    /// Index of the move that runs at `t`.
    pub fn index(&self, t: f64) -> usize {
        let after = self.starts.partition_point(|&start| start <= t);
        after.saturating_sub(1).min(self.moves.len() - 1)
    }

    pub fn running(&self, t: f64) -> &Move {
        &self.moves[self.index(t)]
    }

    /// Start of the move with this index, or the end of the last one.
    pub fn start(&self, index: usize) -> f64 {
        self.starts[index]
    }

    pub fn at(&self, t: f64) -> Derivatives {
        let t = t.min(self.duration());
        let i = self.index(t);
        let mut d = self.moves[i].derivatives(t - self.starts[i]);
        d[0] += self.positions[i];
        d
    }

    fn before(&self, t: f64) -> Derivatives {
        let i = self.index(t - 1e-9);
        let mut d = self.moves[i].derivatives_before(t - self.starts[i]);
        d[0] += self.positions[i];
        d
    }

    /// The cell from `start` on, with bounds from samples and from both sides of all jumps.
    pub fn cell(&self, start: f64, period: f64) -> Cell {
        let end = start + period;
        let [_, velocity, acceleration, jerk] = self.at(start);
        let speed = path_speed(&velocity);
        let running = self.running(start);
        let xyz = |axes: &Axes| axes.fixed_rows::<3>(0).into_owned();
        let group = |axes: &Axes| -> [f64; 3] {
            let first = if xyz(&velocity).norm() > 1e-12 {
                0
            } else if velocity.fixed_rows::<3>(6).norm() > 1e-12 {
                6
            } else {
                3
            };
            [axes[first], axes[first + 1], axes[first + 2]]
        };
        let path_acceleration = if speed > 1e-9 {
            let (v, a) = (group(&velocity), group(&acceleration));
            (v[0] * a[0] + v[1] * a[1] + v[2] * a[2]) / speed
        } else {
            path_speed(&acceleration)
        };
        let mut cell = Cell {
            velocity,
            acceleration,
            acceleration_min: acceleration,
            acceleration_max: acceleration,
            jerk_min: jerk,
            jerk_max: jerk,
            path_velocity: speed,
            path_acceleration,
            feed_ratio: 1.0,
            programmed_feed: running.programmed_feed,
            feed_per_turn: None,
            rapid: running.rapid,
            override_enabled: running.override_enabled,
        };
        let mut include = |d: &Derivatives| {
            cell.acceleration_min = cell.acceleration_min.inf(&d[2]);
            cell.acceleration_max = cell.acceleration_max.sup(&d[2]);
            cell.jerk_min = cell.jerk_min.inf(&d[3]);
            cell.jerk_max = cell.jerk_max.sup(&d[3]);
        };
        for i in 0..=6 {
            include(&self.at(start + period * f64::from(i) / 6.0));
        }
        for index in self.index(start)..=self.index(end) {
            for t in self.moves[index].breaks() {
                let t = t + self.starts[index];
                if t >= start - 1e-12 && t <= end + 1e-12 {
                    include(&self.at(t));
                    include(&self.before(t));
                }
            }
        }
        if end >= self.duration() {
            let rest = [Axes::zeros(); 4];
            include(&rest);
        }
        cell
    }
}
