//! Smooth approach and retraction: G147 and G148 on a straight line, G247 and G248 on a quarter of a circle,
//! G347 and G348 on a half. (Siemens, SINUMERIK 840D sl, Programming Manual Fundamentals, "Smooth approach
//! and retraction".)
//!
//! DISR is the radius of the way of the tool's middle, or the distance of its edge from where the contour
//! begins: under cutter compensation the radius of the tool is added to what is programmed. The first
//! point of the contour stands in the block itself or in the next one; how the contour goes on there is
//! known with the motion behind it.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension};
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::program::{Action, Compensation};
use crate::source::Span;

/// On what the tool comes and goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A tangent.
    Line,
    /// A quarter of a circle.
    Quarter,
    /// Half a circle.
    Half,
}

/// The words of the block, with what holds there; lengths in machine units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smooth {
    shape: Shape,
    /// DISR, with the radius of the tool under compensation.
    reach: f64,
    /// DISCL: how far above the depth the slow infeed begins.
    above: f64,
    /// FAD, units of the program: with G341 the feed of the slow infeed, with G340 that of the whole way
    /// along the shape.
    slow: Option<At<f64>>,
    /// Whether the tool comes from the left of the contour.
    pub(super) left: bool,
    /// G341: down before the way in the plane, not along it.
    flat: bool,
    /// Whether the ways to and from it are rapid.
    rapid: bool,
    /// Along the normal, if the block names it.
    depth: Option<f64>,
    /// Where the contour begins, along both axes of the plane.
    target: Option<[f64; 2]>,
    /// Whether compensation begins with it.
    begins: bool,
    pub(super) span: Span,
}

/// The shape of a G number times ten, and whether it approaches.
pub fn shape_of(code: u32) -> Option<(Shape, bool)> {
    let shape = match code {
        1470 | 1480 => Shape::Line,
        2470 | 2480 => Shape::Quarter,
        3470 | 3480 => Shape::Half,
        _ => return None,
    };
    Some((shape, code % 100 == 70))
}

