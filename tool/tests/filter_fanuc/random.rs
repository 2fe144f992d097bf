//! Random programs that are right, against an evaluator of its own: points are mirrored, then scaled, then
//! turned as the manual says, with the centre and the angle changed on the way.

use crate::shop::Shop;
use framepath_tool::dialects::Dialect;
use proptest::prelude::*;

const NEAR: f64 = 1e-6;

#[derive(Clone, Debug)]
struct Frame {
    mirror: [Option<f64>; 2],
    scale: Option<([f64; 2], f64)>,
    rotation: Option<([f64; 2], f64)>,
}

impl Frame {
    fn mirrored(&self, point: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| match self.mirror[axis] {
            Some(at) => 2.0 * at - point[axis],
            None => point[axis],
        })
    }

    /// The centre of the scale is mirrored with the points.
    fn scaled(&self, point: [f64; 2]) -> [f64; 2] {
        let Some((centre, factor)) = self.scale else {
            return point;
        };
        let centre = self.mirrored(centre);
        std::array::from_fn(|axis| centre[axis] + factor * (point[axis] - centre[axis]))
    }

    fn to_machine(&self, point: [f64; 2]) -> [f64; 2] {
        let point = self.scaled(self.mirrored(point));
        let Some((centre, angle)) = self.rotation else {
            return point;
        };
        let centre = self.scaled(self.mirrored(centre));
        let single = self.mirror.iter().flatten().count() == 1;
        let angle = if single { -angle } else { angle };
        let (sin, cos) = angle.to_radians().sin_cos();
        let [x, y] = [point[0] - centre[0], point[1] - centre[1]];
        [centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y]
    }

    /// The blocks that begin it, and those that end it.
    fn blocks(&self) -> [String; 2] {
        let (mut begin, mut end) = (String::new(), String::new());
        for (letter, at) in ["X", "Y"].iter().zip(self.mirror) {
            if let Some(at) = at {
                begin += &format!("G51.1 {letter}{at:.3}\n");
                end = format!("G50.1 {letter}0\n{end}");
            }
        }
        if let Some(([x, y], factor)) = self.scale {
            begin += &format!("G51 X{x:.3} Y{y:.3} Z0 P{factor:.3}\n");
            end = format!("G50\n{end}");
        }
        if let Some(([x, y], angle)) = self.rotation {
            begin += &format!("G68 X{x:.3} Y{y:.3} R{angle:.3}\n");
            end = format!("G69\n{end}");
        }
        [begin, end]
    }
}

fn thousandths(range: std::ops::Range<i32>) -> impl Strategy<Value = f64> {
    range.prop_map(|value| f64::from(value) / 1000.0)
}

fn point() -> impl Strategy<Value = [f64; 2]> {
    (thousandths(-30_000..30_000), thousandths(-30_000..30_000)).prop_map(|(x, y)| [x, y])
}

fn frame() -> impl Strategy<Value = Frame> {
    let mirror = || prop::option::of(thousandths(-30_000..30_000));
    (
        (mirror(), mirror()),
        prop::option::of((point(), thousandths(200..3000))),
        prop::option::of((point(), thousandths(-180_000..180_000))),
    )
        .prop_map(|((x, y), scale, rotation)| Frame {
            mirror: [x, y],
            scale,
            rotation,
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn frames_inside_each_other(parts in prop::collection::vec((frame(), prop::collection::vec(point(), 1..4)), 1..5)) {
        let mut program = "G0 X1. Y2. Z0\nF100.\n".to_string();
        let mut wanted = vec![[1.0, 2.0]];
        for (frame, points) in &parts {
            let [begin, end] = frame.blocks();
            program += &begin;
            for [x, y] in points {
                program += &format!("G1 X{x:.3} Y{y:.3}\n");
                wanted.push(frame.to_machine([*x, *y]));
            }
            program += &end;
        }
        program += "M30\n";
        let contour = Shop::with(Dialect::Fanuc, &program).contour();
        let mut ends = contour.iter().map(|step| step.shape.point(1.0));
        let mut at = [0.0; 2];
        for wanted in wanted {
            if (0..2).all(|axis| (wanted[axis] - at[axis]).abs() < NEAR) {
                continue;
            }
            at = wanted;
            let end = ends.find(|end| (0..2).all(|axis| (end[axis] - wanted[axis]).abs() < NEAR));
            prop_assert!(end.is_some(), "{wanted:?} is missing\n{program}");
        }
    }
}
