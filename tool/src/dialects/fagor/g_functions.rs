//! What the G functions of a block change.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::groups::{Groups, in_order_of_compensation};
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::{Compensation, FeedMode, PathControl, Plane};
use crate::source::Span;

/// What the G functions of a block ask for besides changing modes.
#[derive(Clone, Copy, Default)]
pub(super) struct OneShot {
    /// G4.
    pub(super) dwell: Option<Span>,
    /// G53.
    pub(super) machine_coordinates: Option<Span>,
    /// G92.
    pub(super) preset: Option<Span>,
    /// G6: the centre of the arc is absolute.
    pub(super) absolute_centre: Option<Span>,
    /// G8 or G9.
    pub(super) arc_form: Option<At<u32>>,
    /// G36 to G39.
    pub(super) corner: Option<At<u32>>,
    /// G69, G79 and G81 to G89.
    pub(super) cycle: Option<At<u32>>,
    /// G40 to G42.
    pub(super) compensation: Option<At<Compensation>>,
    /// G43 or G44.
    pub(super) length: Option<At<bool>>,
    /// G33.
    pub(super) thread: Option<Span>,
}

impl OneShot {
    /// What changes the form of a path: G36 to G39, G8 and G9, G6.
    pub(super) fn of_path(&self) -> Option<At<u32>> {
        let centre = self.absolute_centre.map(|span| At { value: 6, span });
        self.corner.or(self.arc_form).or(centre)
    }

    /// What needs more than axes in its block: a path, a canned cycle, a thread.
    pub(super) fn beside_axes(&self) -> Option<At<u32>> {
        let thread = self.thread.map(|span| At { value: 33, span });
        self.of_path().or(self.cycle).or(thread)
    }
}

impl Interpreter<'_> {
    /// Carries out the G functions of a block that change modes; the others go to the result.
    pub(super) fn g_functions(&mut self, words: &BlockWords) -> Result<OneShot, Diagnostic> {
        let mut once = OneShot::default();
        let mut groups = Groups::default();
        for At { value: code, span } in in_order_of_compensation(&words.g, 1) {
            let other_offset = matches!(code, 54..=57)
                && (self.preset || self.control.modal.work_offset != Some((code - 53) as u8));
            if other_offset {
                self.refuse_shift_in_cycle(&words.g, At { value: code, span })?;
            }
            let group = self.g_function(code, span, &mut once)?;
            // Several mirrors may stand together.
            if group != 0 {
                groups.claim(group, format!("G{code}"), span)?;
            }
        }
        Ok(once)
    }

    /// One G function; returns the number of its group, of which a block may hold one.
    fn g_function(&mut self, code: u32, span: Span, once: &mut OneShot) -> Result<u8, Diagnostic> {
        let at = At { value: code, span };
        let group = match code {
            0..=3 => {
                self.control.modal.motion = Some(match code {
                    0 => Motion::Rapid,
                    1 => Motion::Line,
                    2 => Motion::Clockwise,
                    _ => Motion::Counterclockwise,
                });
                self.thread = None;
                1
            }
            8 | 9 => {
                once.arc_form = Some(at);
                1
            }
            4 => {
                once.dwell = Some(span);
                2
            }
            5 | 50 => {
                if code == 50 {
                    self.control.note_once(
                        "G50",
                        "G50 rounds corners as the control is set: it runs as G5, corners are rounded by at most \
                         --tolerance",
                        span,
                    );
                }
                self.control.continuous_path(None, span)?;
                3
            }
            7 => {
                self.control.path_control(PathControl::ExactStop, span)?;
                3
            }
            6 => {
                once.absolute_centre = Some(span);
                4
            }
            // Carried out before.
            10..=13 => 0,
            17..=19 => {
                let plane = match code {
                    17 => Plane::Xy,
                    18 => Plane::Zx,
                    _ => Plane::Yz,
                };
                if plane != self.control.modal.plane {
                    self.reset_polar_origin();
                    self.end_cycle();
                }
                self.control.plane(plane, span)?;
                5
            }
            36..=39 => {
                once.corner = Some(at);
                6
            }
            40..=42 => {
                let compensation = match code {
                    40 => Compensation::Off,
                    41 => Compensation::Left,
                    _ => Compensation::Right,
                };
                let compensation = At {
                    value: compensation,
                    span,
                };
                if self.control.switch_compensation(compensation)? {
                    once.compensation = Some(compensation);
                }
                7
            }
            43 | 44 => {
                once.length = Some(At {
                    value: code == 43,
                    span,
                });
                8
            }
            53 => {
                once.machine_coordinates = Some(span);
                10
            }
            54..=57 => {
                if self.preset {
                    self.control.preset_off(span)?;
                    self.preset = false;
                }
                self.control.work_offset((code - 53) as u8, span)?;
                10
            }
            70 | 71 => {
                let settings = self.control.settings;
                self.control.modal.use_inch(code == 70, true, settings);
                11
            }
            69 | 79 | 81..=89 => {
                once.cycle = Some(at);
                12
            }
            80 => {
                self.end_cycle();
                12
            }
            90 | 91 => {
                self.control.modal.incremental = code == 91;
                13
            }
            92 => {
                once.preset = Some(span);
                10
            }
            94 | 95 => {
                self.control.feed_mode(match code {
                    94 => FeedMode::PerMinute,
                    _ => FeedMode::PerRevolution,
                });
                14
            }
            96 => {
                self.control.diagnostics.push(
                    Diagnostic::warning(
                        span,
                        "G96 keeps the feed of the cutting edge, LinuxCNC that of the centre of the \
                         tool: arcs under compensation run with another feed",
                    )
                    .help("write G97 if that is meant"),
                );
                15
            }
            97 => 15,
            33 => {
                once.thread = Some(span);
                1
            }
            98 | 99 => {
                self.to_start = code == 98;
                16
            }
            _ => return Err(unsupported(code, span)),
        };
        Ok(group)
    }
}

fn unsupported(code: u32, span: Span) -> Diagnostic {
    let reason = match code {
        15 | 16 | 49 => "only the planes G17, G18 and G19 are supported",
        20..=22 => {
            "the work zones of this control are not kept, and to LinuxCNC G20 and G21 mean inch and \
             millimetre: take them out, set limits at the machine"
        }
        23..=27 | 75 | 76 => "tracing and probing cannot be evaluated ahead of time",
        28..=30 => "switching spindles and synchronising axes is not supported",
        32 => "feed as a function of time is not supported: use G94",
        52 => "a motion up to a stop cannot be evaluated ahead of time",
        58 | 59 => {
            "in this dialect it is added to G54 to G57, in LinuxCNC it would take their place: enter the \
             sum of both into one of G54 to G57"
        }
        159 => "further zero offsets are not supported: use G54 to G57",
        67 | 68 => {
            "it is an operation of an irregular pocket: G66 R200 F300 S400 E500 names its block, which \
             stands behind M30"
        }
        74 => "a reference search is done at the machine: take it out, or move with G53",
        77 | 78 => "slaved axes are not supported",
        _ => {
            "look it up in the manual of the control, and write it with functions that are supported"
        }
    };
    Diagnostic::error(span, format!("G{code} is not supported")).help(reason)
}
