//! The look along one move.
//!
//! The move is divided into spans with five places each, at equal distances, which are asked for one
//! after the other, each from the joints of the one before. What lies between them is told from the
//! second differences there: where those of a joint are at most D, and it runs like a cubic, it
//! passes its five places by less than 3/8 D: |q''| h^2 is at most 3 D at the ends of a span, and an
//! eighth of that is how far a joint can pass two neighbouring places. D is what is reckoned
//! with, so that 5/8 D is left for what a cubic leaves out. A span that might go beyond a
//! limit is looked at again in halves, which have a quarter of D, until D is below [`TOLERANCE`], or
//! what the answers of the kinematics differ by.
//!
//! How near to a cubic a joint is depends on how far the machine turns: from one place to the
//! next all rotary axes and the arc itself turn by [`TURN`] / 4 at most. Joints of robots turn
//! where the program does not; what a joint moves by in between is limited too.
//!
//! Where joints may not jump the spans are shorter, and it is looked for jumps, see [`super::jump`].

use super::joints::{JointRange, JointSolver, Joints, Jump, OutOfRange};
use super::jump;
use crate::axes::Axes;
use crate::machine::JOINT_COUNT;
use crate::moves::shape::Shape;

/// Places of a span, both ends included.
const PLACES: usize = 5;
/// Intervals of a span.
const INTERVALS: f64 = 4.0;

/// By how much the machine turns in a span at first, degrees, all rotary axes and the arc together.
const TURN: f64 = 90.0;
/// How long a span is at first, machine units.
const LENGTH: f64 = 200.0;

/// Joints that move by more than this from one place to the next, machine units or degrees, are
/// looked at more closely, wherever their limits are: kinematics that iterate might have found
/// another arm from so far away.
const GREATEST_WAY: f64 = 90.0;

/// What a joint may pass its limit by without notice, machine units or degrees.
const TOLERANCE: f64 = 1e-6;

/// Second differences that are as many times what an answer may be wrong by tell nothing.
const NOISE: f64 = 30.0;

/// The least part of a span: beyond it the joints jump, and there is nothing in between.
const LEAST_WIDTH: f64 = 1.0 / (1u32 << 16) as f64;

/// Calls beyond those for spans of full width, after which a move counts as unknown.
const FURTHER_CALLS: f64 = 4000.0;

/// What a look along a move came to.
#[derive(Clone, Copy, Debug)]
pub enum RangeVerdict {
    /// All joints stay within their ranges; they end here.
    Stays(Joints),
    /// A joint would leave its range.
    Leaves(OutOfRange),
    /// A joint would jump that may not.
    Jumps(Jump),
    /// There are no joints that lead to this place, shape (9), where joints may not jump.
    Unreached(Axes),
    /// The kinematics gave no joints for a place, or jump without end.
    Unknown,
}

/// The look along one move, as far as it has come.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// Spans of full width.
    spans: f64,
    /// Where the span begins that is looked at, and how wide it is, in spans of full width: both without rounding.
    begin: f64,
    width: f64,
    /// The joints at the first `filled` places of it.
    places: [Joints; PLACES],
    filled: usize,
    /// The range, and where the move starts: out of a forbidden place every way is a good one.
    allowed: JointRange,
    /// The joint that leaves its range, and the furthest that is known of it.
    found: Option<OutOfRange>,
    /// Each joint is near a limit that is less than this away, machine units or degrees.
    margins: Joints,
    /// Whether one comes near.
    near: bool,
    /// Places that may still be asked for.
    calls: f64,
    /// What an answer may be wrong by.
    precision: f64,
}

impl Sweep {
    /// Before the start of a move that the machine reaches with the joints `near`, or a little beside
    /// them.
    pub fn new(shape: &Shape, range: &JointRange, near: &Joints) -> Self {
        let mut spans = (turning(shape) / TURN).max(shape.length() / LENGTH);
        if range.may_not_jump {
            spans = spans.max(shape.length().max(rotary_way(shape)) / jump::SPAN);
        }
        let spans = spans.ceil().max(1.0);
        Self {
            spans,
            begin: 0.0,
            width: 1.0,
            places: [*near; PLACES],
            filled: 0,
            allowed: *range,
            found: None,
            margins: [0.0; JOINT_COUNT],
            near: false,
            calls: spans * INTERVALS + FURTHER_CALLS,
            precision: 0.0,
        }
    }

    /// Behind the place where a move starts, with the joints `start`.
    pub fn behind_start(shape: &Shape, range: &JointRange, start: &Joints) -> Self {
        let mut sweep = Self::new(shape, range, start);
        sweep.allow_start(start);
        sweep.filled = 1;
        sweep
    }

