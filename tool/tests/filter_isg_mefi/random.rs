//! Random programs that are right, against evaluators of their own: points are worked out here by the
//! formulas of the manuals, without any list of operations, and both backends must agree.

use crate::machine;
use crate::path::Step;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;
use proptest::prelude::*;

/// Rounded output: six decimals, through frames that scale up to threefold.
const NEAR: f64 = 5e-6;

fn same_ends(program: &str, dialect: Dialect, wanted: &[[f64; 3]]) -> Result<(), TestCaseError> {
    let shop = Shop::with(dialect, program);
    let contour = crate::path::steps(&shop.contour());
    let rewritten = machine::run(&shop.accepted(&["--backend", "program"]));
    let framed = machine::run(&shop.accepted(&["--backend", "kinematics"]));
    for (what, steps) in [
        ("contour", contour),
        ("program", rewritten),
        ("kinematics", framed),
    ] {
        let ends: Vec<[f64; 3]> = steps.iter().map(Step::end).collect();
        let mut at = [0.0; 3];
        let mut given = ends.iter();
        for wanted in wanted {
            let moved = (0..3).any(|axis| (wanted[axis] - at[axis]).abs() > NEAR);
            at = *wanted;
            if !moved {
                continue;
            }
            let end = given.find(|end| (0..3).all(|axis| (end[axis] - wanted[axis]).abs() < NEAR));
            prop_assert!(
                end.is_some(),
                "{what}: {wanted:?} is not in {ends:?}\n{program}"
            );
        }
    }
    Ok(())
}

#[derive(Clone, Debug)]
enum Mefi {
    Mirror([bool; 3]),
    Scale(f64),
    Fraction(f64, f64),
    Shift([Option<f64>; 2]),
    Cancel,
    Absolute([Option<f64>; 3]),
    Incremental([Option<f64>; 3]),
    Call,
}

fn thousandths(range: std::ops::Range<i32>) -> impl Strategy<Value = f64> {
    range.prop_map(|value| f64::from(value) / 1000.0)
}

fn coordinates() -> impl Strategy<Value = [Option<f64>; 3]> {
    let one = || prop::option::of(thousandths(-30_000..30_000));
    (one(), one(), one()).prop_map(|(x, y, z)| [x, y, z])
}

fn mefi() -> impl Strategy<Value = Mefi> {
    prop_oneof![
        any::<[bool; 3]>().prop_map(Mefi::Mirror),
        thousandths(100..3000).prop_map(Mefi::Scale),
        (thousandths(500..1500), thousandths(500..1500)).prop_map(|(a, b)| Mefi::Fraction(a, b)),
        (
            prop::option::of(thousandths(-90_000..90_000)),
            prop::option::of(thousandths(-90_000..90_000))
        )
            .prop_map(|(x, y)| Mefi::Shift([x, y])),
        Just(Mefi::Cancel),
        coordinates().prop_map(Mefi::Absolute),
        coordinates().prop_map(Mefi::Incremental),
        Just(Mefi::Call),
    ]
}

fn words(values: &[Option<f64>]) -> String {
    let letters = ["X", "Y", "Z"];
    letters
        .iter()
        .zip(values)
        .filter_map(|(letter, value)| value.map(|value| format!("{letter}{value} ")))
        .collect()
}

/// The machine coordinate of one axis.
fn mefi_point(value: f64, mirrored: bool, scale: f64, shift: f64) -> f64 {
    (if mirrored { -value } else { value }) * scale + shift
}

#[derive(Clone, Debug)]
enum Isg {
    PlaneMirror(u32),
    AxisMirror([Option<bool>; 3]),
    Offset(bool, [Option<f64>; 3]),
    Rotation(Option<f64>),
    Absolute([Option<f64>; 3]),
    Incremental([Option<f64>; 3]),
    Loop(u32, f64),
    Value(Arithmetic),
}

fn isg() -> impl Strategy<Value = Isg> {
    prop_oneof![
        (20..24_u32).prop_map(Isg::PlaneMirror),
        any::<[Option<bool>; 3]>().prop_map(Isg::AxisMirror),
        (any::<bool>(), coordinates()).prop_map(|(add, values)| Isg::Offset(add, values)),
        prop::option::of(thousandths(-180_000..180_000)).prop_map(Isg::Rotation),
        coordinates().prop_map(Isg::Absolute),
        coordinates().prop_map(Isg::Incremental),
        (1..4_u32, thousandths(-5000..5000)).prop_map(|(count, step)| Isg::Loop(count, step)),
        arithmetic().prop_map(Isg::Value),
    ]
}

