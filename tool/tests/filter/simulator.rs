//! Carries out what the filter writes, as LinuxCNC and the frame subroutines would, without either:
//! the path in machine coordinates, to all digits that were written.
//!
//! Work offsets are zero and no tool is measured. Only what the filter writes is understood.

use std::collections::HashMap;
use std::f64::consts::TAU;

pub type Point = [f64; 3];

/// One move that goes somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub rapid: bool,
    /// The feed in force along the path on the machine; 0 for rapid moves.
    pub feed: f64,
    /// Points at equal parameters from the start to the end.
    pub points: Vec<Point>,
}

/// How many points are taken of a move, besides its start.
pub const PARTS: usize = 8;

/// A map of points: columns and shift.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    columns: [Point; 3],
    shift: Point,
}

impl Map {
    pub const IDENTITY: Map = Map {
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        shift: [0.0; 3],
    };

    fn translate(shift: Point) -> Map {
        Map {
            shift,
            ..Map::IDENTITY
        }
    }

    fn scale(factors: Point) -> Map {
        let mut map = Map::IDENTITY;
        for (axis, factor) in factors.into_iter().enumerate() {
            map.columns[axis][axis] = factor;
        }
        map
    }

    /// About one axis, degrees.
    fn rotate(axis: usize, degrees: f64) -> Map {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
        let mut map = Map::IDENTITY;
        map.columns[first][first] = cos;
        map.columns[first][second] = sin;
        map.columns[second][first] = -sin;
        map.columns[second][second] = cos;
        map
    }

    fn vector(&self, v: Point) -> Point {
        std::array::from_fn(|row| {
            (0..3)
                .map(|column| self.columns[column][row] * v[column])
                .sum()
        })
    }

    fn point(&self, p: Point) -> Point {
        let image = self.vector(p);
        std::array::from_fn(|axis| image[axis] + self.shift[axis])
    }

    fn after(&self, inner: &Map) -> Map {
        Map {
            columns: inner.columns.map(|column| self.vector(column)),
            shift: self.point(inner.shift),
        }
    }

    /// By Cramer's rule.
    fn back(&self, p: Point) -> Point {
        let [a, b, c] = self.columns;
        let d: Point = std::array::from_fn(|axis| p[axis] - self.shift[axis]);
        let triple = |u: Point, v: Point, w: Point| {
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                + u[2] * (v[0] * w[1] - v[1] * w[0])
        };
        let whole = triple(a, b, c);
        [
            triple(d, b, c) / whole,
            triple(a, d, c) / whole,
            triple(a, b, d) / whole,
        ]
    }
}

/// The path of a program from `start`.
pub fn simulate(program: &str, start: Point) -> Vec<Step> {
    let mut machine = Machine {
        frame: Map::IDENTITY,
        preset: [0.0; 3],
        at: start,
        axes: [0.0; 6],
        plane: 2,
        motion: 0,
        feed: 0.0,
        steps: Vec::new(),
    };
    for line in program.lines() {
        let code = line.split('(').next().unwrap_or("");
        match code.split_once("o<") {
            Some((_, call)) => machine.call(call),
            None => machine.words(code),
        }
    }
    machine.steps
}

struct Machine {
    frame: Map,
    preset: Point,
    at: Point,
    /// A B C U V W.
    axes: [f64; 6],
    /// The normal of the plane.
    plane: usize,
    motion: u32,
    feed: f64,
    steps: Vec<Step>,
}