    /// The same that looks whether a joint comes nearer to a limit than its margin, machine units or degrees.
    #[must_use]
    pub fn with_margins(self, margins: Joints) -> Self {
        Self { margins, ..self }
    }

    /// Whether one does, as far as is known. What is between the places counts as much as half of its margin.
    pub fn comes_near(&self) -> bool {
        self.near
    }

    /// Asks for one more place; the verdict, if that was the last one.
    pub fn step(&mut self, shape: &Shape, solver: &mut impl JointSolver) -> Option<RangeVerdict> {
        self.calls -= 1.0;
        self.precision = solver.precision();
        let position = self.position(shape, self.filled);
        let near = self.filled.saturating_sub(1);
        let joints = match self.places.get(near) {
            Some(near) => solver.solve(&position, near),
            None => None,
        };
        let count = self.allowed.count;
        let joints =
            joints.filter(|joints| joints.iter().take(count).all(|joint| joint.is_finite()));
        let Some(joints) = joints else {
            if self.allowed.may_not_jump {
                return Some(RangeVerdict::Unreached(position));
            }
            // Kinematics that iterate may find from nearby what they do not from afar.
            return (self.filled == 0 || !self.halve()).then(|| self.ended());
        };
        if let Some(place) = self.places.get_mut(self.filled) {
            *place = joints;
        }
        if self.filled == 0 {
            self.allow_start(&joints);
        }
        self.filled += 1;
        if self.filled < PLACES {
            return None;
        }
        if self.allowed.may_not_jump && !solver.reaches(&position, &joints) {
            return Some(RangeVerdict::Unreached(position));
        }
        self.judge(shape)
    }

    /// Where a place of the span is, shape (9).
    fn position(&self, shape: &Shape, place: usize) -> Axes {
        let share = self.begin + self.width * (place as f64 / INTERVALS);
        shape.position(shape.length() * (share / self.spans))
    }

    /// A joint that starts beyond its limit may come back.
    fn allow_start(&mut self, start: &Joints) {
        let range = self
            .allowed
            .least
            .iter_mut()
            .zip(&mut self.allowed.greatest);
        for ((least, greatest), start) in range.zip(start) {
            *least = least.min(*start);
            *greatest = greatest.max(*start);
        }
    }

    /// All places of the span are known.
    fn judge(&mut self, shape: &Shape) -> Option<RangeVerdict> {
        let spent = self.calls <= 0.0;
        let bends = self.bends();
        let known = bends.iter().take(self.allowed.count);
        if self.allowed.may_not_jump && known.clone().any(|bend| jump::may_jump(bend.second)) {
            return self.close_in(shape);
        }
        if known.clone().any(|bend| bend.way > GREATEST_WAY) && !spent && self.halve() {
            return None;
        }
        for (joint, bend) in known.enumerate() {
            self.look_beyond(joint, bend);
            self.near |= self.is_near(joint, bend, 0.0);
        }
        let nears = bends.iter().enumerate().take(self.allowed.count);
        if !self.near
            && nears
                .into_iter()
                .any(|(joint, bend)| self.may_come_near(joint, bend))
        {
            if !spent && self.halve() {
                return None;
            }
            self.near = true;
        }
        let open = bends.iter().enumerate().take(self.allowed.count);
        if open
            .into_iter()
            .any(|(joint, bend)| self.may_pass(joint, bend))
        {
            if spent {
                return Some(self.ended());
            }
            if self.halve() {
                return None;
            }
        }
        self.go_on()
    }

    /// A joint might jump in the span: looks at the first half of it, if that is not too small. This comes to an end, however
    /// many places it takes.
    fn close_in(&mut self, shape: &Shape) -> Option<RangeVerdict> {
        if jump::are_beside(&self.position(shape, 0), &self.position(shape, 1)) {
            let place = |place| self.position(shape, place);
            let jump = jump::furthest(&self.places, self.allowed.count, place);
            return jump.map(RangeVerdict::Jumps);
        }
        self.width *= 0.5;
        self.filled = 1;
        None
    }

    /// How each joint runs through the span.
    fn bends(&self) -> [BentKinematics; JOINT_COUNT] {
        let mut bends = [BentKinematics::NONE; JOINT_COUNT];
        let [first, others @ ..] = &self.places;
        for (bend, joint) in bends.iter_mut().zip(first) {
            bend.begin(*joint);
        }
        for place in others {
            for (bend, joint) in bends.iter_mut().zip(place) {
                bend.add(*joint);
            }
        }
        bends
    }

