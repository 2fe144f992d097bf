//! What the G functions of a block change.

use super::approach::shape_of;
use super::arc_words::ArcForm;
use super::block_words::BlockWords;
use super::evaluate_words::OneShot;
use super::interpreter::Interpreter;
use super::spindle::SpindleMotion;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::groups::{Groups, in_order_of_compensation};
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::{Action, Compensation, FeedMode, Plane};
use crate::source::Span;

impl Interpreter<'_> {
    /// Carries out the G functions of a block that change modes; the others go to `once`.
    pub(super) fn g_functions(&mut self, words: &BlockWords, once: &mut OneShot) -> Done {
        let mut groups = Groups::default();
        for At { value: code, span } in in_order_of_compensation(&words.g, 10) {
            let group = self.g_function(code, span, once)?;
            groups.claim(group, format!("G{}", shown(code)), span)?;
        }
        for (name, span, form) in [
            ("CIP", words.cip, ArcForm::Cip),
            ("CT", words.ct, ArcForm::Ct),
        ] {
            if let Some(span) = span {
                groups.claim(1, name.to_string(), span)?;
                self.begin_motion(None, None);
                self.arc_form = Some(form);
            }
        }
        Ok(())
    }

    /// The motion of the blocks from here on: one of G0 to G3, or one in step with the spindle.
    fn begin_motion(&mut self, motion: Option<Motion>, spindle: Option<SpindleMotion>) {
        self.arc_form = None;
        self.spindle_motion = spindle;
        self.control.modal.motion = motion;
    }

    /// One G function; returns the number of its group, of which a block may hold one.
    fn g_function(&mut self, code: u32, span: Span, once: &mut OneShot) -> Result<u8, Diagnostic> {
        let group = match code {
            0 | 10 | 20 | 30 => {
                let motion = match code {
                    0 => Motion::Rapid,
                    10 => Motion::Line,
                    20 => Motion::Clockwise,
                    _ => Motion::Counterclockwise,
                };
                self.begin_motion(Some(motion), None);
                1
            }
            330 | 3310 | 3320 => {
                self.begin_motion(None, SpindleMotion::of(code));
                1
            }
            // It moves by itself, the others of the group go on behind it.
            630 => 1,
            1470 | 2470 | 3470 | 1480 | 2480 | 3480 => {
                once.smooth = shape_of(code).map(|(_, approaches)| approaches);
                2
            }
            1400..=1420 => {
                self.approach_mode(code);
                43
            }
            3400 | 3410 => {
                self.approach_mode(code);
                44
            }
            960 => {
                // Before F, which is per turn in its block.
                self.control.feed_mode(FeedMode::PerRevolution);
                15
            }
            // It counts the feed as G95 does, whatever was in force.
            970 => {
                if self.control.modal.feed_mode != FeedMode::PerRevolution {
                    self.control.feed_mode(FeedMode::PerRevolution);
                }
                15
            }
            40 => {
                once.dwell = Some(span);
                2
            }
            90 => {
                once.exact_stop = true;
                11
            }
            170 | 180 | 190 => {
                let plane = match code {
                    170 => Plane::Xy,
                    180 => Plane::Zx,
                    _ => Plane::Yz,
                };
                self.choose_plane(plane, span)?;
                6
            }
            400 | 410 | 420 => {
                let value = match code {
                    400 => Compensation::Off,
                    410 => Compensation::Left,
                    _ => Compensation::Right,
                };
                self.control.switch_compensation(At { value, span })?;
                7
            }
            530 | 1530 => {
                once.machine_coordinates = Some(span);
                9
            }
            580 | 590 => {
                once.programmed_offset = Some(At {
                    value: code / 10,
                    span,
                });
                3
            }
            540..=579 | 591..=593 | 5050..=5999 => {
                self.work_offset(code, span)?;
                8
            }
            5000 => {
                self.suppress_offset(span)?;
                8
            }
            520 => {
                once.local_offset = Some(span);
                3
            }
            1100 | 1110 | 1120 => {
                once.pole = Some(At {
                    value: code / 10,
                    span,
                });
                3
            }
            600 | 640 | 6410..=6450 => {
                self.path_mode(code, span)?;
                10
            }
            6010 | 6020 | 6030 | 4500 | 4510 => {
                self.control.note(&format!("G{}", shown(code)), span);
                12
            }
            700 | 710 | 7000 | 7100 => {
                let inch = matches!(code, 700 | 7000);
                let settings = self.control.settings;
                self.control.modal.use_inch(inch, code >= 7000, settings);
                13
            }
            900 | 910 => {
                self.control.modal.incremental = code == 910;
                14
            }
            930 | 940 | 950 => {
                let mode = match code {
                    930 => FeedMode::InverseTime,
                    940 => FeedMode::PerMinute,
                    _ => FeedMode::PerRevolution,
                };
                self.control.feed_mode(mode);
                15
            }
            920 => {
                once.preset = Some(span);
                3
            }
            _ => return Err(unsupported_g(code, span)),
        };
        Ok(group)
    }

    fn work_offset(&mut self, code: u32, span: Span) -> Done {
        let system = match code {
            540 | 550 | 560 | 570 => (code - 530) / 10,
            591..=593 => code - 584,
            5050 | 5060 | 5070 | 5080 | 5090 => (code - 5000) / 10,
            _ => {
                return Err(Diagnostic::error(
                    span,
                    format!("LinuxCNC has no work offset for G{}", shown(code)),
                )
                .help("it has nine: G54 to G59.3, also reached as G54 to G57 and G505 to G509"));
            }
        };
        if code >= 5000 {
            let names = ["G58", "G59", "G59.1", "G59.2", "G59.3"];
            let name = names
                .get((system as usize).saturating_sub(5))
                .unwrap_or(&"G59.3");
            let message = format!("G{} runs as {name} of LinuxCNC", shown(code));
            self.control
                .diagnostics
                .push(Diagnostic::warning(span, message));
        }
        self.choose_offset(system as u8, span)
    }

    /// Work offset 1 to 9, which are those of LinuxCNC.
    pub(super) fn choose_offset(&mut self, system: u8, span: Span) -> Done {
        let acts_already = self.system == Some(system) && self.waiting_offsets.is_empty();
        self.offset_free.end();
        self.system = Some(system);
        self.set_offsets();
        if acts_already {
            self.control
                .refuse_compensation(span, "the work offset changes")?;
            self.control.states.push(Action::WorkOffset(system));
            return Ok(());
        }
        // Its values may be others than before.
        self.control.modal.work_offset = None;
        self.control.work_offset(system, span)
    }

    /// G500.
    pub(super) fn suppress_offset(&mut self, span: Span) -> Done {
        self.control
            .refuse_compensation(span, "the work offset changes")?;
        self.control.modal.change_offset([true; 9]);
        self.control.modal.work_offset = None;
        self.system = Some(0);
        self.set_offsets();
        self.offset_free.begin("G500");
        Ok(())
    }
}

