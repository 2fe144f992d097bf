//! What the words of a block do, in the order in which the control does it: modes, feed and speed,
//! tool, spindle, coolant, offsets, motion, stop.

use super::block_words::{At, BlockWords, ToolWord};
use super::frame_commands::frame_error;
use super::g_functions::order_of_state;
use super::interpreter::Interpreter;
use super::modal::Motion;
use super::motion::{carry_out, path_move};
use crate::diagnostics::Diagnostic;
use crate::program::frame::FrameCommand;
use crate::program::{Action, Compensation, Coolant, FeedMode, PathControl, Spindle};
use crate::source::Span;

/// How a block ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockEnd {
    /// The next block follows.
    Continue,
    /// The program or the subprogram ends here.
    Ends(Span),
}

/// What the G functions of a block ask for besides changing modes.
#[derive(Default)]
pub(super) struct OneShot {
    pub(super) dwell: Option<Span>,
    pub(super) exact_stop: bool,
    pub(super) machine_coordinates: Option<Span>,
    pub(super) preset: Option<Span>,
}

/// The outcome of carrying out a part of a block.
pub(super) type Done = Result<(), Box<Diagnostic>>;

impl Interpreter<'_> {
    /// Runs the words of a block and appends what they do to the actions of the block.
    pub(super) fn run_words(
        &mut self,
        words: &BlockWords,
        block: Span,
    ) -> Result<BlockEnd, Box<Diagnostic>> {
        for noted in &words.noted {
            self.note(&noted.value, noted.span);
        }
        let mut once = OneShot {
            machine_coordinates: words.supa,
            ..OneShot::default()
        };
        let mut states = Vec::new();
        let compensated = self.modal.compensation != Compensation::Off;
        self.g_functions(words, &mut once, &mut states)?;
        if let Some(span) = once.dwell {
            states.sort_by_key(|state| order_of_state(state, compensated));
            self.actions.append(&mut states);
            self.dwell(words, span)?;
            return Ok(BlockEnd::Continue);
        }
        self.feed_and_speed(words)?;
        self.tool(words)?;
        let end = self.m_functions(words)?;
        self.offset(words, &mut states)?;
        self.corner_tolerance(words, &mut states)?;
        states.sort_by_key(|state| order_of_state(state, compensated));
        self.actions.append(&mut states);
        self.motion(words, &once, block)?;
        self.stops(words);
        Ok(match end {
            Some(span) => BlockEnd::Ends(span),
            None => BlockEnd::Continue,
        })
    }

    /// LinuxCNC cannot change frames, offsets, planes or tools under cutter compensation.
    pub(super) fn refuse_compensation(&self, span: Span, what: &str) -> Done {
        if self.modal.compensation == Compensation::Off {
            return Ok(());
        }
        Err(Box::new(
            Diagnostic::error(span, format!("{what} while cutter compensation is on"))
                .help("end the compensation with G40 before"),
        ))
    }

    fn dwell(&mut self, words: &BlockWords, span: Span) -> Done {
        if words.names_an_axis()
            || !words.m.is_empty()
            || words.tool.is_some()
            || words.offset.is_some()
        {
            return Err(Box::new(
                Diagnostic::error(span, "G4 stands alone in its block")
                    .help("put axes, T, D and M functions in another block"),
            ));
        }
        let seconds = match (words.feed, words.speed) {
            (Some(seconds), None) => seconds.value,
            (None, Some(revolutions)) => match self.modal.spindle_speed {
                Some(speed) if speed > 0.0 => 60.0 * revolutions.value / speed,
                _ => {
                    return Err(Box::new(
                        Diagnostic::error(
                            revolutions.span,
                            "a dwell in revolutions of a spindle without speed",
                        )
                        .help("program S before, or dwell in seconds: G4 F2"),
                    ));
                }
            },
            _ => {
                return Err(Box::new(
                    Diagnostic::error(span, "G4 needs a time")
                        .help("G4 F2.5 waits 2.5 seconds, G4 S30 waits 30 revolutions"),
                ));
            }
        };
        if seconds < 0.0 {
            return Err(Box::new(Diagnostic::error(
                span,
                "a dwell cannot be negative",
            )));
        }
        self.actions.push(Action::Dwell(seconds));
        Ok(())
    }

    fn feed_and_speed(&mut self, words: &BlockWords) -> Done {
        if let Some(feed) = words.feed {
            if feed.value <= 0.0 {
                return Err(Box::new(Diagnostic::error(
                    feed.span,
                    "the feed must be above 0",
                )));
            }
            let factor = match self.modal.feed_mode {
                FeedMode::InverseTime => 1.0,
                FeedMode::PerMinute | FeedMode::PerRevolution => self.modal.feed_factor,
            };
            self.modal.has_feed = true;
            self.actions.push(Action::Feed(feed.value * factor));
        }
        if let Some(speed) = words.speed {
            if speed.value < 0.0 {
                return Err(Box::new(
                    Diagnostic::error(speed.span, "the spindle speed cannot be negative")
                        .help("M4 turns the other way"),
                ));
            }
            self.modal.spindle_speed = Some(speed.value);
            self.actions.push(Action::SpindleSpeed(speed.value));
        }
        Ok(())
    }

    fn tool(&mut self, words: &BlockWords) -> Done {
        let (Some(at), Some(tool)) = (words.tool, &words.tool_word) else {
            return Ok(());
        };
        let number = match tool {
            ToolWord::Number(number)
                if number.fract() == 0.0 && (0.0..=99999.0).contains(number) =>
            {
                *number as u32
            }
            ToolWord::Number(number) => {
                return Err(Box::new(Diagnostic::error(
                    at.span,
                    format!("{number} is not the number of a tool"),
                )));
            }
            ToolWord::Name(name) => *self.settings.tool_names.get(name).ok_or_else(|| {
                Box::new(
                    Diagnostic::error(at.span, format!("the tool \"{name}\" has no number"))
                        .help(format!("give it: --tool \"{name}=3\"")),
                )
            })?,
        };
        self.actions.push(Action::Tool(number));
        Ok(())
    }

    /// M functions except the stops at the end of the block; returns the word that ends the routine.
    fn m_functions(&mut self, words: &BlockWords) -> Result<Option<Span>, Box<Diagnostic>> {
        let mut end = words.end_of_routine;
        // LinuxCNC changes the tool first, then switches spindle and coolant; so do controls.
        let mut list: Vec<&At<u32>> = words.m.iter().collect();
        list.sort_by_key(|m| match m.value {
            6 => 0,
            3..=5 => 1,
            7..=9 => 2,
            _ => 3,
        });
        for &At { value, span } in list {
            let action = match value {
                0 | 1 => continue,
                2 | 17 | 30 => {
                    end = Some(span);
                    continue;
                }
                3 => Action::Spindle(Spindle::Clockwise),
                4 => Action::Spindle(Spindle::Counterclockwise),
                5 => Action::Spindle(Spindle::Stop),
                6 => {
                    self.refuse_compensation(span, "the tool changes")?;
                    self.modal.forget_position();
                    self.actions.push(Action::ToolChange);
                    // The control selects D1 with the new tool.
                    Action::ToolLength(true)
                }
                7 => Action::Coolant(Coolant::Mist),
                8 => Action::Coolant(Coolant::Flood),
                9 => Action::Coolant(Coolant::Off),
                40..=45 => {
                    self.note(&format!("M{value}"), span);
                    continue;
                }
                _ if self.settings.passed_m.contains(&value) => Action::OtherM(value),
                _ => {
                    return Err(Box::new(
                        Diagnostic::error(span, format!("M{value} is not defined")).help(format!(
                            "if LinuxCNC has it on this machine, give --pass-m {value}"
                        )),
                    ));
                }
            };
            self.actions.push(action);
        }
        Ok(end)
    }

    fn offset(&mut self, words: &BlockWords, states: &mut Vec<Action>) -> Done {
        let Some(offset) = words.offset else {
            return Ok(());
        };
        let on = match offset.value {
            0.0 => false,
            1.0 => true,
            value => {
                return Err(Box::new(
                    Diagnostic::error(offset.span, format!("D{value}: a tool has one offset in LinuxCNC"))
                        .help("use D1 for the tool in the spindle, D0 for none; enter further edges as tools"),
                ));
            }
        };
        self.refuse_compensation(offset.span, "the tool offset changes")?;
        self.modal.forget_position();
        if !matches!(self.actions.last(), Some(Action::ToolLength(last)) if *last == on) {
            states.push(Action::ToolLength(on));
        }
        Ok(())
    }

    /// `ADIS=` (distance at which G641 begins to round) and `CTOL=` (contour tolerance) become the
    /// tolerance of G64.
    fn corner_tolerance(&mut self, words: &BlockWords, states: &mut Vec<Action>) -> Done {
        let Some(tolerance) = words.tolerance else {
            return Ok(());
        };
        states.retain(|state| !matches!(state, Action::PathControl(_)));
        let before = self.actions.len();
        self.continuous_path(Some(tolerance.value), tolerance.span)?;
        states.extend(self.actions.drain(before..));
        Ok(())
    }

    /// Corners may be rounded by so much, in units of the program; `None`: as the machine has it.
    pub(super) fn continuous_path(&mut self, tolerance: Option<f64>, span: Span) -> Done {
        if tolerance.is_some_and(|tolerance| tolerance < 0.0) {
            return Err(Box::new(Diagnostic::error(
                span,
                "a tolerance cannot be negative",
            )));
        }
        let tolerance = tolerance.filter(|tolerance| *tolerance > 0.0);
        let control = PathControl::Continuous {
            tolerance: tolerance.map(|tolerance| tolerance * self.modal.length_factor),
        };
        self.modal.path_control = Some(control);
        self.actions.push(Action::PathControl(control));
        Ok(())
    }

    fn motion(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        if let Some(span) = once.preset {
            return self.preset(words, span);
        }
        if let Some(span) = once.machine_coordinates {
            return self.machine_move(words, span);
        }
        if !words.names_an_axis() && !words.names_a_centre() && words.turns.is_none() {
            if once.exact_stop {
                return Err(Box::new(
                    Diagnostic::error(
                        block,
                        "G9 acts in its block only, and this one has no motion",
                    )
                    .help("put it beside the axes, or use G60"),
                ));
            }
            return Ok(());
        }
        let span = words.first_axis().unwrap_or(block);
        let Some(motion) = self.modal.motion else {
            return Err(Box::new(
                Diagnostic::error(span, "no G0, G1, G2 or G3 before the first motion")
                    .help("say how the axes are to move: G0 rapid, G1 with feed"),
            ));
        };
        if motion != Motion::Rapid {
            self.check_feed(words, span)?;
        }
        let mut path = path_move(
            words,
            motion,
            &self.modal,
            self.settings,
            span,
            self.diagnostics,
        )?;
        path.exact_stop = once.exact_stop;
        if self.modal.compensation != Compensation::Off && path.depends_on_position() {
            return Err(Box::new(
                Diagnostic::error(
                    span,
                    "under cutter compensation, from a place that is not known ahead of time",
                )
                .help("program the axes of the plane absolute before G41 or G42"),
            ));
        }
        carry_out(&path, &mut self.modal);
        self.actions.push(Action::Move(path));
        Ok(())
    }

    pub(super) fn check_feed(&mut self, words: &BlockWords, span: Span) -> Done {
        let inverse = self.modal.feed_mode == FeedMode::InverseTime;
        if self.modal.has_feed && (!inverse || words.feed.is_some()) {
            return Ok(());
        }
        // Said once; the blocks after it have the same fault.
        self.modal.has_feed = true;
        Err(Box::new(
            Diagnostic::error(span, "a motion with feed, and no F is in force").help(
                match inverse {
                    true => "with G93 every block needs its own F",
                    false => "add F to this block, in mm/min unless G95 says otherwise",
                },
            ),
        ))
    }

    /// M0 and M1 act when the motion is over.
    fn stops(&mut self, words: &BlockWords) {
        for m in &words.m {
            if matches!(m.value, 0 | 1) {
                self.actions.push(Action::Pause {
                    optional: m.value == 1,
                });
            }
        }
    }

    /// Changes the frame.
    pub(super) fn run_frame(&mut self, command: FrameCommand, span: Span) -> Done {
        self.refuse_compensation(span, "the frame changes")?;
        let frame = self
            .modal
            .frame
            .after(command)
            .map_err(|error| Box::new(frame_error(error, span)))?;
        if frame.rotates_after_unequal_scale() && !self.modal.frame.rotates_after_unequal_scale() {
            self.diagnostics.push(
                Diagnostic::warning(
                    span,
                    "this rotation follows a scale that differs between axes",
                )
                .help(
                    "it acts in the scaled frame, so that right angles are not kept; \
                         controls that store scale and rotation apart would differ",
                ),
            );
        }
        self.modal.set_frame(frame);
        self.actions.push(Action::Frame(command));
        Ok(())
    }
}