impl Interpreter<'_> {
    /// G140 to G142 and G340, G341, by their numbers times ten; others change nothing.
    pub(super) fn approach_mode(&mut self, code: u32) {
        match code {
            1400 => self.approach_side = None,
            1410 | 1420 => self.approach_side = Some(code == 1410),
            3400 | 3410 => self.approach_flat = code == 3410,
            _ => {}
        }
    }

    /// The block of an approach: it waits for the contour.
    pub(super) fn begin_approach(&mut self, words: &BlockWords) -> Done {
        words.check_of_approach()?;
        let mut smooth = self.smooth(words, true)?;
        smooth.target = self.place_in_plane(words, smooth.span)?;
        smooth.begins = self.begins_compensation();
        self.approach = Some(smooth);
        Ok(())
    }

    /// A motion behind the block of an approach: the place where the contour begins, or its first element,
    /// which is then carried out with the way to it. `false` where no approach waits.
    pub(super) fn approach_before(
        &mut self,
        words: &BlockWords,
        run: impl FnOnce(&mut Self) -> Done,
    ) -> Result<bool, Diagnostic> {
        let Some(mut smooth) = self.approach.take() else {
            run(self)?;
            return Ok(false);
        };
        let Some(target) = smooth.target else {
            words.check_beside(1470, &["RNDM"])?;
            smooth.target = self.place_in_plane(words, smooth.span)?;
            let straight = matches!(
                self.control.modal.motion,
                Some(Motion::Rapid | Motion::Line)
            );
            if smooth.target.is_none() || !straight {
                return Err(no_contour(smooth.span));
            }
            self.approach = Some(smooth);
            return Ok(true);
        };
        let before = self.control.modal.position.coordinates();
        let at = self.control.actions.len();
        let [first, second, normal] = self.control.modal.plane.axes();
        let position = &mut self.control.modal.position;
        position.set(first, Some(target[0]));
        position.set(second, Some(target[1]));
        if let Some(depth) = smooth.depth {
            position.set(normal, Some(depth));
        }
        run(self)?;
        let begun = self.control.actions[at..].iter();
        let contour = begun
            .filter_map(|action| match action {
                Action::Move(path) => Some(path),
                _ => None,
            })
            .next();
        let tangent = contour.and_then(|path| self.start_direction(path));
        let tangent = tangent.ok_or_else(|| no_contour(smooth.span))?;
        let way = self.way_onto(&smooth, target, tangent, before)?;
        self.control.actions.splice(at..at, way);
        Ok(true)
    }

    /// The actions that lead from `before` to where the contour begins.
    fn way_onto(
        &mut self,
        smooth: &Smooth,
        target: [f64; 2],
        tangent: [f64; 2],
        before: [Option<f64>; 9],
    ) -> Result<Vec<Action>, Diagnostic> {
        self.control
            .refuse_inverse_time(smooth.span, "a smooth approach")?;
        let axes = self.control.modal.plane.axes();
        let (from, centre) = smooth.far_end(target, tangent, -1.0);
        if smooth.begins {
            let [first, second, _] = axes;
            smooth.check_side([before[first], before[second]], from, tangent)?;
        }
        let exact_stop = self.control.stops_under_compensation();
        let mut at = before;
        let mut way = Vec::new();
        let mut go = |kind: MoveKind, ends: [Option<f64>; 3]| {
            let mut path = Move {
                kind,
                target: [Coordinate::Keep; 9],
                start: at,
                exact_stop,
                corner: None,
            };
            for (axis, end) in axes.into_iter().zip(ends) {
                if let Some(end) = end {
                    path.target[axis] = Coordinate::At(end);
                    at[axis] = Some(end);
                }
            }
            Action::Move(path)
        };
        let travel = match smooth.rapid {
            true => MoveKind::Rapid,
            false => MoveKind::Line,
        };
        way.push(go(travel.clone(), [Some(from[0]), Some(from[1]), None]));
        let mut last_depth = None;
        if let Some(depth) = smooth.depth {
            way.push(go(travel, [None, None, Some(depth + smooth.above)]));
            match smooth.flat || smooth.shape == Shape::Line && smooth.above == 0.0 {
                true if smooth.above != 0.0 => {
                    let down = go(MoveKind::Line, [None, None, Some(depth)]);
                    self.slowly(smooth, down, &mut way)?;
                }
                true => {}
                false => last_depth = Some(depth).filter(|_| smooth.above != 0.0),
            }
        }
        let kind = smooth.element(centre, from);
        let onto = go(kind, [Some(target[0]), Some(target[1]), last_depth]);
        match smooth.flat {
            true => way.push(onto),
            false => self.slowly(smooth, onto, &mut way)?,
        }
        Ok(way)
    }

    /// A move with FAD, if that is given.
    fn slowly(&mut self, smooth: &Smooth, path: Action, way: &mut Vec<Action>) -> Done {
        let modal = &self.control.modal;
        let (Some(slow), Some(feed)) = (smooth.slow, modal.feed) else {
            way.push(path);
            return Ok(());
        };
        if slow.value <= 0.0 {
            return Err(Diagnostic::error(slow.span, "the feed must be above 0"));
        }
        way.push(Action::Feed(slow.value * modal.feed_factor));
        way.push(path);
        way.push(Action::Feed(feed));
        Ok(())
    }

    /// The block of a retraction, before its G functions: off the contour on the side of the tool.
    pub(super) fn begin_retraction(&mut self, words: &BlockWords) -> Done {
        words.check_of_approach()?;
        for g in &words.g {
            self.approach_mode(g.value);
        }
        let smooth = self.smooth(words, false)?;
        let span = smooth.span;
        if let Some(slow) = smooth.slow.filter(|_| !smooth.flat) {
            return Err(Diagnostic::error(slow.span, "FAD in a retraction with G340")
                .help("the feed in force leads away from the contour there: leave FAD out, or write G341, where it is the feed of the way up"));
        }
        self.control
            .refuse_inverse_time(span, "a smooth retraction")?;
        let [first, second, normal] = self.control.modal.plane.axes();
        let position = &self.control.modal.position;
        let here = [first, second, normal].map(|axis| position.get(axis));
        let tangent = self.control.modal.tangent;
        let ([Some(x), Some(y), Some(height)], Some(tangent)) = (here, tangent) else {
            return Err(Diagnostic::error(
                span,
                "how the contour ends here is not known ahead of time",
            )
            .help("program its last element with both axes of the plane before"));
        };
        self.control.check_feed(false, span)?;
        let here = [x, y];
        let (end, centre) = smooth.far_end(here, unit([tangent[first], tangent[second]]), 1.0);
        let mut target = [Coordinate::Keep; 9];
        target[first] = Coordinate::At(end[0]);
        target[second] = Coordinate::At(end[1]);
        let rises = smooth.above != 0.0;
        if rises && !smooth.flat {
            target[normal] = Coordinate::At(height + smooth.above);
        }
        let path = Move {
            kind: smooth.element(centre, here),
            target,
            start: self.control.modal.position.coordinates(),
            exact_stop: false,
            corner: None,
        };
        self.control.add_move(path, span)?;
        if rises && smooth.flat {
            let factor = self.control.modal.length_factor;
            let before = self.control.modal.feed;
            if let Some(slow) = smooth.slow {
                self.control.feed(slow)?;
            }
            self.plunge((height + smooth.above) / factor, false, span)?;
            self.restore_feed(before);
        }
        Ok(())
    }

    /// Where the block of a retraction goes: along the normal first.
    pub(super) fn end_retraction(&mut self, words: &BlockWords, block: Span) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        let own_feed = words.feed.is_some();
        let mut up = words.motion;
        for axis in (0..9).filter(|axis| *axis != normal) {
            up.axes[axis] = None;
        }
        let mut across = words.motion;
        across.axes[normal] = None;
        for motion in [up, across] {
            if motion.names_an_axis() {
                self.control.motion(&motion, block, own_feed, false)?;
            }
        }
        Ok(())
    }

    /// An approach without a contour.
    pub(super) fn check_approach(&mut self, words: &BlockWords) -> Done {
        match self.approach.filter(|_| !words.m.is_empty()) {
            Some(smooth) if words.m.iter().any(|m| matches!(m.value, 2 | 17 | 30)) => {
                self.approach = None;
                Err(no_contour(smooth.span))
            }
            _ => Ok(()),
        }
    }

    fn smooth(&mut self, words: &BlockWords, approaches: bool) -> Result<Smooth, Diagnostic> {
        let given = words
            .g
            .iter()
            .find_map(|g| Some((shape_of(g.value)?.0, g.span)));
        let (shape, span) = given.unwrap_or((Shape::Line, Span::start_of(0)));
        let Some(distance) = words.approach_distance else {
            return Err(
                Diagnostic::error(span, "a smooth approach or retraction without DISR")
                    .help("write the radius of its arc, or the distance of its line: G247 DISR=10"),
            );
        };
        let straight = matches!(
            self.control.modal.motion,
            Some(Motion::Rapid | Motion::Line)
        );
        if words.motion.names_a_centre() || approaches && !straight {
            return Err(
                Diagnostic::error(span, "a smooth approach or retraction beside an arc")
                    .help("write G0 or G1 in its block"),
            );
        }
        let factor = self.control.modal.length_factor;
        let compensation = self.control.modal.compensation;
        let left = match (self.approach_side, compensation) {
            (Some(left), _) => left,
            (None, Compensation::Left) => true,
            (None, Compensation::Right) => false,
            (None, Compensation::Off) => {
                return Err(
                    Diagnostic::error(span, "from which side the tool comes is not said")
                        .help("write G41 or G42 in the block of the approach, or G141 or G142"),
                );
            }
        };
        let radius = match compensation {
            Compensation::Off => 0.0,
            _ => self.tool_radius("a smooth approach", span)?,
        };
        let reach = distance.value * factor + radius;
        if reach <= radius * f64::from(u8::from(shape != Shape::Line)) || reach <= 0.0 {
            return Err(Diagnostic::error(distance.span, "DISR must be above 0"));
        }
        let [_, _, normal] = self.control.modal.plane.axes();
        let depth = match words.motion.axes[normal].map(|word| word.value) {
            None => None,
            Some((value, dimension)) => {
                let step = dimension == Dimension::Incremental
                    || dimension == Dimension::Modal && self.control.modal.incremental;
                let base = match step {
                    true => self.control.modal.position.get(normal),
                    false => Some(0.0),
                };
                let base = base.ok_or_else(|| no_contour(span))?;
                Some(base + value * factor)
            }
        };
        let above = match words.approach_height.map(|word| word.value) {
            None => 0.0,
            Some((value, Dimension::Absolute)) => {
                let here = self.control.modal.position.get(normal);
                let depth = if approaches { depth.or(here) } else { here };
                value * factor - depth.ok_or_else(|| no_contour(span))?
            }
            Some((value, _)) => value * factor,
        };
        if above < 0.0 {
            return Err(
                Diagnostic::error(span, "DISCL lies below the depth of the contour")
                    .help("it is how far above the infeed becomes slow: at least 0"),
            );
        }
        Ok(Smooth {
            shape,
            reach,
            above,
            slow: words.approach_feed,
            left,
            flat: self.approach_flat,
            rapid: self.control.modal.motion == Some(Motion::Rapid)
                || words.approach_feed.is_some(),
            depth,
            target: None,
            begins: false,
            span,
        })
    }

    /// Both axes of the plane as a block names them, machine units; `None` where it names none.
    fn place_in_plane(
        &self,
        words: &BlockWords,
        span: Span,
    ) -> Result<Option<[f64; 2]>, Diagnostic> {
        let [first, second, _] = self.control.modal.plane.axes();
        let factor = self.control.modal.length_factor;
        let place = [first, second].map(|axis| {
            words.motion.axes[axis].map(|_| {
                let step = self.control.step_along(&words.motion, axis)?;
                let here = self.control.present(axis)?;
                Some((here + step) * factor)
            })
        });
        match place {
            [None, None] => Ok(None),
            [Some(Some(x)), Some(Some(y))] => Ok(Some([x, y])),
            _ => Err(Diagnostic::error(
                span,
                "where the contour of this approach begins is not said",
            )
            .help("write both axes of the plane, with the place of the tool known before")),
        }
    }
}

