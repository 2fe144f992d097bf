//! CYCLE72: a contour, which is a subprogram of its own, milled in layers with an approach and a retraction.
//! (Siemens, SINUMERIK 840D, Programming Guide Cycles, "Contour milling".)
//!
//! The contour is run once and its moves are kept; each layer runs them again. On its sides LinuxCNC
//! compensates the cutter, with the allowance as a part of its diameter.

use super::approach::{Shape, Smooth};
use super::cycle_parameters::Cycle;
use super::flow::target_of;
use super::interpreter::Interpreter;
use super::milling::Milling;
use super::pockets::allowance;
use super::syntax::{Block, Call};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::dialects::run::Next;
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::{Action, Compensation};
use crate::source::Span;

/// How long the straight way is on which LinuxCNC begins and ends to compensate, over the radius: it asks
/// for more than 1.
const ENTRY: f64 = 1.1;

/// A contour in the plane, machine units.
struct Contour {
    /// Where it begins.
    start: [f64; 2],
    /// Its lines, arcs and feeds.
    actions: Vec<Action>,
    /// Directions at its beginning and its end, length 1.
    tangents: [[f64; 2]; 2],
    /// Where it ends.
    end: [f64; 2],
}

/// How the tool comes to the contour and leaves it, machine units.
struct Ways {
    /// Where the tool goes down, where the approach begins, where the retraction ends, where compensation
    /// has ended.
    places: [[f64; 2]; 4],
    approach: MoveKind,
    retraction: MoveKind,
}

