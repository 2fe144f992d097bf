//! Which limits and tolerances a plan does not keep, in words.

use super::distances::DistanceFigure;
use super::figures::{AxisFigures, PeakFigure};
use crate::format::{Over, length};
use crate::layer::turns::TurnsLeftAway;
use crate::machine::above_joints::AboveJoint;
use crate::path::exceeded::exceeds;

/// A sentence for each. `movers` are axes and joints, `beyond` is the place farthest beyond its tolerance, `turns` are
/// those that LinuxCNC leaves away, `unit` is that of lengths.
pub fn conclude<'a>(
    movers: impl IntoIterator<Item = &'a AxisFigures>,
    beyond: Option<DistanceFigure>,
    turns: TurnsLeftAway,
    unit: &str,
) -> Vec<String> {
    let mut findings = Vec::new();
    for axis in movers {
        let peaks = axis.peaks.iter();
        let exceeded = |peak: &&PeakFigure| {
            peak.share
                .is_some_and(|share| exceeds(peak.quantity, share))
        };
        for peak in peaks.filter(exceeded) {
            let over = Over {
                name: &axis.name,
                quantity: peak.quantity,
                peak: peak.peak,
                limit: peak.limit.unwrap_or(0.0),
                unit: axis.unit,
                time: peak.time,
                line: peak.line.into(),
            };
            findings.push(over.to_string());
        }
    }
    findings.extend(turns.told());
    findings.extend(beyond.map(|beyond| {
        format!(
            "The planned path is off the programmed path by {}, the tolerance is {}: at line {}",
            length(beyond.distance, unit),
            length(beyond.tolerance.unwrap_or(0.0), unit),
            beyond.line
        )
    }));
    findings
}

/// A sentence for each joint of which an axis asks more than it may do, because the limit of the axis is above its own.
pub fn of_joints(axes: &[AxisFigures], above: &[AboveJoint]) -> Vec<String> {
    let told = |above: &AboveJoint| {
        let axis = axes.iter().find(|axis| axis.letter == Some(above.letter))?;
        let mut peaks = axis.peaks.iter();
        let peak = peaks.find(|peak| peak.quantity.key() == above.key)?;
        let over = Over {
            name: &format!("joint.{}", above.joint),
            quantity: peak.quantity,
            peak: peak.peak,
            limit: above.of_joint,
            unit: axis.unit,
            time: peak.time,
            line: peak.line.into(),
        };
        exceeds(peak.quantity, peak.peak / above.of_joint).then(|| {
            format!(
                "{over}: [AXIS_{}]{} = {} is above it",
                above.letter, above.key, above.of_axis
            )
        })
    };
    above.iter().filter_map(told).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::rates::Quantity;

    fn axis(peak: f64) -> AxisFigures {
        AxisFigures {
            letter: Some('X'),
            name: "axis.x".to_owned(),
            unit: "mm",
            index: 0,
            from: 0.0,
            to: 10.0,
            peaks: vec![PeakFigure {
                quantity: Quantity::Jerk,
                peak,
                limit: Some(20_000.0),
                share: Some(peak / 20_000.0),
                time: 0.5,
                line: 7,
            }],
        }
    }

    #[test]
    fn what_exceeds_what_is_promised_is_told() {
        let none = TurnsLeftAway::default();
        assert!(conclude(&[axis(20_900.0)], None, none, "mm").is_empty());
        let joint = AxisFigures {
            name: "joint.0".to_owned(),
            ..axis(30_000.0)
        };
        assert_eq!(
            conclude([axis(0.0)].iter().chain(&[joint]), None, none, "mm"),
            ["joint.0: jerk is 1.5 times its limit (30000 of 20000 mm/s3) at 0.500 s, line 7"]
        );
        let beyond = DistanceFigure {
            distance: 0.15,
            tolerance: Some(0.1),
            line: 9,
        };
        assert_eq!(
            conclude(&[axis(21_200.0)], Some(beyond), none, "mm"),
            [
                "axis.x: jerk is 1.06 times its limit (21200 of 20000 mm/s3) at 0.500 s, line 7",
                "The planned path is off the programmed path by 0.150 mm, the tolerance is 0.100 mm: at line 9",
            ]
        );
    }
}
