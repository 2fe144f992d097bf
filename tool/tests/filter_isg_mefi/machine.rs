//! A machine that reads the G-code that was written: LinuxCNC in miniature, at full precision, for the
//! words that these programs have. Frames are carried out as the subroutines of framekins define them.

use crate::path::{Step, assert_same, steps};
use crate::shop::Shop;
use nalgebra::{Matrix3, Vector3};

/// Shorter moves are none.
const NOTHING: f64 = 1e-9;

/// What the machine does with a program.
pub struct Machine {
    /// X Y Z A B C U V W, machine coordinates.
    pub position: [f64; 9],
    /// G54 to G59.
    pub work_offsets: [[f64; 3]; 6],
    /// The steps so far.
    pub steps: Vec<Step>,
    /// Feeds of the steps, 0 for rapid ones.
    pub feeds: Vec<f64>,
    system: usize,
    linear: Matrix3<f64>,
    shift: Vector3<f64>,
    motion: u32,
    feed: f64,
}

/// Runs a program on a machine whose work offsets are 0.
pub fn run(program: &str) -> Vec<Step> {
    let mut machine = Machine::new();
    machine.run(program);
    machine.steps
}

impl Machine {
    pub fn new() -> Machine {
        Machine {
            position: [0.0; 9],
            work_offsets: [[0.0; 3]; 6],
            steps: Vec::new(),
            feeds: Vec::new(),
            system: 0,
            linear: Matrix3::identity(),
            shift: Vector3::zeros(),
            motion: 0,
            feed: 0.0,
        }
    }

    pub fn run(&mut self, program: &str) {
        for line in program.lines() {
            let code = line.split('(').next().unwrap_or("");
            match code.split_once("o<") {
                Some((_, call)) => self.call(call),
                None => self.block(code),
            }
        }
    }

    /// `trans> call [1] [2] [3]`.
    fn call(&mut self, call: &str) {
        let (name, arguments) = call.split_once("> call").expect("a call");
        let values: Vec<f64> = arguments
            .split(['[', ']'])
            .filter_map(|value| value.trim().parse().ok())
            .collect();
        let name = match (name, name.strip_prefix('a')) {
            ("frame_off", _) => {
                self.reset_frame();
                return;
            }
            (_, Some(rest)) => rest,
            (name, None) => {
                self.reset_frame();
                name
            }
        };
        let (linear, shift) = match (name, values.as_slice()) {
            ("trans", [x, y, z]) => (Matrix3::identity(), Vector3::new(*x, *y, *z)),
            ("scale", [x, y, z]) => (
                Matrix3::from_diagonal(&Vector3::new(*x, *y, *z)),
                Vector3::zeros(),
            ),
            ("mirror", [x, y, z]) => {
                let sign = |mirrored: f64| 1.0 - 2.0 * mirrored;
                let diagonal = Vector3::new(sign(*x), sign(*y), sign(*z));
                (Matrix3::from_diagonal(&diagonal), Vector3::zeros())
            }
            ("rot", [x, y, z]) => (turn(2, *z) * turn(1, *y) * turn(0, *x), Vector3::zeros()),
            ("rot_rpl", [angle]) => (turn(2, *angle), Vector3::zeros()),
            _ => panic!("an unknown call: {call}"),
        };
        self.shift += self.linear * shift;
        self.linear *= linear;
    }

    fn reset_frame(&mut self) {
        self.linear = Matrix3::identity();
        self.shift = Vector3::zeros();
    }

    /// Where the axes are in the coordinates of the program.
    fn present(&self) -> [f64; 9] {
        let offset = Vector3::from(self.work_offsets[self.system]);
        let tip = Vector3::new(self.position[0], self.position[1], self.position[2]);
        let inverse = self.linear.try_inverse().expect("a frame with an inverse");
        let linear = inverse * (tip - offset - self.shift);
        let mut present = self.position;
        present[..3].copy_from_slice(linear.as_slice());
        present
    }

