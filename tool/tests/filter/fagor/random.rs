//! Random valid programs against an evaluator that knows nothing of the filter; and bytes that are no
//! programs at all.

use crate::front_end::run_all;
use crate::shop::{Shop, accepted};
use crate::simulator::{Point, distance, simulate};
use framepath_tool::dialects::Dialect;
use proptest::prelude::*;

/// How far an end may be off: six decimals are written, and scales enlarge their error.
const SAME: f64 = 5e-6;

/// One command; numbers are whole hundredths, so that text and value are the same.
#[derive(Clone, Debug)]
enum Command {
    Incremental(bool),
    /// Rapid or with feed, to X Y Z, some of which are left out.
    Line(bool, [Option<i32>; 3]),
    /// An arc with this centre from the start, over this many degrees in steps of a hundredth.
    Arc([i32; 2], i32),
    Mirror(u32),
    MirrorOff,
    Scale(i32),
    Rotate(i32, [i32; 2]),
    RotateOff,
    Preset([Option<i32>; 3]),
}

/// The control, as the manual describes it.
struct Evaluator {
    mirror: Point,
    scale: f64,
    angle: f64,
    centre: [f64; 2],
    /// Where the part zero is.
    zero: Point,
    at: Point,
    incremental: bool,
    ends: Vec<Point>,
    text: String,
}

impl Evaluator {
    fn new() -> Evaluator {
        Evaluator {
            mirror: [1.0; 3],
            scale: 1.0,
            angle: 0.0,
            centre: [0.0; 2],
            zero: [0.0; 3],
            at: [0.0; 3],
            incremental: false,
            ends: Vec::new(),
            text: "G90 G0 X0 Y0 Z0\nF100\n".to_string(),
        }
    }

    /// A vector of the program on the machine.
    fn vector(&self, v: Point) -> Point {
        let [x, y, z]: Point = std::array::from_fn(|axis| v[axis] * self.mirror[axis] * self.scale);
        let (sin, cos) = self.angle.to_radians().sin_cos();
        [x * cos - y * sin, x * sin + y * cos, z]
    }

    /// A place of the program on the machine.
    fn place(&self, p: Point) -> Point {
        let centre = [self.centre[0], self.centre[1], 0.0];
        let image = self.vector(std::array::from_fn(|axis| p[axis] - centre[axis]));
        std::array::from_fn(|axis| {
            image[axis] + centre[axis] * self.mirror[axis] * self.scale + self.zero[axis]
        })
    }

    /// The place of the program where the tool is.
    fn present(&self) -> Point {
        let turned: Point = std::array::from_fn(|axis| {
            let centre = self.centre.get(axis).copied().unwrap_or(0.0);
            self.at[axis] - self.zero[axis] - centre * self.mirror[axis] * self.scale
        });
        let (sin, cos) = (-self.angle).to_radians().sin_cos();
        let [x, y, z] = turned;
        let straight = [x * cos - y * sin, x * sin + y * cos, z];
        std::array::from_fn(|axis| {
            let centre = self.centre.get(axis).copied().unwrap_or(0.0);
            straight[axis] / (self.mirror[axis] * self.scale) + centre
        })
    }

    fn go(&mut self, end: Point) {
        if distance(end, self.at) > 1e-7 {
            self.ends.push(end);
        }
        self.at = end;
    }

    fn run(&mut self, command: &Command) {
        let value = |hundredths: i32| f64::from(hundredths) / 100.0;
        let axes = |values: &[Option<i32>; 3]| -> String {
            let words = ["X", "Y", "Z"].iter().zip(values);
            words
                .filter_map(|(letter, word)| word.map(|word| format!(" {letter}{}", value(word))))
                .collect()
        };
        let line = match command {
            Command::Incremental(on) => {
                self.incremental = *on;
                if *on { "G91" } else { "G90" }.to_string()
            }
            Command::Line(rapid, values) => {
                let end = if self.incremental {
                    let step = self.vector(values.map(|word| word.map_or(0.0, value)));
                    std::array::from_fn(|axis| self.at[axis] + step[axis])
                } else {
                    let present = self.present();
                    let word = |axis: usize| values[axis].map_or(present[axis], value);
                    self.place([word(0), word(1), word(2)])
                };
                self.go(end);
                format!("{}{}", if *rapid { "G0" } else { "G1" }, axes(values))
            }
            Command::Arc(centre, sweep) => {
                let [i, j] = centre.map(value);
                let (sin, cos) = value(*sweep).to_radians().sin_cos();
                // From the centre to the start, turned, and back.
                let step = [i - i * cos + j * sin, j - i * sin - j * cos];
                // Three decimals are written: the end is off its circle by less than is allowed.
                let step = step.map(|step| (step * 1000.0).round() / 1000.0);
                let g = if *sweep > 0 { "G3" } else { "G2" };
                let end = self.vector([step[0], step[1], 0.0]);
                self.go(std::array::from_fn(|axis| self.at[axis] + end[axis]));
                let mode = if self.incremental { "" } else { "\nG90" };
                format!("G91 {g} X{} Y{} I{i} J{j}{mode}", step[0], step[1])
            }
            Command::Mirror(axis) => {
                self.mirror[*axis as usize] = -1.0;
                format!("G{}", 11 + axis)
            }
            Command::MirrorOff => {
                self.mirror = [1.0; 3];
                "G10".to_string()
            }
            Command::Scale(factor) => {
                self.scale = value(*factor);
                format!("G72 S{}", self.scale)
            }
            Command::Rotate(angle, centre) => {
                let centre = centre.map(value);
                let off = match self.angle != 0.0 && centre != self.centre {
                    true => "G73\n",
                    false => "",
                };
                if !off.is_empty() {
                    self.angle = 0.0;
                }
                self.angle += value(*angle);
                self.centre = centre;
                format!("{off}G73 Q{} I{} J{}", value(*angle), centre[0], centre[1])
            }
            Command::RotateOff => {
                (self.angle, self.centre) = (0.0, [0.0; 2]);
                "G73".to_string()
            }
            Command::Preset(values) => {
                (self.angle, self.centre, self.scale) = (0.0, [0.0; 2], 1.0);
                for (axis, word) in values.iter().enumerate() {
                    if let Some(word) = word {
                        self.zero[axis] = self.at[axis] - value(*word);
                    }
                }
                let mode = if self.incremental { "\nG91" } else { "" };
                format!("G73\nG72 S1\nG90\nG92{}{mode}", axes(values))
            }
        };
        self.text.push_str(&line);
        self.text.push('\n');
    }
}

