//! Canned cycles: drilling (G81, G82), deep hole drilling (G69, G83), tapping (G84), reaming (G85), boring
//! (G86, G89) and pockets (G87, G88).
//!
//! A cycle that is defined runs at its own place and then at every place that the blocks after it move
//! to, until G80, another cycle or another plane. Z is the reference plane and I the bottom; with G91 Z
//! counts from the starting plane and I from the reference plane. A spindle that stands is switched on
//! clockwise before the tool goes in. (Fagor, CNC 8055 Programming Manual,
//! "Canned cycles".)

use super::block_words::BlockWords;
use super::deep_holes::Steps;
use super::evaluate_words::seconds;
use super::g_functions::OneShot;
use super::interpreter::{Interpreter, times};
use super::pockets::Pocket;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::At;
use crate::program::moves::MoveKind;
use crate::program::{Action, FeedMode, Spindle};
use crate::source::Span;

/// How far before the last bottom a deep hole cycle ends its rapid motion, machine units.
const CLEARANCE: f64 = 1.0;

/// A cycle that is in force; coordinates along the normal of the plane, machine units.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    code: u32,
    /// Where the tool was when the cycle was defined; `None` where that is not known ahead of time.
    start: Option<f64>,
    /// The reference plane.
    reference: f64,
    /// The bottom; of G83, that of the first step.
    bottom: f64,
    /// G83: how many steps.
    steps: u32,
    /// G84 R1 and R2: the spindle is followed; without them the chuck gives way.
    rigid: bool,
    /// Seconds at the bottom.
    dwell: f64,
    /// Of G69, G87 and G88.
    form: Option<Form>,
    span: Span,
}

/// What cycles have with more parameters than the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// G87 and G88.
    Pocket(Pocket),
    /// G69.
    Steps(Steps),
}

impl Form {
    /// Takes the words of such a cycle out of its block; `None` where the block defines or changes
    /// another one.
    pub fn take(
        words: &mut BlockWords,
        old: Option<Form>,
        factors: [f64; 2],
    ) -> Result<Option<Form>, Diagnostic> {
        let codes = words.g.iter();
        let g = codes
            .copied()
            .find(|g| matches!(g.value, 69 | 79 | 87 | 88));
        let Some(g) = g else {
            return Ok(None);
        };
        Ok(match (g.value, old) {
            (69, _) => Some(Form::Steps(Steps::take(words, g, None, factors)?)),
            (87 | 88, _) => Some(Form::Pocket(Pocket::take(words, g, None, factors[0])?)),
            (_, Some(Form::Steps(old))) => {
                Some(Form::Steps(Steps::take(words, g, Some(old), factors)?))
            }
            (_, Some(Form::Pocket(old))) => {
                let pocket = Pocket::take(words, g, Some(old), factors[0])?;
                Some(Form::Pocket(pocket))
            }
            (_, None) => None,
        })
    }
}

impl Cycle {
    /// Its further parameters.
    pub fn form(&self) -> Option<Form> {
        self.form
    }

    /// Where it is defined.
    pub fn span(&self) -> Span {
        self.span
    }

    /// The reference plane and the bottom.
    pub fn depths(&self) -> (f64, f64) {
        (self.reference, self.bottom)
    }
}

