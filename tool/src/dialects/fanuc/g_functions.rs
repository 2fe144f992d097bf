//! What the G functions of a block change.

use super::block_words::{BlockWords, g_name};
use super::cycles::is_cycle;
use super::interpreter::Interpreter;
use super::tool_offsets::other_length;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::groups::{Groups, in_order_of_compensation};
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::{Compensation, FeedMode, PathControl, Plane};
use crate::source::Span;

/// The group of functions that decide what the coordinates of a block mean.
const PLACES: u8 = 100;

/// What the G functions of a block ask for besides changing modes.
#[derive(Clone, Copy, Default)]
pub(super) struct OneShot {
    /// G4, G28, G52, G53 and others that say what the coordinates of their block mean.
    pub(super) place: Option<At<u32>>,
    /// G9.
    pub(super) exact_stop: bool,
    /// G73 to G89.
    pub(super) cycle: Option<At<u32>>,
    /// G43 or G49.
    pub(super) length: Option<At<bool>>,
    /// G41 or G42.
    pub(super) compensation: Option<At<Compensation>>,
    /// G96 or G97.
    pub(super) surface: Option<At<bool>>,
    /// G0 to G3.
    pub(super) motion: Option<Span>,
}

impl Interpreter<'_> {
    /// Carries out the G functions of a block that change modes; the others go to the result.
    pub(super) fn g_functions(&mut self, words: &mut BlockWords) -> Result<OneShot, Diagnostic> {
        let mut once = OneShot::default();
        let mut groups = Groups::default();
        // The end of a cycle comes before what cannot be changed in one.
        if words.has_g(800) {
            self.end_cycle();
        }
        for At { value: code, span } in in_order_of_compensation(&words.g, 10) {
            let group = self.g_function(code, span, words, &mut once)?;
            groups.claim(group, g_name(code), span)?;
        }
        self.check_cycle_and_motion(words, &once)?;
        Ok(once)
    }

    /// One G function; returns the number of its group, of which a block may hold one.
    fn g_function(
        &mut self,
        code: u32,
        span: Span,
        words: &mut BlockWords,
        once: &mut OneShot,
    ) -> Result<u8, Diagnostic> {
        let at = At { value: code, span };
        let group = match code {
            0 | 10 | 20 | 30 => {
                self.control.modal.motion = Some(match code {
                    0 => Motion::Rapid,
                    10 => Motion::Line,
                    20 => Motion::Clockwise,
                    _ => Motion::Counterclockwise,
                });
                once.motion = Some(span);
                1
            }
            40 | 100 | 120 | 130 | 280 | 300 | 510 | 511 | 501 | 520 | 530 | 531 | 680 | 682
            | 920 => {
                once.place = Some(at);
                PLACES
            }
            700 | 710 if self.cycle.is_some() => {
                once.place = Some(at);
                PLACES
            }
            1870 => {
                self.smoothness(words, span)?;
                103
            }
            50 | 51 | 80 | 1030 => {
                self.look_ahead(code, span, words)?;
                101
            }
            90 => {
                once.exact_stop = true;
                102
            }
            150 => {
                self.polar = None;
                17
            }
            160 => {
                self.begin_polar(span)?;
                17
            }
            // The end of modes that are not there: the values of G10, the turning to the path, polygons, the face of a
            // rotary axis.
            110 => 104,
            401 => 19,
            502 => 20,
            131 => 21,
            170 | 180 | 190 => {
                self.plane(code, span)?;
                2
            }
            200 | 210 => {
                self.unit(code == 200, span)?;
                6
            }
            400 => {
                let active = self.control.modal.compensation != Compensation::Off;
                self.control.compensation(Compensation::Off, span)?;
                if active {
                    // What follows may not be done under compensation.
                    self.control.apply_states(true);
                }
                7
            }
            410 | 420 => {
                let value = match code {
                    410 => Compensation::Left,
                    _ => Compensation::Right,
                };
                once.compensation = Some(At { value, span });
                7
            }
            430 | 490 => {
                let value = code == 430;
                once.length = Some(At { value, span });
                8
            }
            440 | 434 | 435 => return Err(other_length(code, span)),
            500 => {
                self.transform_off(code, span)?;
                11
            }
            690 => {
                self.transform_off(code, span)?;
                16
            }
            540..=590 => {
                self.work_offset(code, words, span)?;
                14
            }
            // That of Haas controls.
            1540 => {
                self.work_offset(541, words, span)?;
                14
            }
            610 => {
                self.path_mode(PathControl::ExactStop, span)?;
                15
            }
            620 => {
                self.control.note("G62", span);
                15
            }
            640 => {
                let tolerance = self.control.settings.tolerance;
                self.path_mode(PathControl::Continuous { tolerance }, span)?;
                15
            }
            670 => {
                self.modal_macro = None;
                12
            }
            _ if is_cycle(code) => {
                once.cycle = Some(at);
                9
            }
            800 => 9,
            900 | 910 => {
                self.control.modal.incremental = code == 910;
                3
            }
            930 | 940 | 950 => {
                self.control.feed_mode(match code {
                    930 => FeedMode::InverseTime,
                    940 => FeedMode::PerMinute,
                    _ => FeedMode::PerRevolution,
                });
                5
            }
            960 | 970 => {
                let value = code == 960;
                once.surface = Some(At { value, span });
                13
            }
            980 | 990 => {
                self.to_return_level = code == 990;
                10
            }
            _ => return Err(unsupported(code, span)),
        };
        Ok(group)
    }

    fn plane(&mut self, code: u32, span: Span) -> Done {
        let plane = match code {
            170 => Plane::Xy,
            180 => Plane::Zx,
            _ => Plane::Yz,
        };
        let fixed = self.transforms.rotation.is_some() || self.cycle.is_some();
        if fixed && plane != self.control.modal.plane {
            return Err(
                Diagnostic::error(span, "another plane in a canned cycle or under G68")
                    .help("write G80 and G69 before"),
            );
        }
        self.control.plane(plane, span)
    }

    /// G20 and G21. The levels of a cycle are kept as they were written.
    fn unit(&mut self, inch: bool, span: Span) -> Done {
        if self.cycle.is_some() && inch != self.inch {
            return Err(
                Diagnostic::error(span, "another unit of length in a canned cycle")
                    .help("end the cycle with G80 before"),
            );
        }
        self.use_unit(inch);
        Ok(())
    }

    /// The unit of what follows.
    pub(super) fn use_unit(&mut self, inch: bool) {
        self.inch = inch;
        let settings = self.control.settings;
        self.control.modal.use_inch(inch, true, settings);
    }

    /// `G54` to `G59`, `G54.1 P1` and `G54 P1`.
    fn work_offset(&mut self, code: u32, words: &mut BlockWords, span: Span) -> Done {
        if !code.is_multiple_of(10) && code != 541 {
            return Err(unsupported(code, span));
        }
        if !self.transforms.is_empty() {
            return Err(Diagnostic::error(
                span,
                format!(
                    "{} while G51, G51.1, G68 or G68.2 is in force",
                    g_name(code)
                ),
            )
            .help("end them with G69, G50 and G50.1 before"));
        }
        let further = match code {
            540 | 541 => words.p.take(),
            _ => None,
        };
        let system = match further {
            None if code == 541 => {
                return Err(
                    Diagnostic::error(span, "G54.1 needs the number of the work offset")
                        .help("write G54.1 P1"),
                );
            }
            None => (code / 10 - 53) as u8,
            Some(At {
                value: (value, _), ..
            }) if [1.0, 2.0, 3.0].contains(&value) => {
                self.control.note_once(
                    &format!("G54.1 P{value}"),
                    &format!(
                        "G54.1 P{value} runs as G59.{value}: its offset is that of G59.{value}"
                    ),
                    span,
                );
                6 + value as u8
            }
            Some(At {
                value: (value, _),
                span,
            }) => {
                return Err(Diagnostic::error(
                    span,
                    format!("LinuxCNC has no work offset for P{value}"),
                )
                .help("G54.1 P1 to P3 are G59.1 to G59.3 there: use those, or G54 to G59"));
            }
        };
        let other = self.control.modal.work_offset != Some(system);
        self.control.work_offset(system, span)?;
        if let Some(cycle) = self.cycle.as_mut().filter(|_| other) {
            cycle.forget_initial();
        }
        // G54 with P is G54.1.
        let named = if system > 6 { 541 } else { code };
        self.work_offset = Some(f64::from(named) / 10.0);
        Ok(())
    }

    fn end_cycle(&mut self) {
        self.cycle = None;
        self.rigid = false;
    }

    /// G0 to G3 end a canned cycle. In the same block they may only stand before it.
    fn check_cycle_and_motion(&mut self, words: &BlockWords, once: &OneShot) -> Done {
        let Some(motion) = once.motion else {
            return Ok(());
        };
        let Some(cycle) = once.cycle else {
            if self.cycle.is_some() {
                self.end_cycle();
            }
            return Ok(());
        };
        if motion.start > cycle.span.start && words.g.len() > 1 {
            return Err(Diagnostic::error(motion, "this function ends the canned cycle of its own block")
                    .help("write the cycle behind it, or leave it out: cycles move between holes by themselves"));
        }
        Ok(())
    }
}