fn place() -> impl Strategy<Value = [Option<i32>; 3]> {
    let word = || prop::option::weighted(0.7, -5000..5000_i32);
    [word(), word(), word()].prop_filter("an axis", |words| words.iter().any(Option::is_some))
}

fn command() -> impl Strategy<Value = Command> {
    prop_oneof![
        1 => any::<bool>().prop_map(Command::Incremental),
        5 => (any::<bool>(), place()).prop_map(|(rapid, words)| Command::Line(rapid, words)),
        3 => ([1000..4000_i32, -4000..4000_i32], 500..35000_i32, any::<bool>()).prop_map(
            |(centre, sweep, back)| Command::Arc(centre, if back { -sweep } else { sweep })
        ),
        2 => (0..3_u32).prop_map(Command::Mirror),
        1 => Just(Command::MirrorOff),
        2 => (20..300_i32).prop_map(Command::Scale),
        2 => (1..18000_i32, [-2000..2000_i32, -2000..2000_i32])
            .prop_map(|(angle, centre)| Command::Rotate(angle, centre)),
        1 => Just(Command::RotateOff),
        1 => place().prop_map(Command::Preset),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn valid_programs_end_where_the_control_would(
        commands in prop::collection::vec(command(), 1..25)
    ) {
        let mut evaluator = Evaluator::new();
        for command in &commands {
            evaluator.run(command);
        }
        evaluator.text.push_str("M30\n");
        let shop = Shop::new(&[("part.pim", evaluator.text.as_bytes())]);
        for backend in ["program", "kinematics"] {
            let output = shop.run_in("fagor", "part.pim", &["--backend", backend]);
            let written = accepted(&output);
            let steps = simulate(&written, [0.0; 3]);
            let ends: Vec<Point> = steps.iter().filter_map(|step| step.points.last().copied()).collect();
            prop_assert_eq!(ends.len(), evaluator.ends.len(), "{}\n{}", evaluator.text, written);
            for (given, wanted) in ends.iter().zip(&evaluator.ends) {
                prop_assert!(
                    distance(*given, *wanted) < SAME,
                    "{:?}, not {:?}\n{}\n{}", given, wanted, evaluator.text, written
                );
            }
        }
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        run_all(Dialect::Fagor, &bytes);
    }

    #[test]
    fn any_pieces(pieces in prop::collection::vec(piece(), 0..40)) {
        run_all(Dialect::Fagor, pieces.join(" ").as_bytes());
    }
}

/// Pieces of programs, so that much of what is made gets past the parser.
fn piece() -> impl Strategy<Value = String> {
    let fixed = [
        "G0",
        "G1",
        "G2",
        "G3",
        "G8",
        "G9",
        "G10",
        "G11",
        "G12",
        "G14",
        "G36",
        "G39",
        "G37",
        "G38",
        "R2",
        "G17",
        "G18",
        "G40",
        "G41",
        "G43",
        "G53",
        "G54",
        "G72",
        "S2",
        "G73",
        "Q30",
        "G90",
        "G91",
        "G92",
        "G93",
        "G4",
        "K50",
        "G81",
        "G83",
        "G69",
        "G87",
        "G88",
        "B3",
        "H100",
        "L1",
        "G60 X20 I10",
        "G62 X20 K3 J7 D2",
        "G65 X20 Y0 A45",
        "C3",
        "P4",
        "P2.003",
        "N3",
        "J3",
        "G80",
        "G98",
        "G79",
        "F100",
        "M3",
        "M30",
        "T1.2",
        "M6",
        "D3",
        "(P1=P1+1)",
        "(P1=2)",
        "XP1",
        "(CALL 1)",
        "(SUB 1)",
        "(RET)",
        "(PCALL 1,A=3)",
        "(MCALL 1)",
        "(MDOFF)",
        "(IF P1 GT 3 GOTO N50)",
        "N50",
        "N10",
        "(RPT N10,N50) N3",
        "(MSG \"a\")",
        "%A,MX--,",
        ";c",
        "(",
        ")",
        "=",
        ",",
        "\n",
        "\n",
        "\n",
        "\n",
        "\n",
    ];
    prop_oneof![
        4 => prop::sample::select(fixed.to_vec()).prop_map(str::to_string),
        3 => ("[XYZIJKABCW]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}{value}")),
    ]
}