    fn block(&mut self, code: &str) {
        let present = self.present();
        let words = words(code, &present);
        let mut machine_coordinates = false;
        for (letter, value) in &words {
            match (letter, *value) {
                ('G', 0.0..=3.0) => self.motion = *value as u32,
                ('G', 53.0) => machine_coordinates = true,
                ('G', 54.0..=59.0) => self.system = *value as usize - 54,
                ('F', feed) => self.feed = feed,
                ('G', 18.0..=20.0 | 92.0) => panic!("not for this machine: {code}"),
                _ => {}
            }
        }
        let word = |wanted: char| {
            let mut found = words.iter().filter(|(letter, _)| *letter == wanted);
            found.next().map(|(_, value)| *value)
        };
        let present = self.present();
        let mut target = present;
        let mut moves = false;
        for (axis, letter) in "XYZABCUVW".chars().enumerate() {
            if let Some(value) = word(letter) {
                target[axis] = value;
                moves = true;
            }
        }
        let centre = [word('I'), word('J')];
        if machine_coordinates {
            let mut end = self.position;
            for (axis, letter) in "XYZABCUVW".chars().enumerate() {
                end[axis] = word(letter).unwrap_or(end[axis]);
            }
            self.go(end, None);
        } else if self.motion >= 2 && (moves || centre != [None; 2]) {
            let offset = centre.map(|offset| offset.unwrap_or(0.0));
            self.go(self.world(&target), Some(self.arc_centre(&present, offset)));
        } else if moves {
            self.go(self.world(&target), None);
        }
    }

    fn world(&self, target: &[f64; 9]) -> [f64; 9] {
        let offset = Vector3::from(self.work_offsets[self.system]);
        let point = Vector3::new(target[0], target[1], target[2]);
        let tip = offset + self.linear * point + self.shift;
        let mut world = *target;
        world[..3].copy_from_slice(tip.as_slice());
        world
    }

    fn arc_centre(&self, present: &[f64; 9], offset: [f64; 2]) -> [f64; 2] {
        let mut centre = *present;
        centre[0] += offset[0];
        centre[1] += offset[1];
        let world = self.world(&centre);
        [world[0], world[1]]
    }

    fn go(&mut self, end: [f64; 9], centre: Option<[f64; 2]>) {
        let length: f64 = (0..3)
            .map(|axis| (end[axis] - self.position[axis]).abs())
            .sum();
        self.position = end;
        let point = [end[0], end[1], end[2]];
        let step = match centre {
            Some(centre) => {
                let determinant = self.linear[(0, 0)] * self.linear[(1, 1)]
                    - self.linear[(0, 1)] * self.linear[(1, 0)];
                Step::Arc(point, centre, (self.motion == 3) == (determinant > 0.0))
            }
            None if length < NOTHING => return,
            None => Step::Line(point),
        };
        self.steps.push(step);
        let rapid = self.motion == 0;
        self.feeds.push(if rapid { 0.0 } else { self.feed });
    }
}

fn turn(axis: usize, degrees: f64) -> Matrix3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = Matrix3::identity();
    matrix[(first, first)] = cos;
    matrix[(second, second)] = cos;
    matrix[(first, second)] = -sin;
    matrix[(second, first)] = sin;
    matrix
}

/// The words of a block; values in brackets are sums of numbers and of `#5420` and the like.
fn words(code: &str, present: &[f64; 9]) -> Vec<(char, f64)> {
    let mut words = Vec::new();
    let mut rest = code.trim_start();
    while let Some(letter) = rest.chars().next() {
        let body = &rest[1..];
        let end = match body.strip_prefix('[') {
            Some(inner) => inner.find(']').expect("a bracket") + 2,
            None => body
                .find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)))
                .unwrap_or(body.len()),
        };
        let text = body[..end].trim_matches(['[', ']']);
        words.push((letter, sum(text, present)));
        rest = body[end..].trim_start();
    }
    words
}

fn sum(text: &str, present: &[f64; 9]) -> f64 {
    let mut total = 0.0;
    let mut rest = text;
    while !rest.is_empty() {
        let sign = if rest.starts_with('-') { -1.0 } else { 1.0 };
        let term = rest.trim_start_matches(['+', '-']);
        let end = term.find(['+', '-']).unwrap_or(term.len());
        let value = match term[..end].strip_prefix('#') {
            Some(number) => match number.parse::<usize>().expect("a parameter") {
                // No tool has a length here.
                5401..=5409 => 0.0,
                number => present[number - 5420],
            },
            None => term[..end].parse().expect("a number"),
        };
        total += sign * value;
        rest = &term[end..];
    }
    total
}

/// The path of a program, which both backends and the contour must give.
pub fn path_of(shop: &Shop) -> Vec<Step> {
    let rewritten = run(&shop.accepted(&["--backend", "program"]));
    let framed = run(&shop.accepted(&["--backend", "kinematics"]));
    assert_same(&framed, &rewritten, "the frame kinematics");
    assert_same(&steps(&shop.contour()), &rewritten, "the contour");
    rewritten
}