/// A formula and its value.
#[derive(Clone, Debug)]
struct Arithmetic {
    text: String,
    value: f64,
}

fn arithmetic() -> impl Strategy<Value = Arithmetic> {
    let leaf = thousandths(1..9000).prop_map(|value| Arithmetic {
        text: format!("{value}"),
        value,
    });
    leaf.prop_recursive(4, 24, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Arithmetic {
                text: format!("[{}+{}]", a.text, b.text),
                value: a.value + b.value,
            }),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Arithmetic {
                text: format!("[{} - {}]", a.text, b.text),
                value: a.value - b.value,
            }),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Arithmetic {
                text: format!("[SIN[{}]*{}]", a.text, b.text),
                value: a.value.to_radians().sin() * b.value,
            }),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Arithmetic {
                text: format!("MAX[{},{}]", a.text, b.text),
                value: a.value.max(b.value),
            }),
            inner.prop_map(|a| Arithmetic {
                text: format!("-ABS[{}]", a.text),
                value: -a.value.abs(),
            }),
        ]
    })
}

/// The control in the fewest words: what each command changes, and the formula for a point.
#[derive(Clone, Debug)]
struct IsgControl {
    plane: [f64; 2],
    axes: [f64; 3],
    offset: [f64; 3],
    angle: f64,
    machine: [f64; 3],
    ends: Vec<[f64; 3]>,
}

impl IsgControl {
    fn to_machine(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let [x, y] = [cos * x - sin * y, sin * x + cos * y];
        let mirrored = [self.plane[0] * x, self.plane[1] * y, z];
        std::array::from_fn(|axis| self.axes[axis] * (mirrored[axis] + self.offset[axis]))
    }

    fn to_program(&self, machine: [f64; 3]) -> [f64; 3] {
        let point: [f64; 3] =
            std::array::from_fn(|axis| self.axes[axis] * machine[axis] - self.offset[axis]);
        let [x, y] = [self.plane[0] * point[0], self.plane[1] * point[1]];
        let (sin, cos) = self.angle.to_radians().sin_cos();
        [cos * x + sin * y, cos * y - sin * x, point[2]]
    }

    fn go(&mut self, change: impl Fn([f64; 3]) -> [f64; 3]) {
        let target = change(self.to_program(self.machine));
        self.machine = self.to_machine(target);
        self.ends.push(self.machine);
    }
}

fn absolute(values: [Option<f64>; 3]) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |point| std::array::from_fn(|axis| values[axis].unwrap_or(point[axis]))
}