impl Machine {
    fn call(&mut self, call: &str) {
        let (name, rest) = call.split_once("> call").expect("a call");
        let numbers: Vec<f64> = rest
            .split(['[', ']'])
            .filter_map(|number| number.trim().parse().ok())
            .collect();
        let three = || [numbers[0], numbers[1], numbers[2]];
        let additive = name.starts_with('a') && name != "ascale_off";
        let operation = match name.trim_start_matches('a') {
            "frame_off" => Map::IDENTITY,
            "trans" => Map::translate(three()),
            "rot" => {
                let [x, y, z] = three();
                Map::rotate(2, z).after(&Map::rotate(1, y).after(&Map::rotate(0, x)))
            }
            "rot_rpl" => Map::rotate(self.plane, numbers[0]),
            "scale" => Map::scale(three()),
            "mirror" => Map::scale(three().map(|flag| 1.0 - 2.0 * flag)),
            _ => panic!("the simulator has no {name}"),
        };
        self.frame = match additive {
            true => self.frame.after(&operation),
            false => operation,
        };
    }

    /// The frame with the shift of G92.
    fn map(&self) -> Map {
        Map::translate(self.preset).after(&self.frame)
    }

    fn words(&mut self, code: &str) {
        let present = self.map().back(self.at);
        let words = parse(code, present, self.axes);
        let mut values: HashMap<char, f64> = HashMap::new();
        let (mut preset, mut local, mut machine_coordinates) = (false, false, false);
        for (letter, value) in words {
            if letter != 'G' {
                values.insert(letter, value);
                continue;
            }
            match (value * 10.0).round() as u32 {
                0 => self.motion = 0,
                10 => self.motion = 1,
                20 => self.motion = 2,
                30 => self.motion = 3,
                170 => self.plane = 2,
                180 => self.plane = 1,
                190 => self.plane = 0,
                520 => local = true,
                530 => machine_coordinates = true,
                920 => preset = true,
                921 => self.preset = [0.0; 3],
                40
                | 80
                | 210
                | 400
                | 430
                | 490
                | 540..=590
                | 610
                | 611
                | 640
                | 800
                | 900
                | 911
                | 940
                | 950 => {}
                other => panic!("the simulator has no G{}", f64::from(other) / 10.0),
            }
        }
        if let Some(feed) = values.get(&'F') {
            self.feed = *feed;
        }
        for (axis, letter) in "ABCUVW".chars().enumerate() {
            if let Some(value) = values.get(&letter) {
                self.axes[axis] = *value;
            }
        }
        let given = ['X', 'Y', 'Z'].map(|letter| values.get(&letter).copied());
        let centre = ['I', 'J', 'K'].map(|letter| values.get(&letter).copied());
        if local {
            for (preset, value) in self.preset.iter_mut().zip(given) {
                *preset = value.unwrap_or(*preset);
            }
        } else if preset {
            for ((preset, at), value) in self.preset.iter_mut().zip(self.at).zip(given) {
                *preset = value.map_or(*preset, |value| at - value);
            }
        } else if machine_coordinates {
            let end = std::array::from_fn(|axis| given[axis].unwrap_or(self.at[axis]));
            self.line(end);
        } else if given.iter().chain(&centre).any(Option::is_some) {
            let end = std::array::from_fn(|axis| given[axis].unwrap_or(present[axis]));
            match self.motion {
                0 | 1 => self.line(self.map().point(end)),
                _ => self.arc(present, end, centre, values.get(&'R').copied()),
            }
        }
    }

    fn line(&mut self, end: Point) {
        let start = self.at;
        self.at = end;
        let point = |part: usize| {
            let t = part as f64 / PARTS as f64;
            std::array::from_fn(|axis| start[axis] + t * (end[axis] - start[axis]))
        };
        self.add((0..=PARTS).map(point).collect());
    }

