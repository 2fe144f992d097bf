//! Random valid programs of the Sinumerik-like dialect against an evaluator that knows nothing of the
//! filter. What both backends write must lead there.

use crate::shop::{Shop, accepted};
use crate::simulator::{Point, distance, simulate};
use proptest::prelude::*;

/// How far an end may be off: six decimals are written, and scales enlarge their error.
const SAME: f64 = 5e-6;

/// What a coordinate counts from.
#[derive(Clone, Copy, Debug)]
enum Base {
    Modal,
    Absolute,
    Increment,
}

/// One operation of the frame.
#[derive(Clone, Copy, Debug)]
enum Operation {
    Translate([i32; 3]),
    Rotate(i32),
    Scale(i32),
    Mirror(usize),
}

/// Some lines; numbers are whole hundredths, so that text and value are the same.
#[derive(Clone, Debug)]
enum Command {
    Incremental(bool),
    /// Rapid or with feed, to X Y Z, some of which are left out.
    Line(bool, [Option<(Base, i32)>; 3]),
    /// An arc with this centre from the start, over this many hundredths of a degree.
    Arc([i32; 2], i32),
    /// The absolute or the additive form.
    Frame(bool, Operation),
    Clear,
    /// A loop that counts to this number and moves by a quarter of the count each time.
    Loop(u32),
    /// A subprogram that moves by this, so often.
    Call(i32, u32),
}

fn value(hundredths: i32) -> f64 {
    f64::from(hundredths) / 100.0
}

/// The control, as the manual describes it.
struct Evaluator {
    frame: Vec<Operation>,
    at: Point,
    incremental: bool,
    ends: Vec<Point>,
    text: String,
}

impl Operation {
    fn apply(self, [x, y, z]: Point, back: bool) -> Point {
        match self {
            Operation::Translate(shift) => {
                let sign = if back { -1.0 } else { 1.0 };
                let [a, b, c] = shift.map(|word| sign * value(word));
                [x + a, y + b, z + c]
            }
            Operation::Rotate(angle) => {
                let angle = value(angle).to_radians();
                let (sin, cos) = if back { -angle } else { angle }.sin_cos();
                [x * cos - y * sin, x * sin + y * cos, z]
            }
            Operation::Scale(factor) => {
                let factor = if back {
                    1.0 / value(factor)
                } else {
                    value(factor)
                };
                [x * factor, y * factor, z * factor]
            }
            Operation::Mirror(axis) => {
                let mut point = [x, y, z];
                point[axis] = -point[axis];
                point
            }
        }
    }

    fn text(self, additive: bool) -> String {
        let prefix = if additive { "A" } else { "" };
        match self {
            Operation::Translate(shift) => {
                let [x, y, z] = shift.map(value);
                format!("{prefix}TRANS X{x} Y{y} Z{z}")
            }
            Operation::Rotate(angle) => format!("{prefix}ROT RPL={}", value(angle)),
            Operation::Scale(factor) => {
                let factor = value(factor);
                format!("{prefix}SCALE X{factor} Y{factor} Z{factor}")
            }
            Operation::Mirror(axis) => format!("{prefix}MIRROR {}0", ["X", "Y", "Z"][axis]),
        }
    }
}

impl Evaluator {
    /// A place of the program on the machine: the last operation acts first.
    fn place(&self, point: Point) -> Point {
        let operations = self.frame.iter().rev();
        operations.fold(point, |point, operation| operation.apply(point, false))
    }

    /// The place of the program where the tool is.
    fn present(&self) -> Point {
        let operations = self.frame.iter();
        operations.fold(self.at, |point, operation| operation.apply(point, true))
    }

    fn go(&mut self, place: Point) {
        let end = self.place(place);
        if distance(end, self.at) > 1e-7 {
            self.ends.push(end);
        }
        self.at = end;
    }

    fn step(&mut self, step: Point) {
        let present = self.present();
        self.go(std::array::from_fn(|axis| present[axis] + step[axis]));
    }