fn increment(values: [Option<f64>; 3]) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |point| std::array::from_fn(|axis| point[axis] + values[axis].unwrap_or(0.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn mefi_programs(commands in prop::collection::vec(mefi(), 1..25)) {
        let mut program = "%1\nG0 G90 X1 Y2 Z3 F100\n".to_string();
        let (mut mirrored, mut scale, mut shift) = ([false; 3], 1.0, [0.0; 3]);
        let mut at = [1.0, 2.0, 3.0];
        let mut ends = vec![at];
        for command in commands {
            // Where the tool is, as the program would write it now.
            let inverse = |at: f64, axis: usize, mirrored: &[bool; 3], scale: f64, shift: &[f64; 3]| {
                (at - shift[axis]) / scale * if mirrored[axis] { -1.0 } else { 1.0 }
            };
            let mut target: Option<[f64; 3]> = None;
            let here: [f64; 3] = std::array::from_fn(|axis| inverse(at[axis], axis, &mirrored, scale, &shift));
            match command {
                Mefi::Mirror(axes) => {
                    mirrored = axes;
                    let named = axes.map(|axis| axis.then_some(0.0));
                    program.push_str(&format!("G35 {}\n", words(&named)));
                }
                Mefi::Scale(factor) => {
                    scale = factor;
                    program.push_str(&format!("G36 X{factor}\n"));
                }
                Mefi::Fraction(a, b) => {
                    scale = a / b;
                    program.push_str(&format!("G36 X{a} Y{b}\n"));
                }
                Mefi::Shift([x, y]) => {
                    shift = [x.unwrap_or(0.0), y.unwrap_or(0.0), 0.0];
                    program.push_str(&format!("G37 {}\n", words(&[x, y])));
                }
                Mefi::Cancel => {
                    (mirrored, scale, shift) = ([false; 3], 1.0, [0.0; 3]);
                    program.push_str("G34\n");
                }
                Mefi::Absolute(values) => {
                    target = Some(absolute(values)(here));
                    program.push_str(&format!("G90 G1 {}\n", words(&values)));
                }
                Mefi::Incremental(values) => {
                    target = Some(increment(values)(here));
                    program.push_str(&format!("G91 G0 {}\n", words(&values)));
                }
                Mefi::Call => {
                    target = Some([here[0] + 2.0, here[1], here[2]]);
                    program.push_str("G71 L3 Q2\n");
                }
            }
            if let Some(target) = target {
                at = std::array::from_fn(|axis| {
                    mefi_point(target[axis], mirrored[axis], scale, shift[axis])
                });
                ends.push(at);
            }
        }
        program.push_str("M30\nG79 L3\nG91 G0 X1\nG70\n");
        same_ends(&program, Dialect::Mefi, &ends)?;
    }

    #[test]
    fn isg_programs(commands in prop::collection::vec(isg(), 1..25)) {
        let mut program = "G00 G90 X1 Y2 Z3 F100\n".to_string();
        let mut control = IsgControl {
            plane: [1.0; 2],
            axes: [1.0; 3],
            offset: [0.0; 3],
            angle: 0.0,
            machine: [1.0, 2.0, 3.0],
            ends: vec![[1.0, 2.0, 3.0]],
        };
        for command in commands {
            match command {
                Isg::PlaneMirror(code) => {
                    control.plane = [
                        if matches!(code, 21 | 23) { -1.0 } else { 1.0 },
                        if matches!(code, 22 | 23) { -1.0 } else { 1.0 },
                    ];
                    program.push_str(&format!("G{code}\n"));
                }
                Isg::AxisMirror(axes) => {
                    let values = axes.map(|axis| axis.map(|on| if on { -1.0 } else { 1.0 }));
                    if values == [None; 3] {
                        continue;
                    }
                    for (sign, value) in control.axes.iter_mut().zip(values) {
                        *sign = value.unwrap_or(*sign);
                    }
                    program.push_str(&format!("G351 {}\n", words(&values)));
                }
                Isg::Offset(add, values) => {
                    if values == [None; 3] {
                        continue;
                    }
                    for (offset, value) in control.offset.iter_mut().zip(values) {
                        if let Some(value) = value {
                            *offset = value + if add { *offset } else { 0.0 };
                        }
                    }
                    let mode = if add { "G91" } else { "G90" };
                    program.push_str(&format!("{mode} G92 {}\n", words(&values)));
                }
                Isg::Rotation(angle) => {
                    control.angle = angle.unwrap_or(0.0);
                    program.push_str(&match angle {
                        Some(angle) => format!("#ROTATION ON [ANGLE={angle}]\n"),
                        None => "#ROTATION OFF\n".to_string(),
                    });
                }
                Isg::Absolute(values) => {
                    control.go(absolute(values));
                    program.push_str(&format!("G90 G01 {}\n", words(&values)));
                }
                Isg::Incremental(values) => {
                    control.go(increment(values));
                    program.push_str(&format!("G91 G00 {}\n", words(&values)));
                }
                Isg::Loop(count, step) => {
                    for pass in 1..=count {
                        control.go(increment([Some(f64::from(pass) * step), None, None]));
                    }
                    program.push_str(&format!(
                        "$FOR P1=1,{count},1\nG91 G01 X[P1*{step}]\n$ENDFOR\n"
                    ));
                }
                Isg::Value(value) => {
                    if value.value.abs() > 1e4 {
                        continue;
                    }
                    control.go(absolute([None, Some(value.value), None]));
                    program.push_str(&format!("P5={}\nG90 G01 YP5\n", value.text));
                }
            }
        }
        program.push_str("M30\n");
        same_ends(&program, Dialect::Isg, &control.ends)?;
    }
}