impl Smooth {
    /// A way in the plane.
    pub(super) fn of(shape: Shape, reach: f64, left: bool) -> Smooth {
        Smooth {
            shape,
            reach,
            above: 0.0,
            slow: None,
            left,
            flat: true,
            rapid: false,
            depth: None,
            target: None,
            begins: false,
            span: Span::start_of(0),
        }
    }

    /// The direction in which the way goes on at its other end, away from the contour; length 1.
    pub(super) fn outward(&self, [along, across]: [f64; 2], sense: f64) -> [f64; 2] {
        let side = if self.left { 1.0 } else { -1.0 };
        match self.shape {
            Shape::Line => [along * sense, across * sense],
            Shape::Quarter => [-across * side, along * side],
            Shape::Half => [-along * sense, -across * sense],
        }
    }

    /// The other end of the way from a place of the contour, and the centre of its arc. `sense`: -1 for the
    /// way there, 1 for that back.
    pub(super) fn far_end(
        &self,
        [x, y]: [f64; 2],
        [along, across]: [f64; 2],
        sense: f64,
    ) -> ([f64; 2], Option<[f64; 2]>) {
        let side = if self.left { 1.0 } else { -1.0 };
        let aside = [-across * side, along * side];
        let centre = [x + aside[0] * self.reach, y + aside[1] * self.reach];
        let step = [along * sense * self.reach, across * sense * self.reach];
        match self.shape {
            Shape::Line => ([x + step[0], y + step[1]], None),
            Shape::Quarter => ([centre[0] + step[0], centre[1] + step[1]], Some(centre)),
            Shape::Half => ([2.0 * centre[0] - x, 2.0 * centre[1] - y], Some(centre)),
        }
    }

    pub(super) fn element(&self, centre: Option<[f64; 2]>, from: [f64; 2]) -> MoveKind {
        match centre {
            None => MoveKind::Line,
            Some(centre) => MoveKind::Arc(Arc {
                clockwise: !self.left,
                centre: Centre::Offset([centre[0] - from[0], centre[1] - from[1]]),
                extra_turns: 0,
            }),
        }
    }
}

pub(super) fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(y);
    [x / length, y / length]
}

fn no_contour(span: Span) -> Diagnostic {
    Diagnostic::error(span, "no contour follows this approach").help(
        "behind it stand the place where the contour begins, if it is not in the block itself, and \
                   the first line or arc of the contour",
    )
}
