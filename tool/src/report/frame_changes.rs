//! Finds where the programmed frame changed: the axes get new values while the machine stands.
//!
//! At such a row the position of the axes is no motion, so no velocity may be taken across it;
//! and no joint may move there at all.

use serde::Serialize;

use super::recording::Recording;

/// Rows before a change in which the joints have to stand.
const BEFORE: usize = 4;

/// Rows after a change in which the joints have to stand: LinuxCNC's cubic interpolation spreads a
/// step over so many, and the next move may begin right behind them.
const AFTER: usize = 2;

/// Joints that move less than this share of the step of an axis count as standing; how far they
/// moved is reported.
const STANDING_SHARE: f64 = 1e-3;

/// Steps of an axis below this, units, are rounding.
const LEAST_STEP: f64 = 1e-9;

/// A change of the frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameChange {
    /// The first row in the new frame.
    #[serde(skip)]
    pub row: usize,
    /// Seconds.
    pub time: f64,
    /// Program line.
    pub line: i64,
    /// Greatest step of an axis, units.
    pub axis_step: f64,
    /// How far any joint moved in the cycles around the change, units; 0 is right.
    pub joint_movement: f64,
}

/// All changes of the frame in a recording, in order.
///
/// A step of an axis that the joints follow is motion, or a fault, and no change of the frame: it
/// stays in the velocities and accelerations, where it is reported against their limits.
pub fn find_frame_changes(recording: &Recording) -> Vec<FrameChange> {
    let mut changes: Vec<FrameChange> = Vec::new();
    for row in 1..recording.rows() {
        let axis_step = recording
            .axes
            .iter()
            .map(|(_, positions)| (positions[row] - positions[row - 1]).abs())
            .fold(0.0, f64::max);
        let moved = |from: usize, to: usize| {
            recording
                .joints
                .iter()
                .map(|positions| travel(positions.get(from..=to).unwrap_or_default()))
                .fold(0.0, f64::max)
        };
        let allowed = STANDING_SHARE * axis_step;
        let rounding = LEAST_STEP.max(4.0 * recording.resolution);
        if axis_step <= rounding || moved(row - 1, row) > allowed {
            continue;
        }
        let last = (row + AFTER).min(recording.rows() - 1);
        let joint_movement = moved(row.saturating_sub(BEFORE), last);
        if joint_movement <= allowed {
            changes.push(FrameChange {
                row,
                time: recording.times[row],
                line: recording.lines[row],
                axis_step,
                joint_movement,
            });
        }
    }
    changes
}

/// Greatest minus least of some positions.
fn travel(positions: &[f64]) -> f64 {
    let least = positions.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = positions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (greatest - least).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::recording::tests::recording_of;
    use super::*;

    /// X: 50 ms of rest, then motion with constant jerk.
    fn standing_then_moving() -> Recording {
        let points: Vec<[f64; 3]> = (0..100)
            .map(|row| {
                let t = f64::max(0.0, f64::from(row - 50) * 0.001);
                [20000.0 * t * t * t / 6.0, 0.0, 0.0]
            })
            .collect();
        recording_of(&points, |_| 7)
    }

    #[test]
    fn motion_is_no_frame_change() {
        assert!(find_frame_changes(&standing_then_moving()).is_empty());
    }

    #[test]
    fn a_step_of_the_axes_alone_is_one() {
        let mut recording = standing_then_moving();
        for position in &mut recording.axes[1].1[20..] {
            *position += 12.5;
        }
        let changes = find_frame_changes(&recording);
        assert_eq!(changes.len(), 1);
        assert_eq!((changes[0].row, changes[0].line), (20, 7));
        assert_eq!(
            (changes[0].axis_step, changes[0].joint_movement),
            (12.5, 0.0)
        );
    }

    #[test]
    fn a_joint_that_moves_a_little_is_reported_and_one_that_follows_is_no_frame_change() {
        let mut recording = standing_then_moving();
        for position in &mut recording.axes[1].1[20..] {
            *position += 12.5;
        }
        for position in &mut recording.joints[2][21..] {
            *position += 0.005;
        }
        let changes = find_frame_changes(&recording);
        assert_eq!(changes.len(), 1);
        assert!((changes[0].joint_movement - 0.005).abs() < 1e-15);
        for position in &mut recording.joints[1][21..] {
            *position += 12.5;
        }
        assert!(find_frame_changes(&recording).is_empty());
    }
}