    fn arc(&mut self, start: Point, end: Point, centre: [Option<f64>; 3], radius: Option<f64>) {
        let clockwise = self.motion == 2;
        let [first, second] = [(self.plane + 1) % 3, (self.plane + 2) % 3];
        let chord = [end[first] - start[first], end[second] - start[second]];
        let offset = match radius {
            None => [centre[first].unwrap_or(0.0), centre[second].unwrap_or(0.0)],
            Some(radius) => {
                let half = chord[0].hypot(chord[1]) / 2.0;
                let height = (radius * radius - half * half).max(0.0).sqrt();
                let side = if clockwise == (radius < 0.0) {
                    height
                } else {
                    -height
                };
                [
                    chord[0] / 2.0 - side * chord[1] / (2.0 * half),
                    chord[1] / 2.0 + side * chord[0] / (2.0 * half),
                ]
            }
        };
        let begin = (-offset[1]).atan2(-offset[0]);
        let finish = (chord[1] - offset[1]).atan2(chord[0] - offset[0]);
        let mut sweep = (finish - begin).rem_euclid(TAU);
        if clockwise {
            sweep -= TAU;
        }
        // A circle that closes is a whole one.
        if sweep.abs() < 1e-7 || (sweep.abs() - TAU).abs() < 1e-7 {
            sweep = if clockwise { -TAU } else { TAU };
        }
        let size = offset[0].hypot(offset[1]);
        let map = self.map();
        let point = |part: usize| {
            let t = part as f64 / PARTS as f64;
            let angle = begin + t * sweep;
            let mut point = start;
            point[first] += offset[0] + size * angle.cos();
            point[second] += offset[1] + size * angle.sin();
            point[self.plane] += t * (end[self.plane] - start[self.plane]);
            map.point(point)
        };
        let points = (0..=PARTS).map(point).collect();
        self.at = map.point(end);
        self.add(points);
    }

    /// Moves that go nowhere are left out.
    fn add(&mut self, points: Vec<Point>) {
        let length = |map: &dyn Fn(Point) -> Point| -> f64 {
            points
                .windows(2)
                .map(|pair| distance(map(pair[0]), map(pair[1])))
                .sum()
        };
        let on_machine = length(&|point| point);
        if on_machine < 1e-9 {
            return;
        }
        // The kinematics stretches the feed as it stretches the path.
        let in_frame = length(&|point| self.map().back(point));
        self.steps.push(Step {
            rapid: self.motion == 0,
            feed: match self.motion {
                0 => 0.0,
                _ => self.feed * on_machine / in_frame,
            },
            points,
        });
    }
}

pub fn distance(a: Point, b: Point) -> f64 {
    (0..3)
        .map(|axis| (a[axis] - b[axis]).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// The words of a line; values in brackets may name the present position.
fn parse(code: &str, present: Point, axes: [f64; 6]) -> Vec<(char, f64)> {
    let mut words = Vec::new();
    let mut rest = code.trim();
    while let Some(letter) = rest.chars().next() {
        rest = rest[1..].trim_start();
        let value = if let Some(inner) = rest.strip_prefix('[') {
            let (inner, after) = inner.split_once(']').expect("a closing bracket");
            rest = after;
            sum(inner, present, axes)
        } else {
            let end = rest
                .find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)))
                .unwrap_or(rest.len());
            let (number, after) = rest.split_at(end);
            rest = after;
            number
                .parse()
                .unwrap_or_else(|_| panic!("a number in {code}"))
        };
        rest = rest.trim_start();
        words.push((letter, value));
    }
    words
}

/// `#5420+5`, `7-#5421`.
fn sum(text: &str, present: Point, axes: [f64; 6]) -> f64 {
    let mut total = 0.0;
    let mut term = String::new();
    for c in text.chars().chain(['+']) {
        if !"+-".contains(c) || term.is_empty() {
            term.push(c);
            continue;
        }
        let (sign, name) = match term.strip_prefix('-') {
            Some(name) => (-1.0, name),
            None => (1.0, term.trim_start_matches('+')),
        };
        total += sign
            * match name
                .strip_prefix('#')
                .map(|name| name.parse::<usize>().unwrap())
            {
                Some(number @ 5420..=5422) => present[number - 5420],
                Some(number @ 5423..=5428) => axes[number - 5423],
                // No tool has a length here.
                Some(5401..=5409) => 0.0,
                Some(number) => panic!("the simulator has no #{number}"),
                None => name.parse().unwrap(),
            };
        term = c.to_string();
    }
    total
}
