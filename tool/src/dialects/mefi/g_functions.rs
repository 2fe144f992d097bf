//! What the G and M functions and the words of the tool change.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::recalculation::Recalculation;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::groups::{Groups, in_order_of_compensation};
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::{Compensation, FeedMode, Plane};
use crate::source::Span;

/// What the G functions of a block ask for besides changing modes.
#[derive(Default)]
pub(super) struct OneShot {
    /// G4.
    pub(super) dwell: Option<Span>,
    /// G92.
    pub(super) preset: Option<Span>,
}

impl Interpreter<'_> {
    pub(super) fn g_functions(&mut self, words: &BlockWords) -> Result<OneShot, Diagnostic> {
        let mut once = OneShot::default();
        let mut groups = Groups::default();
        for At { value: code, span } in in_order_of_compensation(&words.g, 1) {
            let group = self.g_function(code, span, &mut once)?;
            groups.claim(group, format!("G{code}"), span)?;
        }
        Ok(once)
    }

    /// One G function; returns a number for its group, of which a block may hold one.
    fn g_function(&mut self, code: u32, span: Span, once: &mut OneShot) -> Result<u8, Diagnostic> {
        let control = &mut self.control;
        Ok(match code {
            0..=3 => {
                self.motion_named = true;
                control.modal.motion = Some(match code {
                    0 => Motion::Rapid,
                    1 => Motion::Line,
                    2 => Motion::Clockwise,
                    _ => Motion::Counterclockwise,
                });
                0
            }
            4 => {
                once.dwell = Some(span);
                1
            }
            17..=19 => {
                let plane = [Plane::Xy, Plane::Zx, Plane::Yz][code as usize - 17];
                control.plane(plane, span)?;
                2
            }
            23 => {
                control.note("G23", span);
                3
            }
            40..=42 => {
                let compensation = [Compensation::Off, Compensation::Left, Compensation::Right];
                let value = compensation[code as usize - 40];
                if value != Compensation::Off && !self.offset_row.is_named() {
                    control.note_once(
                        "no D",
                        "without a D before it this takes the radius of the tool in the spindle, and not its length",
                        span,
                    );
                }
                control.compensation_by_row(At { value, span }, self.offset_row)?;
                4
            }
            53 => {
                control.refuse_compensation(span, "the work offset changes")?;
                control.modal.forget_position();
                self.offset_free.begin("G53");
                5
            }
            54..=59 => {
                control.work_offset((code - 53) as u8, span)?;
                self.offset_free.end();
                5
            }
            90 | 91 => {
                control.modal.incremental = code == 91;
                6
            }
            92 => {
                once.preset = Some(span);
                7
            }
            94 => {
                control.feed_mode(FeedMode::PerMinute);
                8
            }
            95 => {
                control.feed_mode(FeedMode::PerRevolution);
                8
            }
            _ => return Err(unsupported(code, span)),
        })
    }

    /// G92 presets the position. What it presets under a recalculation, the manual does not say.
    pub(super) fn preset(&mut self, words: &BlockWords, span: Span) -> Done {
        let refusal = if words.motion.names_a_centre() {
            Some((
                "a centre or a radius is in its block",
                "put the arc in a block of its own",
            ))
        } else if self.offset_free.active {
            Some((
                "the work offset is off (G53)",
                "select a work offset (G54) before",
            ))
        } else if self.recalculation != Recalculation::default() {
            Some((
                "a recalculation of coordinates is active",
                "cancel it with G34 before, and set it again after",
            ))
        } else {
            None
        };
        match refusal {
            None => self.control.preset(&words.motion, span),
            Some((why, help)) => {
                Err(Diagnostic::error(span, format!("G92 while {why}")).help(help))
            }
        }
    }

    /// `G4 F2`, `G4 X2`: seconds.
    pub(super) fn dwell(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        let feed = rest.feed.take();
        let axis = rest.motion.axes[0].take();
        let axis = axis.map(|axis| At {
            value: axis.value.0,
            span: axis.span,
        });
        let other = rest.beside_axes(4);
        if let (Some((word, at)), None, None) = (&other, feed, axis) {
            return Err(
                Diagnostic::error(*at, format!("{word} is no time of G4 here"))
                    .help("G4 F2.5 and G4 X2.5 wait 2.5 seconds"),
            );
        }
        let other = other.map(|(_, span)| span);
        let seconds = match (feed, axis, other.or(rest.motion.first_axis())) {
            (Some(seconds), None, None) | (None, Some(seconds), None) => seconds,
            (_, _, Some(other)) => {
                return Err(Diagnostic::error(other, "G4 stands alone in its block")
                    .help("put everything but the time in another block"));
            }
            _ => {
                return Err(
                    Diagnostic::error(span, "G4 needs a time").help("G4 F2.5 waits 2.5 seconds")
                );
            }
        };
        self.control.diagnostics.push(Diagnostic::warning(
            seconds.span,
            format!("the dwell is taken as {} seconds", seconds.value),
        ));
        self.control.dwell(seconds.value, seconds.span)
    }

    /// `D3`: the row of the offset table with length and radius.
    pub(super) fn tool_offset(&mut self, offset: At<f64>) -> Done {
        if self
            .control
            .select_offset_row(&mut self.offset_row, offset)?
        {
            self.offset_free.forget();
        }
        Ok(())
    }
}

fn unsupported(code: u32, span: Span) -> Diagnostic {
    let help = match code {
        20 | 21 => "programs of this dialect are in millimetres",
        43 | 44 => "D3 selects the length and the radius of row 3 of the offset table",
        33 | 63 | 84 => "threads and rigid tapping are not supported",
        72..=78 => "only calls (G71 L100) and their ends (G70) are supported",
        81..=89 => "post the program with the cycles written out as moves",
        93 => "use G94 or G95",
        96 | 97 => "constant cutting speed is not supported",
        _ => {
            "look it up in the manual of the control, and write it with functions that are supported"
        }
    };
    Diagnostic::error(span, format!("G{code} is not supported")).help(help)
}