impl Interpreter<'_> {
    pub(super) fn mill_contour(&mut self, call: &Call, block: &Block) -> Done {
        self.control
            .refuse_compensation(call.span, "a milling cycle")?;
        let Some(cycle) = self.cycle(call)? else {
            return Ok(());
        };
        let compensation = side(&cycle)?;
        let Some(radius) = self.cutter_radius(&cycle)? else {
            return Ok(());
        };
        let rough = work(&cycle)?;
        let wall = if rough {
            allowance(&cycle, "_FAL")?
        } else {
            0.0
        };
        let floor = if rough {
            allowance(&cycle, "_FALD")?
        } else {
            0.0
        };
        let bottom = cycle.needed("_DP", "the depth")?;
        let milling = Milling {
            cycle: &cycle,
            middle: [0.0; 2],
            turned: 0.0,
            clockwise: false,
            radius,
            levels: self.levels(&cycle, "_", bottom)?,
            feeds: self.feeds(&cycle, "_FFP1", "_FFD")?,
        };
        if bottom + floor >= milling.levels.reference {
            return Err(cycle.unsupported(
                "_FALD",
                "the allowance at the floor is not less than the depth",
            ));
        }
        let before = (self.control.modal.feed, self.control.modal.motion);
        let contour = self.contour(&cycle, call, block)?;
        self.control.modal.motion = before.1;
        self.restore_feed(before.0);
        let factor = self.control.modal.length_factor;
        let inset = match compensation {
            Compensation::Off => 0.0,
            _ => (radius + wall) * factor,
        };
        let ways = ways(&cycle, &contour, compensation, inset, factor)?;
        let floors = milling.levels.floors(bottom + floor);
        let last = floors.len() - 1;
        for (at, floor) in floors.into_iter().enumerate() {
            if !self.control.count_block(call.span) {
                return Ok(());
            }
            let begin = ways.places[0].map(|place| place / factor);
            match at {
                0 => self.approach(&milling, begin)?,
                _ => self.travel(&milling, begin)?,
            }
            self.infeed(&milling, floor, false)?;
            if compensation != Compensation::Off && wall > 0.0 {
                let diameter = Some(2.0 * inset);
                self.control.actions.push(Action::CutterDiameter(diameter));
            }
            self.mill_layer(&contour, &ways, compensation, call.span)?;
            if compensation != Compensation::Off && wall > 0.0 {
                self.control.actions.push(Action::CutterDiameter(None));
            }
            if at < last {
                self.lift(&milling)?;
            }
        }
        self.plunge(milling.levels.retraction, true, call.span)?;
        self.control.modal.motion = before.1;
        self.restore_feed(before.0);
        Ok(())
    }

    /// Once along the contour, with the ways to it and from it.
    fn mill_layer(
        &mut self,
        contour: &Contour,
        ways: &Ways,
        compensation: Compensation,
        span: Span,
    ) -> Done {
        let [_, first, second, last] = ways.places;
        let compensates = compensation != Compensation::Off;
        if compensates {
            self.control
                .refuse_compensation_plane(span, "CYCLE72 with the radius of the cutter")?;
            self.switch_compensation(compensation);
        }
        self.element(MoveKind::Line, first, span)?;
        self.element(ways.approach.clone(), contour.start, span)?;
        let axes = self.control.modal.plane.axes();
        for action in &contour.actions {
            let Action::Move(path) = action else {
                self.control.actions.push(action.clone());
                continue;
            };
            let mut path = path.clone();
            let position = self.control.modal.position.coordinates();
            for axis in (0..9).filter(|axis| !axes[..2].contains(axis)) {
                path.start[axis] = position[axis];
            }
            self.control.add_move(path, span)?;
        }
        self.element(ways.retraction.clone(), second, span)?;
        if compensates {
            self.switch_compensation(Compensation::Off);
        }
        self.element(MoveKind::Line, last, span)
    }

    fn switch_compensation(&mut self, compensation: Compensation) {
        self.control.modal.compensation = compensation;
        self.control
            .actions
            .push(Action::Compensation(compensation));
    }

    /// A move to a place of the plane, machine units.
    fn element(&mut self, kind: MoveKind, place: [f64; 2], span: Span) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let mut target = [Coordinate::Keep; 9];
        target[first] = Coordinate::At(place[0]);
        target[second] = Coordinate::At(place[1]);
        let start = self.control.modal.position.coordinates();
        if start[first] == Some(place[0]) && start[second] == Some(place[1]) {
            return Ok(());
        }
        let path = Move {
            kind,
            target,
            start,
            exact_stop: false,
            corner: None,
        };
        self.control.add_move(path, span)
    }

    /// To the next layer: the tens of `_VARI` say whether in rapid motion or with the feed `_FF3`.
    fn travel(&mut self, milling: &Milling, place: [f64; 2]) -> Done {
        let cycle = milling.cycle;
        let [first, second, _] = self.control.modal.plane.axes();
        if cycle.digit("_VARI", 1)? == 0 {
            return self.rapid_to(&[first, second], &place, cycle.span);
        }
        if let Some(value) = cycle.nonzero("_FF3")? {
            let span = cycle.span_of("_FF3");
            self.mill_feed(Some(At { value, span }))?;
        }
        self.mill_to(milling, place)
    }

    /// Between layers: the hundreds of `_VARI` say how far up.
    fn lift(&mut self, milling: &Milling) -> Done {
        let cycle = milling.cycle;
        let [_, _, normal] = self.control.modal.plane.axes();
        let levels = milling.levels;
        let here = self.control.present(normal).unwrap_or(levels.safe);
        let height = match cycle.digit("_VARI", 2)? {
            0 => levels.retraction,
            1 => levels.safe,
            2 => here + (levels.safe - levels.reference),
            _ => here,
        };
        self.plunge(height, true, cycle.span)
    }

    /// Runs the contour and keeps what it does.
    fn contour(
        &mut self,
        cycle: &Cycle,
        call: &Call,
        block: &Block,
    ) -> Result<Contour, Diagnostic> {
        let Some(name) = cycle.text("_KNAME") else {
            return Err(cycle.missing("_KNAME, the name of the subprogram with the contour"));
        };
        let span = cycle.span_of("_KNAME");
        let places = name.split_once(':');
        if name.contains('/') || places.is_some_and(|(_, last)| last.contains(':')) {
            return Err(cycle.unsupported(
                "_KNAME",
                "put the contour into a subprogram of its own and write its name, or between two labels of this program",
            ));
        }
        let position = self.control.modal.position.clone();
        self.control.begin_recording();
        let ran = match places {
            Some(places) => self.run_section(places, span),
            None => {
                let name = name.to_ascii_uppercase();
                let contour = Call {
                    name: name.trim_end_matches(".SPF").to_string(),
                    span,
                    arguments: Vec::new(),
                    passes: None,
                };
                self.try_call(&contour, block)
            }
        };
        let recorded = self.control.end_recording();
        let tangent = self.control.modal.tangent;
        self.control.modal.position = position;
        if !ran? {
            return Err(not_a_contour(call.span));
        }
        self.read_contour(recorded, tangent)
            .ok_or_else(|| not_a_contour(span))
    }

    /// Runs the blocks of this program from one label or block number to another, as `"BEGIN:END"` names them; whether
    /// the program goes on.
    fn run_section(&mut self, (first, last): (&str, &str), span: Span) -> Result<bool, Diagnostic> {
        let Some(routine) = self.routine.clone() else {
            return Ok(false);
        };
        if self.repeats.contains(&span) {
            return Err(
                Diagnostic::error(span, "this cycle is among the blocks of its contour")
                    .help("let the contour end before it"),
            );
        }
        let [begin, end] =
            [first, last].map(|name| self.targets(&target_of(name), &routine).first().copied());
        let (Some(begin), Some(end)) = (begin, end.filter(|end| Some(*end) >= begin)) else {
            return Err(Diagnostic::error(
                span,
                format!("there is no contour from {first} to {last} in this program"),
            )
            .help("both are labels, written NAME: at the beginning of a block, or block numbers, one behind the other"));
        };
        self.repeats.push(span);
        let next = self.run_range(&routine, begin..end + 1);
        self.repeats.pop();
        match next {
            Next::Block(_) => Ok(true),
            Next::Abort => Ok(false),
            _ => Err(not_a_contour(span)),
        }
    }

    /// `None` for what is not a contour.
    fn read_contour(&self, recorded: Vec<Action>, tangent: Option<[f64; 3]>) -> Option<Contour> {
        let [first, second, normal] = self.control.modal.plane.axes();
        let mut actions = recorded
            .into_iter()
            .filter(|action| !matches!(action, Action::Enter { .. } | Action::Leave { .. }));
        let start = actions.find_map(|action| match action {
            Action::Move(path) => Some(path),
            _ => None,
        })?;
        let straight = matches!(start.kind, MoveKind::Rapid | MoveKind::Line);
        let start = [start.end(first)?, start.end(second)?];
        let actions: Vec<Action> = actions.collect();
        let mut moves = actions.iter().filter_map(|action| match action {
            Action::Move(path) => Some(path),
            _ => None,
        });
        let flat = |path: &Move| {
            let others = (0..9).filter(|axis| ![first, second].contains(axis));
            let mut others = others.map(|axis| path.target[axis]);
            others.all(|target| target == Coordinate::Keep)
                && path.target[normal] == Coordinate::Keep
        };
        let known = actions.iter().all(|action| match action {
            Action::Move(path) => {
                flat(path) && matches!(path.kind, MoveKind::Line | MoveKind::Arc(_))
            }
            Action::Feed(_) => true,
            _ => false,
        });
        let begins = moves.next().and_then(|path| self.start_direction(path))?;
        let last = actions.iter().rev().find_map(|action| match action {
            Action::Move(path) => Some([path.end(first)?, path.end(second)?]),
            _ => None,
        })?;
        let ends = super::approach::unit([tangent?[first], tangent?[second]]);
        (known && straight).then_some(Contour {
            start,
            actions,
            tangents: [begins, ends],
            end: last,
        })
    }
}