fn shown(tenfold: u32) -> String {
    match tenfold % 10 {
        0 => (tenfold / 10).to_string(),
        tenth => format!("{}.{tenth}", tenfold / 10),
    }
}

/// An error for a G function that is not translated, by ten times its number.
pub(super) fn unsupported_g(code: u32, span: Span) -> Diagnostic {
    let reason = match code {
        340 | 350 => "threads whose pitch changes are not supported",
        961 | 962 | 971 | 9610 | 9620 | 9710 | 9720 | 9730 => "write G96 or G97, with F per turn",
        250 | 260 => {
            "working areas are the soft limits of LinuxCNC (MIN_LIMIT and MAX_LIMIT in the INI file); a limit of the spindle \
             with G96 and G97 is LIMS=2000"
        }
        740 => {
            "reference points are LinuxCNC's homing: leave it out, or write the motion there, G0 SUPA Z0 D0"
        }
        750 => {
            "the places of G75 are those of the other control: write the motion there, G0 SUPA Z0 D0"
        }
        200 | 210 => "inch and millimetre are G70 and G71 in this dialect",
        _ => {
            "look it up in the manual of the control, and write it with functions that are supported"
        }
    };
    Diagnostic::error(span, format!("G{} is not supported", shown(code))).help(reason)
}