impl Interpreter<'_> {
    /// A block with the G function of a cycle: the cycle is defined, and runs if a place is named.
    pub(super) fn define_cycle(
        &mut self,
        words: &BlockWords,
        g: At<u32>,
        form: Option<Form>,
        block: Span,
    ) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        let factor = self.control.modal.length_factor;
        if g.value == 79 {
            refuse_beside_change(words, normal)?;
        }
        let old = match (g.value, self.cycle.take()) {
            (79, None) => {
                return Err(Diagnostic::error(
                    g.span,
                    "G79 changes a canned cycle, and none is active",
                )
                .help("define it before: G81 X10 Y10 Z2 I-5 F100"));
            }
            (79, old) => old,
            _ => None,
        };
        let code = old.as_ref().map_or(g.value, |old| old.code);
        let start = match &old {
            Some(old) => old.start,
            None => self.control.modal.position.get(normal),
        };
        let incremental = self.control.modal.incremental;
        let reference = match (words.axes[normal], &old) {
            (Some(word), _) => {
                let value = word.value.unwrap_or(0.0) * factor;
                match incremental {
                    true => known_start(start, g.span)? + value,
                    false => value,
                }
            }
            (None, Some(old)) => old.reference,
            (None, None) => known_start(start, g.span)?,
        };
        let bottom = match (words.centre[0], &old) {
            // The steps of G83 are increments whatever G90 says.
            (Some(word), _) if incremental || code == 83 => reference + word.value * factor,
            (Some(word), _) => word.value * factor,
            (None, Some(old)) => old.bottom,
            (None, None) => {
                return Err(
                    Diagnostic::error(g.span, format!("G{code} needs the depth I"))
                        .help(format!("write G{code} X10 Y10 Z2 I-5 F100")),
                );
            }
        };
        let steps = match (code, words.centre[1], &old) {
            (83, Some(steps), _)
                if steps.value.fract() == 0.0 && (1.0..=9999.0).contains(&steps.value) =>
            {
                steps.value as u32
            }
            (83, None, Some(old)) => old.steps,
            (83, steps, _) => {
                return Err(Diagnostic::error(
                    steps.map_or(g.span, |steps| steps.span),
                    "G83 needs J, the number of its steps",
                )
                .help("write G83 X10 Y10 Z2 I-5 J4: four steps of 5"));
            }
            (_, Some(word), _) => {
                return Err(
                    Diagnostic::error(word.span, format!("J has no meaning with G{code}"))
                        .help("J is the number of steps of G83"),
                );
            }
            _ => 1,
        };
        // With an angle the radius belongs to the place.
        let radius = words.radius.filter(|_| words.angle.is_none());
        if let Some(other) = radius.filter(|_| code != 84).or(words.offset) {
            return Err(Diagnostic::error(
                other.span,
                format!("this parameter of G{code} is not supported"),
            )
            .help("Z, I, J, K and the place are supported"));
        }
        let direction = match start {
            None if bottom < reference => 0.0,
            // The tool would come from below.
            start => known_start(start, g.span)? - reference,
        };
        if (bottom - reference) * direction > 0.0 || bottom == reference {
            return Err(Diagnostic::error(
                g.span,
                "the bottom does not lie beyond the reference plane, seen from the starting plane",
            )
            .help("check Z (reference plane) and I (bottom)"));
        }
        let dwell = match (words.centre[2], &old) {
            (Some(dwell), _) if dwell.value >= 0.0 => seconds(dwell)?,
            (Some(dwell), _) => {
                return Err(Diagnostic::error(dwell.span, "a dwell cannot be negative"));
            }
            (None, old) => old.as_ref().map_or(0.0, |old| old.dwell),
        };
        self.cycle = Some(Cycle {
            code,
            start,
            reference,
            bottom,
            steps,
            rigid: match (radius, &old) {
                (Some(kind), _) => is_rigid(kind)?,
                (None, old) => old.as_ref().is_some_and(|old| old.rigid),
            },
            dwell,
            form,
            span: g.span,
        });
        self.control.modal_cycle(true);
        if g.value == 79 {
            return Ok(());
        }
        let mut place = words.clone();
        place.axes[normal] = None;
        place.centre = [None; 3];
        if place.angle.is_none() {
            // Only G84 has one, which has been read.
            place.radius = None;
        }
        self.run_at(&place, &OneShot::default(), block)
    }

    /// G80, or another plane.
    pub(super) fn end_cycle(&mut self) {
        self.cycle = None;
        self.control.modal_cycle(false);
    }

    /// A block while a cycle is in force.
    pub(super) fn cycle_block(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        if let Some(word) = words.axes[normal] {
            return Err(Diagnostic::error(
                word.span,
                "the axis of the tool moves while a canned cycle is in force",
            )
            .help("end the cycle with G80 before, or change it with G79"));
        }
        self.run_at(words, once, block)
    }

    fn run_at(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        let times = words.times.map_or(Ok(1), times)?;
        let mut place = words.clone();
        place.times = None;
        for _ in 0..times.max(1) {
            if !self.control.count_block(block) {
                return Ok(());
            }
            if place.names_a_place() {
                self.motion(&place, once, block)?;
            }
            // N0 moves to the place only.
            if times > 0 {
                self.run_cycle()?;
            }
        }
        Ok(())
    }

    pub(super) fn run_cycle(&mut self) -> Done {
        let Some(cycle) = self.cycle.clone() else {
            return Ok(());
        };
        let what = match cycle.form {
            Some(Form::Pocket(_)) => "a pocket",
            _ => "a canned cycle",
        };
        self.control.refuse_compensation(cycle.span, what)?;
        let spindle = self.control.turn_spindle();
        self.to(cycle.reference, &MoveKind::Rapid, &cycle)?;
        match (cycle.form, cycle.code) {
            (Some(Form::Pocket(pocket)), _) => self.mill_pocket(&cycle, pocket)?,
            (Some(Form::Steps(steps)), _) => self.drill_steps(&cycle, steps)?,
            (None, code) => self.bore(&cycle, code)?,
        }
        if cycle.code == 86 {
            self.control.actions.push(Action::Spindle(Spindle::Stop));
        }
        let back = match cycle.code {
            85 | 89 => MoveKind::Line,
            _ => MoveKind::Rapid,
        };
        self.to(cycle.reference, &back, &cycle)?;
        if self.to_start {
            let start = known_start(cycle.start, cycle.span)?;
            self.to(start, &MoveKind::Rapid, &cycle)?;
        }
        if cycle.code == 86 {
            self.control.actions.push(Action::Spindle(spindle));
        }
        Ok(())
    }

    /// From the reference plane to the bottom, and for G84 back.
    fn bore(&mut self, cycle: &Cycle, code: u32) -> Done {
        match code {
            83 => self.deep_hole(cycle),
            84 if cycle.rigid => self.rigid_tap(cycle),
            84 => self.floating_tap(cycle),
            _ => {
                self.to(cycle.bottom, &MoveKind::Line, cycle)?;
                self.wait(cycle);
                Ok(())
            }
        }
    }

    /// G84 R1 and R2: the pitch is the feed over the speed of the spindle.
    fn rigid_tap(&mut self, cycle: &Cycle) -> Done {
        let modal = &self.control.modal;
        let (feed, speed) = (modal.feed, modal.spindle_speed);
        let (Some(feed), Some(speed), FeedMode::PerMinute) =
            (feed, speed.filter(|speed| *speed > 0.0), modal.feed_mode)
        else {
            return Err(Diagnostic::error(
                cycle.span,
                "a rigid tap needs F in mm/min and S: they give its pitch",
            )
            .help("write S500 F500 for a pitch of 1"));
        };
        let factor = modal.length_factor;
        if cycle.dwell > 0.0 {
            self.control
                .note("the dwell (K) of a rigid tap", cycle.span);
        }
        let before = self.control.turn_spindle();
        let pitch = match before {
            Spindle::Counterclockwise => -feed / speed,
            _ => feed / speed,
        };
        let tap = Tap {
            bottom: cycle.bottom / factor,
            pitch: pitch / factor,
            back: 1.0,
        };
        self.control.tap(&tap, cycle.span)?;
        self.control.set_spindle(before);
        Ok(())
    }

    /// G84: the spindle turns back at the bottom, and the chuck gives way meanwhile.
    fn floating_tap(&mut self, cycle: &Cycle) -> Done {
        let before = self.control.turn_spindle();
        let back = match before {
            Spindle::Counterclockwise => Spindle::Clockwise,
            _ => Spindle::Counterclockwise,
        };
        self.control.begin_tap_without_overrides();
        self.to(cycle.bottom, &MoveKind::Line, cycle)?;
        self.wait(cycle);
        self.control.set_spindle(back);
        self.to(cycle.reference, &MoveKind::Line, cycle)?;
        self.control.end_tap_without_overrides();
        self.control.set_spindle(before);
        Ok(())
    }

    /// Steps of equal depth, out to the reference plane after each.
    fn deep_hole(&mut self, cycle: &Cycle) -> Done {
        let step = cycle.bottom - cycle.reference;
        let clearance = CLEARANCE.min(step.abs()) * step.signum();
        let mut depth = cycle.reference;
        for number in 1..=cycle.steps {
            if !self.control.count_block(cycle.span) {
                return Ok(());
            }
            if number > 1 {
                self.to(cycle.reference, &MoveKind::Rapid, cycle)?;
                self.to(depth - clearance, &MoveKind::Rapid, cycle)?;
            }
            depth = cycle.reference + step * f64::from(number);
            self.to(depth, &MoveKind::Line, cycle)?;
            self.wait(cycle);
        }
        Ok(())
    }

    /// Moves along the normal of the plane to a coordinate in machine units, unless it is there.
    pub(super) fn to(&mut self, place: f64, kind: &MoveKind, cycle: &Cycle) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        if self.control.modal.position.get(normal) == Some(place) {
            return Ok(());
        }
        let value = place / self.control.modal.length_factor;
        self.control
            .move_axis(normal, value, *kind == MoveKind::Rapid, cycle.span)
    }

    pub(super) fn wait(&mut self, cycle: &Cycle) {
        if cycle.dwell > 0.0 {
            self.control.actions.push(Action::Dwell(cycle.dwell));
        }
    }
}

