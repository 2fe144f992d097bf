//! What the words of a block do, in the order in which the control does it: modes, feed and speed, tool,
//! spindle, coolant, offsets, motion, stop.

use super::block_words::{BlockWords, CORNER, g_name};
use super::g_functions::OneShot;
use super::interpreter::{Interpreter, Outcome};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::beside_motion::Waiting;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::moves::Corner;
use crate::program::{Action, Compensation, FeedMode, OrientWay};
use crate::source::Span;

impl Interpreter<'_> {
    /// Runs the words of a block and appends what they do to the actions of the block.
    pub(super) fn run_words(
        &mut self,
        mut words: BlockWords,
        block: Span,
    ) -> Result<Outcome, Diagnostic> {
        if let Some(error) = self.lathe_words(&words) {
            self.control.fail(error);
            return Ok(Outcome::Stops);
        }
        let compensated = self.control.modal.compensation != Compensation::Off;
        let once = self.g_functions(&mut words)?;
        if let Some(feed) = words.feed {
            self.feed(feed)?;
        }
        self.spindle_speed(&mut words, &once)?;
        if let Some(tool) = words.tool {
            let (number, _) = tool.value;
            self.control.tool(number, tool.span)?;
            self.tool = Some(number);
        }
        // M functions of a canned cycle act while the tool goes to the first place. (Fanuc, Series 15i, Operator's
        // Manual, "Canned cycle": "Miscellaneous function".)
        let waiting = match self.cycle.is_some() || once.cycle.is_some() {
            true => Waiting::Nothing,
            false => Waiting::SwitchesOff,
        };
        let has_offset = once.length.is_some() || words.h.is_some() || words.d.is_some();
        self.control.begin_functions(&words.m, waiting, has_offset);
        let end = self.m_functions(&words)?;
        self.control.hold_functions();
        self.tool_offsets(&mut words, once.length, once.compensation)?;
        self.control.apply_states(compensated);
        let called = match end {
            Some(At { value: 97, span }) => Some(self.m97(&mut words, span)?),
            Some(At { value: 98, span }) => Some(self.m98(&mut words, span)?),
            Some(At { value: 99, span }) => Some(self.m99(&mut words, span)?),
            _ => None,
        };
        self.place(&mut words, &once, block)?;
        words.refuse_rest()?;
        self.control.end_functions()?;
        self.control.stops(&words.m)?;
        if let Some(At {
            value: end @ (2 | 30),
            ..
        }) = end
        {
            self.control.end_of_program(end == 30);
            return Ok(Outcome::End);
        }
        Ok(called.unwrap_or(Outcome::GoesOn))
    }

    fn feed(&mut self, feed: At<f64>) -> Done {
        // F0 of a rapid block says nothing.
        match feed.value == 0.0 && self.control.modal.motion == Some(Motion::Rapid) {
            true => Ok(()),
            false => self.control.feed(feed),
        }
    }

    /// The M functions except the stops; the one that leaves the program, if there is one.
    fn m_functions(&mut self, words: &BlockWords) -> Result<Option<At<u32>>, Diagnostic> {
        let mut others = Vec::new();
        for m in &words.m {
            match m.value {
                19 => {
                    self.control
                        .actions
                        .push(Action::Orient(0.0, OrientWay::Shorter));
                    self.control.note_once(
                        "M19",
                        "M19 stops the spindle at 0 degrees, where the control has an angle of its own",
                        m.span,
                    );
                }
                29 => self.rigid = true,
                48 | 49 => self.control.overrides(m.value == 48, m.span)?,
                198 if !self.control.settings.passed_m.contains(&198) => {
                    return Err(Diagnostic::error(m.span, "M198 is not supported").help(
                        "it calls a subprogram from outside of the memory: write M98 P and its number, and give its folder \
                         with --subprograms unless it lies beside the program",
                    ));
                }
                _ => others.push(*m),
            }
        }
        let passed = self.control.settings.passed_m.contains(&97);
        let leaves = |m: u32| matches!(m, 2 | 30 | 98 | 99) || m == 97 && !passed;
        let ends: Vec<At<u32>> = others.iter().copied().filter(|m| leaves(m.value)).collect();
        if let [first, second, ..] = ends[..] {
            return Err(Diagnostic::error(
                second.span,
                format!("M{} and M{} exclude each other", first.value, second.value),
            ));
        }
        others.retain(|m| !leaves(m.value));
        self.control.m_functions(&others, &[])?;
        Ok(ends.first().copied())
    }

    /// The coordinates of a block.
    fn place(&mut self, words: &mut BlockWords, once: &OneShot, block: Span) -> Done {
        if let Some(place) = once.place {
            return self.special_place(words, place, block);
        }
        if let Some(cycle) = once.cycle {
            return self.define_cycle(words, cycle, block);
        }
        if self.cycle.is_some() {
            return self.cycle_block(words, block);
        }
        let motion = self.place_words(words, block)?;
        if !motion.is_motion() {
            return match once.exact_stop {
                true => Err(Diagnostic::error(block, "G9 needs a motion in its block")
                    .help("write G9 G1 X10.")),
                false => Ok(()),
            };
        }
        self.check_settled_motion(&motion, block)?;
        self.check_skipped(&motion, block)?;
        self.check_arc(block)?;
        let corner = words.corner.take();
        self.control
            .motion(&motion, block, words.feed.is_some(), once.exact_stop)?;
        if let (
            Some(At {
                value: (round, length),
                span,
            }),
            Some(Action::Move(path)),
        ) = (corner, self.control.actions.last_mut())
        {
            if length <= 0.0 {
                return Err(
                    Diagnostic::error(span, "a rounding or a chamfer is above 0")
                        .help("write ,R5. or ,C5."),
                );
            }
            let length = length * self.control.modal.length_factor;
            path.corner = Some(match round {
                true => Corner::Round(length),
                false => Corner::ChamferFrom(length),
            });
        }
        Ok(())
    }

    fn special_place(&mut self, words: &mut BlockWords, g: At<u32>, block: Span) -> Done {
        let At { value: code, span } = g;
        let is_plane = matches!(code, 510 | 511 | 501 | 680 | 682);
        if is_plane {
            return self.transform(words, g);
        }
        match code {
            40 => return self.dwell(words, span),
            531 => return self.tool_normal(words, span),
            700 | 710 => return self.hole_circle(words, g, block),
            _ => {}
        }
        if self.cycle.is_some() {
            return Err(
                Diagnostic::error(span, format!("{} in a canned cycle", g_name(code)))
                    .help("end the cycle with G80 before"),
            );
        }
        match code {
            100 => self.set_offset(words, span),
            120 | 130 => self.circular_pocket(words, g, block),
            280 | 300 => self.home(words, g),
            530 => self.machine_coordinates(words, span),
            _ => self.shift(words, g, block),
        }
    }

    /// `G4 X1.5`, `G4 U1.5` in seconds, `G4 P1500` in thousandths.
    fn dwell(&mut self, words: &mut BlockWords, span: Span) -> Done {
        if self.control.modal.feed_mode == FeedMode::PerRevolution {
            return Err(
                Diagnostic::error(span, "G4 in G95 may count turns of the spindle")
                    .help("write G94 before it"),
            );
        }
        let given = [
            words.axes[0].take().map(|word| word.value),
            words.axes[6].take().map(|word| word.value),
            self.take_dwell(words)?,
        ];
        let mut given = given.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(seconds), None) => self.control.dwell(seconds, span),
            _ => Err(Diagnostic::error(span, "G4 needs one time")
                .help("write G4 X1.5, or G4 P1500, for 1.5 seconds")),
        }
    }

    /// P as a time in seconds; says once that it counts them where it has a point.
    pub(super) fn take_dwell(&mut self, words: &mut BlockWords) -> Result<Option<f64>, Diagnostic> {
        if let Some(span) = words.dwells_in_seconds() {
            let message = "P of a dwell with a decimal point counts seconds, as on the controls that take one";
            self.control.note_once("P", message, span);
        }
        words.take_dwell()
    }

    /// The words of a motion, taken out of the block.
    pub(super) fn motion_words(&self, words: &mut BlockWords) -> MotionWords {
        let modal = |word: Option<At<f64>>| {
            word.map(|At { value, span }| At {
                value: (value, Dimension::Modal),
                span,
            })
        };
        MotionWords {
            axes: std::mem::take(&mut words.axes).map(modal),
            centre: std::mem::take(&mut words.centre).map(modal),
            radius: words.radius.take(),
            turns: None,
        }
    }

    /// What the control makes of an arc under different factors is no ellipse, and not said for all.
    fn check_arc(&self, block: Span) -> Done {
        let arc = matches!(
            self.control.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        );
        if arc && self.transforms.distorts(self.control.modal.plane) {
            return Err(Diagnostic::error(
                block,
                "an arc while the axes of its plane have different factors (G51)",
            )
            .help("scale both alike, or post the arc as lines"));
        }
        Ok(())
    }

    pub(super) fn check_settled_motion(&mut self, motion: &MotionWords, span: Span) -> Done {
        let words = BlockWords {
            axes: motion.axes.map(|word| {
                word.map(|word| At {
                    value: word.value.0,
                    span: word.span,
                })
            }),
            ..BlockWords::default()
        };
        self.check_settled(&words, span)
    }

    /// Says once that numbers without a point are whole units.
    pub(super) fn explain_point(&mut self, address: char, span: Span) {
        if self.point_explained {
            return;
        }
        self.point_explained = true;
        let name = match address {
            CORNER => ",R or ,C".to_string(),
            letter => letter.to_string(),
        };
        self.control.diagnostics.push(
            Diagnostic::warning(
                span,
                format!("{name} without a decimal point is taken as whole units: X100 is X100.0"),
            )
            .help("--decimal-point increments takes X100 as .1 mm, as some controls are set"),
        );
    }
}