fn unsupported(code: u32, span: Span) -> Diagnostic {
    let reason = match code {
        70 | 71 => "axes of a cylinder are not supported: post the moves of the rotary axis",
        101 => "settings are entered at the machine: take it out, and enter the values there",
        121 => "polar coordinates are not supported: post X and Y",
        220..=230 => "stored stroke limits are set at the machine: take it out",
        270 | 290 | 301 => {
            "which way the machine goes depends on its settings: write G53 with coordinates"
        }
        330 => "threads are not supported: tap with M29 S500 and G84",
        310..=313 | 370 => {
            "measuring cannot be evaluated ahead of time: measure at the machine, and take it out"
        }
        450..=480 => "single tool offsets are not supported: use G41 and G42",
        512 => "turning polygons is not supported",
        600 => "positioning from one side is not supported: write both motions",
        630 => "feed override is switched off by M49 and on by M48",
        532 | 536 => "write G53.1",
        411 | 421 => {
            "turning a tool to the path is not supported: post the moves of the rotary axis"
        }
        683 | 684 => "write G68.2 with the angles of the plane",
        700 | 710 => {
            "to lathes it is a cycle, and programs of lathes of this control are not translated; holes on a circle \
             (Haas) need a canned cycle before: G81 Z-5. R2. F100. L0"
        }
        720 => {
            "to lathes it is a cycle, and programs of lathes of this control are not translated; of holes in a line \
             (Haas) write the places, each in a block of its own"
        }
        1500 => "post the pocket as moves: G150 takes its contour from a subprogram",
        320 | 750 => {
            "to lathes it is a cycle or a thread, and programs of lathes of this control are not translated; \
             where it calls a macro, write G65 P and its number"
        }
        721 | 722 => {
            "copies are not supported: call the subprogram with M98 at each place, under G68 or G52"
        }
        870 | 880 => {
            "what it does depends on settings of the machine and on the operator: write its moves, or use \
             G85, G86 or G89"
        }
        921 => "G92.1 depends on the offset that was there: write G92, or G54",
        _ => {
            "look it up in the manual of the control; where it calls a macro, write G65 P and its number"
        }
    };
    Diagnostic::error(span, format!("{} is not supported", g_name(code))).help(reason)
}