fn ways(
    cycle: &Cycle,
    contour: &Contour,
    compensation: Compensation,
    inset: f64,
    factor: f64,
) -> Result<Ways, Diagnostic> {
    let way = |mode: &str, length: &str, sense: f64| -> Result<_, Diagnostic> {
        let shape = match (cycle.digit(mode, 0)?, cycle.digit(mode, 1)?) {
            (1, 0) => Shape::Line,
            (2, 0) => Shape::Quarter,
            (3, 0) => Shape::Half,
            _ => {
                return Err(cycle.unsupported(
                    mode,
                    "1 is a straight line, 2 a quarter and 3 a half of a circle, in the plane",
                ));
            }
        };
        if shape != Shape::Line && compensation == Compensation::Off {
            return Err(cycle.unsupported(
                mode,
                "without compensation (_RL = 40) it is not said on which side the arc lies: write 1",
            ));
        }
        let reach = allowance(cycle, length)? * factor + inset;
        if reach <= 0.0 || shape != Shape::Line && reach <= inset {
            return Err(cycle.unsupported(length, "the length or radius must be above 0"));
        }
        let at_end = sense > 0.0;
        let [place, tangent] = match at_end {
            true => [contour.end, contour.tangents[1]],
            false => [contour.start, contour.tangents[0]],
        };
        let smooth = Smooth::of(shape, reach, compensation == Compensation::Left);
        let (far, centre) = smooth.far_end(place, tangent, sense);
        let outward = smooth.outward(tangent, sense);
        let entry = [0, 1].map(|axis| far[axis] + outward[axis] * ENTRY * inset);
        let from = if at_end { place } else { far };
        Ok((entry, far, smooth.element(centre, from)))
    };
    let (begin, approach_from, approach) = way("_AS1", "_LP1", -1.0)?;
    let (end, retraction_to, retraction) = way("_AS2", "_LP2", 1.0)?;
    Ok(Ways {
        places: [begin, approach_from, retraction_to, end],
        approach,
        retraction,
    })
}

fn side(cycle: &Cycle) -> Result<Compensation, Diagnostic> {
    match cycle.or_zero("_RL")? {
        40.0 => Ok(Compensation::Off),
        41.0 => Ok(Compensation::Left),
        42.0 => Ok(Compensation::Right),
        _ => Err(cycle.unsupported(
            "_RL",
            "40 is on the contour, 41 on its left, 42 on its right",
        )),
    }
}

/// Whether allowances are left.
fn work(cycle: &Cycle) -> Result<bool, Diagnostic> {
    cycle.check_digits("_VARI", &[0, 1, 2], 3)?;
    match (cycle.digit("_VARI", 0)?, cycle.digit("_VARI", 1)?) {
        (1, 0 | 1) => Ok(true),
        (2, 0 | 1) => Ok(false),
        _ => Err(cycle.unsupported(
            "_VARI",
            "its last digit is 1 for roughing or 2 for finishing, the one before 0 or 1",
        )),
    }
}

fn not_a_contour(span: Span) -> Diagnostic {
    Diagnostic::error(span, "this subprogram is not a contour").help(
            "it begins with G0 or G1 to its first point, with both axes of the plane, and consists of lines, \
             arcs and feeds in the plane",
        )
}
