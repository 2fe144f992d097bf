//! One round: the shortest motion with each knot near its own leg, a convex program.
//!
//! With h the duration of a step the positions are linear in the coefficients, velocities over 1/h, accelerations over
//! 1/h^2, jerks over 1/h^3. A speed F asks for |p'| <= F h, which is a cone. h^2 and h^3 are convex, so that their
//! tangents at the h of the last round lie below them: what keeps |p''| <= A (tangent) keeps the limit itself. A knot
//! has to be within the radius of a place on a line that the course follows, less what the course is off the line there:
//! then it is near the course. Where the motion before
//! fulfils all of it this one does, and is no slower; clarabel finds it.

use super::check::Pass;
use super::course::{Course, Follows, Line, Place};
use super::motion::{
    ACCELERATION_WEIGHTS, AT_REST, JERK_WEIGHTS, Motion, VELOCITY_HULL, position_weights,
};
use crate::optimum::limits::PathLimits;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus,
    SupportedConeT,
};

/// Unknowns of a knot: three coordinates, and those of the line near which it is.
const OF_A_KNOT: usize = 3 + OF_A_LINE;

/// Unknowns of a line: how far the place goes along it, and how far the course is off it there.
const OF_A_LINE: usize = 2;

/// The duration falls in a round to no less than this share.
const GREATEST_FALL: f64 = 0.75;

/// The share of the radius that a knot may use: a little is left for what a motion does between the knots.
const INSIDE: f64 = 0.996;

/// What it costs to leave the tube by a radius, in durations.
const OUTSIDE: f64 = 5.0;

/// A place goes no further along its line in a round, in smallest radii.
const GREATEST_SHIFT: f64 = 60.0;

/// What a round starts from.
pub(super) struct Round<'a> {
    pub course: &'a Course,
    pub limits: &'a PathLimits,
    pub motion: &'a Motion,
    /// Of the knots.
    pub places: &'a [Place],
    /// By how much each knot has to stay further inside, mm.
    pub margins: &'a [f64],
    /// Vertices that have to be passed by, and when.
    pub passes: &'a [(usize, Pass)],
}

/// Rows of `right - left x`, each at least zero or together in a cone.
#[derive(Default)]
struct Rows {
    lines: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
}

impl Rows {
    fn push(&mut self, constant: f64, terms: impl IntoIterator<Item = (usize, f64)>) {
        let line = self.right.len();
        for (column, value) in terms {
            self.lines.push(line);
            self.columns.push(column);
            self.values.push(-value);
        }
        self.right.push(constant);
    }
}