    /// Keeps the furthest place beyond a limit, of the first joint that goes beyond one.
    fn look_beyond(&mut self, joint: usize, bend: &BentKinematics) {
        let (Some(least), Some(greatest)) = (
            self.allowed.least.get(joint),
            self.allowed.greatest.get(joint),
        ) else {
            return;
        };
        let above = (bend.greatest, *greatest, bend.greatest - greatest);
        let below = (bend.least, *least, least - bend.least);
        for (position, limit, excess) in [above, below] {
            let further = match self.found {
                None => excess > self.precision,
                Some(found) => {
                    found.joint == joint
                        && found.limit == limit
                        && excess > (found.position - limit).abs()
                }
            };
            if further {
                self.found = Some(OutOfRange {
                    joint,
                    position,
                    limit,
                });
            }
        }
    }

    /// Whether a joint may pass what is allowed between the places of the span; where one is beyond
    /// its limit, only how far it goes is of interest.
    fn may_pass(&self, joint: usize, bend: &BentKinematics) -> bool {
        let least = self.allowed.least.get(joint).copied();
        let greatest = self.allowed.greatest.get(joint).copied();
        let (Some(mut least), Some(mut greatest)) = (least, greatest) else {
            return false;
        };
        if let Some(found) = self.found {
            if found.joint != joint {
                return false;
            }
            least = least.min(found.position);
            greatest = greatest.max(found.position);
        }
        bend.second > TOLERANCE.max(NOISE * self.precision)
            && (bend.greatest + bend.second > greatest || bend.least - bend.second < least)
    }

    fn margin(&self, joint: usize) -> f64 {
        self.margins.get(joint).copied().unwrap_or(0.0)
    }

    /// Whether a joint is near a limit at one of the places of the span, or would be if it went so much further.
    fn is_near(&self, joint: usize, bend: &BentKinematics, further: f64) -> bool {
        let margin = self.margin(joint) + further;
        let least = self.allowed.least.get(joint);
        let greatest = self.allowed.greatest.get(joint);
        least.is_some_and(|least| bend.least < least + margin)
            || greatest.is_some_and(|greatest| bend.greatest > greatest - margin)
    }

    /// Whether one may be between the places, and that can be told by more of them.
    fn may_come_near(&self, joint: usize, bend: &BentKinematics) -> bool {
        let margin = self.margin(joint);
        let least = (0.5 * margin).max(TOLERANCE.max(NOISE * self.precision));
        margin > 0.0 && bend.second > least && self.is_near(joint, bend, bend.second)
    }

    /// Looks at the first half of the span. `false` if that would be too small.
    fn halve(&mut self) -> bool {
        let possible = self.width > LEAST_WIDTH;
        if possible {
            self.width *= 0.5;
            self.filled = 1;
        }
        possible
    }

    /// Behind the span. The next one is as wide as possible.
    fn go_on(&mut self) -> Option<RangeVerdict> {
        self.begin += self.width;
        if self.begin >= self.spans {
            return Some(self.ended());
        }
        while self.width < 1.0 && (self.begin / (2.0 * self.width)).fract() == 0.0 {
            self.width *= 2.0;
        }
        let [first, .., last] = &mut self.places;
        *first = *last;
        self.filled = 1;
        None
    }

    /// What is known at the end.
    fn ended(&self) -> RangeVerdict {
        let [.., last] = &self.places;
        match self.found {
            Some(found) => RangeVerdict::Leaves(found),
            None if self.begin >= self.spans => RangeVerdict::Stays(*last),
            None => RangeVerdict::Unknown,
        }
    }
}

/// By how much the machine turns on a move, degrees: all rotary axes and the arc itself.
fn turning(shape: &Shape) -> f64 {
    match shape {
        Shape::Line(_) => rotary_way(shape),
        Shape::Arc(arc) => rotary_way(shape) + arc.angle().to_degrees(),
    }
}

/// How far all rotary axes turn together, degrees.
fn rotary_way(shape: &Shape) -> f64 {
    let way = shape.end() - shape.position(0.0);
    way.iter().skip(3).take(3).map(|axis| axis.abs()).sum()
}

/// How a joint runs through a span.
#[derive(Clone, Copy, Debug)]
struct BentKinematics {
    least: f64,
    greatest: f64,
    /// Greatest second difference.
    second: f64,
    /// Greatest way from one place to the next.
    way: f64,
    /// The last place, and the way to it.
    last: f64,
    step: Option<f64>,
}

impl BentKinematics {
    const NONE: Self = Self {
        least: 0.0,
        greatest: 0.0,
        second: 0.0,
        way: 0.0,
        last: 0.0,
        step: None,
    };

    fn begin(&mut self, position: f64) {
        (self.least, self.greatest, self.last) = (position, position, position);
    }

    fn add(&mut self, position: f64) {
        let step = position - self.last;
        if let Some(before) = self.step {
            self.second = self.second.max((step - before).abs());
        }
        self.way = self.way.max(step.abs());
        self.least = self.least.min(position);
        self.greatest = self.greatest.max(position);
        (self.last, self.step) = (position, Some(step));
    }
}