/// The starting plane: G98 returns to it, and with G91 the reference plane counts from it.
fn known_start(start: Option<f64>, span: Span) -> Result<f64, Diagnostic> {
    start.ok_or_else(|| {
        Diagnostic::unknown_place(
            span,
            "a canned cycle, and where the tool is above the plane is not known ahead of time",
        )
        .help(
            "program the axis of the tool absolute before the cycle, behind the last change of tool or offset, or \
             write G99 with Z in G90",
        )
    })
}

/// Whether R of G84 has the spindle followed. In both ways that do, G33.1 waits for the index of the
/// spindle, which is the orientation that one of them asks for.
fn is_rigid(kind: At<f64>) -> Result<bool, Diagnostic> {
    match kind.value {
        0.0 => Ok(false),
        1.0 | 2.0 => Ok(true),
        _ => Err(
            Diagnostic::error(kind.span, "R of G84 is the kind of the tap: 0, 1 or 2").help(
                "write R1 or R2 for a rigid tap, R0 where the chuck gives way; F and S give the pitch",
            ),
        ),
    }
}

/// G79 changes the cycle and does not run it: no place stands beside it, and no number of repetitions.
fn refuse_beside_change(words: &BlockWords, normal: usize) -> Done {
    let mut rest = words.clone();
    rest.axes[normal] = None;
    let further = [
        rest.angle,
        rest.times,
        rest.further,
        rest.pitch,
        rest.finish_feed,
    ];
    let spans = further.iter().flatten().map(|word| word.span);
    match spans.chain(rest.first_axis()).min_by_key(|span| span.start) {
        Some(other) => Err(Diagnostic::error(
            other,
            "G79 changes a canned cycle, and has no use for this word",
        )
        .help("name the places in the blocks behind it: G79 Z3 I-6, then X50 Y60")),
        None => Ok(()),
    }
}