impl Round<'_> {
    fn free_knots(&self) -> std::ops::Range<usize> {
        2..self.motion.steps() - 1
    }

    /// Column of the duration over the one before.
    fn duration(&self) -> usize {
        self.free_knots().len() * OF_A_KNOT + self.passes.len() * OF_A_LINE
    }

    /// Column of how far the motion leaves the tube at most, in smallest radii.
    fn outside(&self) -> usize {
        self.duration() + 1
    }

    /// A sum of four coefficients in an axis: what it is, and how it changes with the unknowns, all times `scale`.
    fn sum(
        &self,
        step: usize,
        weights: &[f64; 4],
        axis: usize,
        scale: f64,
    ) -> (f64, Vec<(usize, f64)>) {
        let before = self.motion.weighted(step, weights)[axis] * scale;
        let unit = self.course.least_radius() * scale;
        let free = AT_REST..self.motion.steps();
        let terms = (step..step + 4)
            .zip(weights)
            .filter(|(index, weight)| free.contains(index) && **weight != 0.0)
            .map(|(index, weight)| ((index - AT_REST) * OF_A_KNOT + axis, weight * unit));
        (before, terms.collect())
    }

    /// Both signs of a sum stay within (rate * duration over the one before - less) of what is allowed.
    fn within(
        &self,
        rows: &mut Rows,
        (step, weights): (usize, &[f64; 4]),
        (axis, most): (usize, f64),
        (rate, less): (f64, f64),
    ) {
        if !most.is_finite() {
            return;
        }
        let (value, terms) = self.sum(step, weights, axis, 1.0 / most);
        for sign in [1.0, -1.0] {
            let terms = terms
                .iter()
                .map(|&(column, factor)| (column, -sign * factor));
            rows.push(-less - sign * value, terms.chain([(self.duration(), rate)]));
        }
    }

    fn limits_of_axes(&self, rows: &mut Rows) {
        let h = self.motion.step;
        for step in 0..self.motion.steps() {
            let starts = (step, &VELOCITY_HULL);
            let fastest = self.speed(step);
            for axis in 0..3 {
                let most = self.limits.velocity[axis];
                if most < fastest {
                    self.within(rows, starts, (axis, most * h), (1.0, 0.0));
                }
                let most = self.limits.acceleration[axis] * h * h;
                self.within(
                    rows,
                    (step, &ACCELERATION_WEIGHTS),
                    (axis, most),
                    (2.0, 1.0),
                );
                let most = self.limits.jerk[axis] * h * h * h;
                self.within(rows, (step, &JERK_WEIGHTS), (axis, most), (3.0, 2.0));
            }
        }
    }

    /// The program's in a step, mm/s.
    fn speed(&self, step: usize) -> f64 {
        self.course.legs[self.places[step].leg].speed
    }

    /// The line of each knot, and the first column of its unknowns.
    fn lines_of_knots(&self) -> impl Iterator<Item = (usize, usize, Line)> {
        let most = GREATEST_SHIFT * self.course.least_radius();
        let knots = self.free_knots().enumerate();
        knots.map(move |(index, knot)| {
            let line = self.course.line(self.places[knot], most);
            (knot, index * OF_A_KNOT + 3, line)
        })
    }

    /// The same of the vertices that are passed by.
    fn lines_of_passes(&self) -> impl Iterator<Item = (&Pass, usize, Line)> {
        let most = GREATEST_SHIFT * self.course.least_radius();
        let first = self.free_knots().len() * OF_A_KNOT;
        let passes = self.passes.iter().enumerate();
        passes.map(move |(index, (vertex, pass))| {
            let line = self.course.line_at(*vertex, most).unwrap_or(Line {
                point: self.course.legs[*vertex].start,
                direction: [0.0; 3],
                ahead: Follows::default(),
                back: Follows::default(),
                radius: self.course.radius_at(*vertex),
            });
            (pass, first + index * OF_A_LINE, line)
        })
    }

    /// Each place stays where the course follows its line, and none comes before the one of the knot before.
    fn order(&self, rows: &mut Rows) {
        let unit = self.course.least_radius();
        let mut last: Option<(usize, Place)> = None;
        for (knot, column, line) in self.lines_of_knots() {
            on_the_course(rows, column, &line, unit);
            let place = self.places[knot];
            if let Some((other, before)) = last
                && before.leg == place.leg
            {
                let gap = (place.along - before.along) / unit;
                rows.push(gap, [(column, 1.0), (other, -1.0)]);
            }
            last = Some((column, place));
        }
        for (_, column, line) in self.lines_of_passes() {
            on_the_course(rows, column, &line, unit);
        }
    }

    fn speeds(&self, rows: &mut Rows) -> usize {
        let mut count = 0;
        for step in 0..self.motion.steps() {
            let speed = self.speed(step);
            if !speed.is_finite() {
                continue;
            }
            count += 1;
            rows.push(0.0, [(self.duration(), 1.0)]);
            for axis in 0..3 {
                let scale = 1.0 / (speed * self.motion.step);
                let (value, terms) = self.sum(step, &VELOCITY_HULL, axis, scale);
                rows.push(value, terms);
            }
        }
        count
    }

    /// A position within the radius of a line, less `margin` and less what the course is off the line.
    fn near(
        &self,
        rows: &mut Rows,
        (step, share): (usize, f64),
        (column, line): (usize, &Line),
        margin: f64,
    ) {
        let unit = self.course.least_radius();
        let terms = [(self.outside(), 1.0), (column + 1, -1.0)];
        rows.push((INSIDE * line.radius - margin) / unit, terms);
        for axis in 0..3 {
            let (value, mut terms) = self.sum(step, &position_weights(share), axis, 1.0 / unit);
            terms.push((column, -line.direction[axis]));
            rows.push(value - line.point[axis] / unit, terms);
        }
    }

    fn tube(&self, rows: &mut Rows) -> usize {
        for (knot, column, line) in self.lines_of_knots() {
            self.near(rows, (knot, 0.0), (column, &line), self.margins[knot]);
        }
        for (pass, column, line) in self.lines_of_passes() {
            self.near(rows, (pass.step, pass.share), (column, &line), 0.0);
        }
        self.free_knots().len() + self.passes.len()
    }

    /// The shortest motion.
    pub(super) fn solve(&self) -> Result<Motion, SolverStatus> {
        let mut rows = Rows::default();
        self.limits_of_axes(&mut rows);
        self.order(&mut rows);
        rows.push(-GREATEST_FALL, [(self.duration(), 1.0)]);
        rows.push(0.0, [(self.outside(), 1.0)]);
        let mut cones: Vec<SupportedConeT<f64>> = vec![NonnegativeConeT(rows.right.len())];
        let count = self.speeds(&mut rows) + self.tube(&mut rows);
        cones.extend(std::iter::repeat_n(SecondOrderConeT(4), count));
        let size = self.outside() + 1;
        let mut cost = vec![0.0; size];
        cost[self.duration()] = 1.0;
        cost[self.outside()] = OUTSIDE;
        let settings = DefaultSettings {
            verbose: false,
            max_iter: 100,
            tol_gap_rel: 1e-5,
            tol_gap_abs: 1e-5,
            tol_feas: 1e-7,
            ..DefaultSettings::default()
        };
        let left = CscMatrix::new_from_triplets(
            rows.right.len(),
            size,
            rows.lines,
            rows.columns,
            rows.values,
        );
        let none = CscMatrix::zeros((size, size));
        let mut solver = DefaultSolver::new(&none, &cost, &left, &rows.right, &cones, settings)
            .map_err(|_| SolverStatus::Unsolved)?;
        solver.solve();
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => Ok(self.moved(&solver.solution.x)),
            other => Err(other),
        }
    }

    /// The motion of a solution.
    fn moved(&self, solution: &[f64]) -> Motion {
        let mut motion = self.motion.clone();
        motion.step *= solution[self.duration()];
        let unit = self.course.least_radius();
        let unknowns = solution.chunks_exact(OF_A_KNOT);
        let free = AT_REST..self.motion.steps();
        for (coefficient, change) in motion.coefficients[free].iter_mut().zip(unknowns) {
            for axis in 0..3 {
                coefficient[axis] += unit * change[axis];
            }
        }
        motion
    }
}

/// Unknowns of a line: the place goes along it no further than the course follows, in units of `unit` mm, and the course
/// is off it by what its slopes say.
fn on_the_course(rows: &mut Rows, column: usize, line: &Line, unit: f64) {
    rows.push(0.0, [(column + 1, 1.0)]);
    for (sign, follows) in [(1.0, line.ahead), (-1.0, line.back)] {
        rows.push(follows.reach / unit, [(column, -sign)]);
        if follows.slope > 0.0 {
            let off = [(column + 1, 1.0), (column, -sign * follows.slope)];
            rows.push(follows.slope * follows.exactly / unit, off);
        }
    }
}