    fn run(&mut self, command: &Command) {
        let text = match command {
            Command::Incremental(on) => {
                self.incremental = *on;
                if *on { "G91" } else { "G90" }.to_string()
            }
            Command::Line(rapid, words) => {
                let mut place = self.present();
                let mut text = if *rapid { "G0" } else { "G1" }.to_string();
                for (axis, word) in words.iter().enumerate() {
                    let Some((base, word)) = word else {
                        continue;
                    };
                    let number = value(*word);
                    let letter = ["X", "Y", "Z"][axis];
                    let (increment, written) = match base {
                        Base::Modal => (self.incremental, format!(" {letter}{number}")),
                        Base::Absolute => (false, format!(" {letter}=AC({number})")),
                        Base::Increment => (true, format!(" {letter}=IC({number})")),
                    };
                    text.push_str(&written);
                    place[axis] = number + if increment { place[axis] } else { 0.0 };
                }
                self.go(place);
                text
            }
            Command::Arc(centre, sweep) => {
                let [i, j] = centre.map(value);
                let (sin, cos) = value(*sweep).to_radians().sin_cos();
                // From the centre to the start, turned, and back.
                let step = [i - i * cos + j * sin, j - i * sin - j * cos];
                // Three decimals are written: the end is off its circle by less than is allowed.
                let [x, y] = step.map(|step| (step * 1000.0).round() / 1000.0);
                let g = if *sweep > 0 { "G3" } else { "G2" };
                self.step([x, y, 0.0]);
                format!("{g} X=IC({x}) Y=IC({y}) I{i} J{j}")
            }
            Command::Frame(additive, operation) => {
                if !additive {
                    self.frame.clear();
                }
                self.frame.push(*operation);
                operation.text(*additive)
            }
            Command::Clear => {
                self.frame.clear();
                "ROT".to_string()
            }
            Command::Loop(count) => {
                for number in 1..=*count {
                    self.step([f64::from(number) / 4.0, 0.0, -0.5]);
                }
                format!("FOR R1=1 TO {count}\nG1 X=IC(R1/4) Z=IC(-(1+1)/4)\nENDFOR")
            }
            Command::Call(step, passes) => {
                for _ in 0..*passes {
                    self.step([value(*step), -1.0, 0.0]);
                }
                format!("R2={}\nL10 P{passes}", value(*step))
            }
        };
        self.text.push_str(&text);
        self.text.push('\n');
    }
}

fn line() -> impl Strategy<Value = Command> {
    let base = || {
        prop::sample::select(vec![
            Base::Modal,
            Base::Modal,
            Base::Absolute,
            Base::Increment,
        ])
    };
    let word = move || prop::option::weighted(0.7, (base(), -5000..5000_i32));
    let words = [word(), word(), word()];
    let words = words.prop_filter("an axis", |words| words.iter().any(Option::is_some));
    (any::<bool>(), words).prop_map(|(rapid, words)| Command::Line(rapid, words))
}

fn operation() -> impl Strategy<Value = Operation> {
    prop_oneof![
        2 => [-3000..3000_i32, -3000..3000_i32, -3000..3000_i32].prop_map(Operation::Translate),
        2 => (-18000..18000_i32).prop_map(Operation::Rotate),
        1 => (30..250_i32).prop_map(Operation::Scale),
        1 => (0..3_usize).prop_map(Operation::Mirror),
    ]
}

fn command() -> impl Strategy<Value = Command> {
    prop_oneof![
        1 => any::<bool>().prop_map(Command::Incremental),
        5 => line(),
        3 => ([1000..4000_i32, -4000..4000_i32], 500..35000_i32, any::<bool>()).prop_map(
            |(centre, sweep, back)| Command::Arc(centre, if back { -sweep } else { sweep })
        ),
        4 => (any::<bool>(), operation())
            .prop_map(|(additive, operation)| Command::Frame(additive, operation)),
        1 => Just(Command::Clear),
        1 => (1..4_u32).prop_map(Command::Loop),
        1 => (-900..900_i32, 1..4_u32).prop_map(|(step, passes)| Command::Call(step, passes)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    #[test]
    fn valid_programs_end_where_the_control_would(
        commands in prop::collection::vec(command(), 1..25)
    ) {
        let mut evaluator = Evaluator {
            frame: Vec::new(),
            at: [0.0; 3],
            incremental: false,
            ends: Vec::new(),
            text: "%_N_PART_MPF\nG90 G0 X0 Y0 Z0\nG1 F100\n".to_string(),
        };
        // A subprogram changes no mode of the program.
        for command in &commands {
            evaluator.run(command);
        }
        let subprogram = "%_N_L10_SPF\nG1 X=IC(R2) Y=IC(-1)\nM17\n";
        let program = format!("{}M30\n{subprogram}", evaluator.text);
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        for backend in ["program", "kinematics"] {
            let options = ["--backend", backend, "--increment-after-frame", "position"];
            let written = accepted(&shop.run("part.mpf", &options));
            let steps = simulate(&written, [0.0; 3]);
            let ends: Vec<Point> = steps.iter().filter_map(|step| step.points.last().copied()).collect();
            prop_assert_eq!(ends.len(), evaluator.ends.len(), "{}\n{}", program, written);
            for (given, wanted) in ends.iter().zip(&evaluator.ends) {
                prop_assert!(
                    distance(*given, *wanted) < SAME,
                    "{:?}, not {:?}\n{}\n{}", given, wanted, program, written
                );
            }
        }
    }
}
