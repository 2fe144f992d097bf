//! Paths written down by hand, and their comparison with what came out.

use framepath_tool::program::contour::{ContourMove, Shape};

/// Points agree when they are nearer.
pub const NEAR: f64 = 1e-6;

/// A centre is the sum of two rounded numbers.
pub const NEAR_CENTRE: f64 = 2e-6;

/// One step of a path; coordinates of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A straight line to this point.
    Line([f64; 3]),
    /// An arc in the XY plane to this point about this centre, counterclockwise or not.
    Arc([f64; 3], [f64; 2], bool),
}

impl Step {
    /// Where it ends.
    pub fn end(&self) -> [f64; 3] {
        match self {
            Step::Line(end) | Step::Arc(end, ..) => *end,
        }
    }
}

/// A line in the plane Z = 0.
pub fn line(x: f64, y: f64) -> Step {
    Step::Line([x, y, 0.0])
}

/// A clockwise arc in the plane Z = 0.
pub fn clockwise(x: f64, y: f64, centre: [f64; 2]) -> Step {
    Step::Arc([x, y, 0.0], centre, false)
}

/// A counterclockwise arc in the plane Z = 0.
pub fn counterclockwise(x: f64, y: f64, centre: [f64; 2]) -> Step {
    Step::Arc([x, y, 0.0], centre, true)
}

/// Fails unless two paths are the same, step by step.
pub fn assert_same(given: &[Step], wanted: &[Step], what: &str) {
    for (index, (given, wanted)) in given.iter().zip(wanted).enumerate() {
        let same = match (given, wanted) {
            (Step::Line(a), Step::Line(b)) => near(a, b, NEAR),
            (Step::Arc(a, c, left), Step::Arc(b, d, other)) => {
                near(a, b, NEAR) && near(c, d, NEAR_CENTRE) && left == other
            }
            _ => false,
        };
        assert!(same, "{what}: step {index} is {given:?}, not {wanted:?}");
    }
    assert_eq!(given.len(), wanted.len(), "{what}: the number of steps");
}

fn near(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance)
}

/// A contour as steps.
pub fn steps(contour: &[ContourMove]) -> Vec<Step> {
    contour
        .iter()
        .map(|step| match &step.shape {
            Shape::Line { end, .. } => Step::Line(*end),
            Shape::Arc { centre, u, v, .. } => {
                let left = u[0] * v[1] - u[1] * v[0] > 0.0;
                Step::Arc(step.shape.point(1.0), [centre[0], centre[1]], left)
            }
        })
        .collect()
}
