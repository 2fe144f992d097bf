//! What the G functions of a block change.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::modes::OneShot;
use super::spindle::SpindleMotion;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::groups::{Groups, in_order_of_compensation};
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::{Compensation, FeedMode, Plane};
use crate::source::Span;

impl Interpreter<'_> {
    pub(super) fn g_functions(&mut self, words: &BlockWords) -> Result<OneShot, Diagnostic> {
        let mut once = OneShot::default();
        let mut groups = Groups::default();
        for At { value: code, span } in in_order_of_compensation(&words.g, 1) {
            let group = self.g_function(code, span, words, &mut once)?;
            groups.claim(group, format!("G{code}"), span)?;
        }
        Ok(once)
    }

    /// One G function; returns a number for its group, of which a block may hold one.
    fn g_function(
        &mut self,
        code: u32,
        span: Span,
        words: &BlockWords,
        once: &mut OneShot,
    ) -> Result<u8, Diagnostic> {
        let own_feed = words.feed.is_some();
        let group = match code {
            0..=3 => {
                self.spindle.active = None;
                self.control.modal.motion = Some(match code {
                    0 => Motion::Rapid,
                    1 => Motion::Line,
                    2 => Motion::Clockwise,
                    _ => Motion::Counterclockwise,
                });
                0
            }
            33 | 63 => {
                self.spindle.active = Some(match code {
                    33 => SpindleMotion::Thread,
                    _ => SpindleMotion::Tap,
                });
                0
            }
            4 => {
                once.dwell = Some(span);
                0
            }
            17..=19 => {
                let plane = [Plane::Xy, Plane::Zx, Plane::Yz][code as usize - 17];
                self.plane(plane, span)?;
                1
            }
            20..=23 => {
                self.mirror_plane(code, span)?;
                2
            }
            351 => {
                once.mirror_axes = Some(span);
                2
            }
            25 | 26 | 164 | 165 => {
                self.control.note(&format!("G{code}"), span);
                3
            }
            // Where feeds begin and end to change: blendtp and LinuxCNC keep the limits of the axes by themselves.
            8 | 9 | 900 | 901 => {
                self.control.note(&format!("G{code}"), span);
                15
            }
            // F holds for the centre of the tool, as it does for LinuxCNC.
            10 => 16,
            12 | 13 => {
                self.control.note(&format!("G{code}"), span);
                17
            }
            40..=42 => {
                let compensation = [Compensation::Off, Compensation::Left, Compensation::Right];
                let value = compensation[code as usize - 40];
                if value != Compensation::Off && !self.offset_row.is_named() {
                    return Err(no_row(code, span));
                }
                self.control
                    .compensation_by_row(At { value, span }, self.offset_row)?;
                4
            }
            // Diameter programming off, and speed in revolutions: the state in which programs begin.
            52 | 97 => 5,
            53..=59 => {
                self.zero_offset(code - 53, span)?;
                6
            }
            159 => {
                let value = words.g_value.map(|g| g.value);
                let wanted =
                    value.filter(|value| value.fract() == 0.0 && (0.0..=96.0).contains(value));
                let Some(wanted) = wanted else {
                    return Err(Diagnostic::error(
                        span,
                        "G159 needs the number of a zero offset, 0 to 96",
                    )
                    .help("write G159=2"));
                };
                self.zero_offset(wanted as u32, span)?;
                6
            }
            60 => {
                once.exact_stop = Some(span);
                7
            }
            61 => {
                once.contouring = Some(span);
                7
            }
            360 | 359 => {
                self.modes.exact_stop = code == 360;
                8
            }
            261 => {
                self.round_contour(span)?;
                9
            }
            260 => {
                // As before the program asked for contouring.
                self.control
                    .path_control(self.control.settings.path_mode, span)?;
                9
            }
            70 | 71 => {
                self.control
                    .modal
                    .use_inch(code == 70, true, self.control.settings);
                10
            }
            90 | 91 => {
                self.control.modal.incremental = code == 91;
                11
            }
            92 => {
                once.reference_offset = Some(span);
                12
            }
            93..=95 => {
                let mode = [
                    FeedMode::InverseTime,
                    FeedMode::PerMinute,
                    FeedMode::PerRevolution,
                ][code as usize - 93];
                self.feed_mode(mode, own_feed);
                13
            }
            161 | 162 => {
                self.modes.absolute_centre = code == 161;
                14
            }
            _ => return Err(unsupported(code, span)),
        };
        Ok(group)
    }

    fn plane(&mut self, plane: Plane, span: Span) -> Done {
        let changes = plane != self.control.modal.plane;
        if changes && self.frames.mirrors_plane() {
            self.check_mirror_plane(plane, span)?;
        }
        self.control.plane(plane, span)?;
        if !changes {
            return Ok(());
        }
        let mut next = self.frames.clone();
        if next.rotation.take().is_some() {
            self.control.diagnostics.push(
                Diagnostic::warning(span, "another plane ends #ROTATION")
                    .help("rotate again in the new plane"),
            );
        }
        self.set_frames(next, span)
    }

    /// G53, G54 to G59 and further ones; 0 for none.
    fn zero_offset(&mut self, number: u32, span: Span) -> Done {
        self.refuse_system(span, "the zero offset")?;
        match number {
            0 => {
                self.control
                    .refuse_compensation(span, "the work offset changes")?;
                self.control.modal.forget_position();
                self.offset_free.begin("G53");
            }
            1..=9 => {
                self.control.work_offset(number as u8, span)?;
                self.offset_free.end();
            }
            _ => {
                return Err(Diagnostic::error(
                    span,
                    format!("LinuxCNC has no work offset {number}"),
                )
                .help("it has nine: G54 to G59, and G59.1 to G59.3 as G159=7 to G159=9"));
            }
        }
        Ok(())
    }
}

/// Whether T selects length and radius too is a setting of the control; LinuxCNC would take the radius of the tool,
/// and not its length.
fn no_row(code: u32, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("G{code}, and no D before it"))
        .help("write D and the row of the tool table before it: D5 for length and radius of tool 5, D0 for none")
}

fn unsupported(code: u32, span: Span) -> Diagnostic {
    let help = match code {
        11 => "LinuxCNC takes F for the path of the tool's centre: write G10, and F for that path",
        331 | 332 => "write G63 Z-20 F300 S200, and Z5 S-200 to come back",
        51 => "diameter programming is not supported: program radii",
        68 | 69 => "write #ROTATION ON [ANGLE=30] and #ROTATION OFF",
        74 => "homing is done at the machine, not by programs",
        80..=89 | 800..=839 => {
            "cycles are subprograms of the other control: post the program with moves"
        }
        96 => "constant cutting speed is not supported",
        98 | 99 => "limits are set in the INI file",
        151 | 150 => "splines are not supported: post the program with lines and arcs",
        163 => "write R in the block of the arc",
        301 | 302 => "program the corner with a line or an arc of its own",
        _ => {
            "look it up in the manual of the control, and write it with functions that are supported"
        }
    };
    Diagnostic::error(span, format!("G{code} is not supported")).help(help)
}
