//! What the words of a block do, in the order in which the control does it: mirrors, modes, feed and
//! speed, tool, spindle, coolant, offsets, motion, stop.

use super::block_words::{BlockWords, missing};
use super::cycles::{Cycle, Form};
use super::g_functions::OneShot;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords};
use crate::program::moves::Corner;
use crate::program::{Action, Compensation};
use crate::source::Span;

/// How far from a whole number what is worked out from parameters may be.
const ROUNDING: f64 = 1e-6;

impl Interpreter<'_> {
    /// Runs the words of a block and appends what they do to the actions of the block. `true` when the
    /// program ends here.
    pub(super) fn run_words(
        &mut self,
        words: &BlockWords,
        block: Span,
    ) -> Result<bool, Diagnostic> {
        let mut own;
        let mut words = words;
        let mut form = None;
        if words.g.iter().any(|g| matches!(g.value, 69 | 79 | 87 | 88)) {
            own = words.clone();
            let old = self.cycle.as_ref().and_then(Cycle::form);
            let millimetre = match self.control.settings.machine_in_inch {
                true => 1.0 / 25.4,
                false => 1.0,
            };
            form = Form::take(
                &mut own,
                old,
                [self.control.modal.length_factor, millimetre],
            )?;
            words = &own;
        }
        if let Some(word) = words.finish_feed {
            return Err(
                Diagnostic::error(word.span, "the address H is not supported")
                    .help("it belongs to pockets (G87, G88) and deep holes (G69)"),
            );
        }
        let irregular = words.g.iter().any(|g| matches!(g.value, 67 | 68));
        if let Some(word) = words.further.filter(|_| !irregular) {
            return Err(
                Diagnostic::error(word.span, "the address E is not supported").help(
                    "axes are X Y Z A B C U V W; parameters are P1 and stand behind an address",
                ),
            );
        }
        self.mirror_functions(words)?;
        for g in &words.g {
            match g.value {
                14 => self.mirror_axes(words, g.span)?,
                72 => self.scale(words, g.span)?,
                73 => self.rotation(words, g.span)?,
                93 => self.polar_origin(words, g.span)?,
                51 => self.look_ahead(words, g.span)?,
                60..=65 => self.pattern(words, g.value, g.span)?,
                _ => continue,
            }
            return Ok(false);
        }
        let compensated = self.control.modal.compensation != Compensation::Off;
        let without_offset = self.offset_of_compensation(words)?;
        let words = without_offset.as_ref().unwrap_or(words);
        let once = self.g_functions(words)?;
        if let Some(span) = once.dwell {
            self.control.apply_states(compensated);
            self.dwell(words, &once, span)?;
            return Ok(false);
        }
        if let Some(feed) = words.feed {
            self.control.feed(feed)?;
        }
        if let Some(speed) = words.speed {
            if let Some(span) = once.preset {
                return Err(Diagnostic::error(
                    span,
                    "G92 S, a limit of the spindle speed, is not supported",
                )
                .help("leave S out: G92 X0 makes this place X0"));
            }
            self.control.speed(speed)?;
        }
        let end = self.tool_and_m(words, &once)?;
        self.control.apply_states(compensated);
        if let (Some(times), None) = (
            words.times,
            self.cycle.as_ref().map(|_| ()).or(once.cycle.map(|_| ())),
        ) {
            return Err(Diagnostic::error(
                times.span,
                "the block number stands at the beginning of the block",
            )
            .help(
                "N at the end repeats a canned cycle or a modal subroutine, and none is active",
            ));
        }
        self.place(words, &once, form, block)?;
        self.control.end_functions()?;
        self.control.stops(&words.m)?;
        if let Some(m) = end {
            self.control.end_of_program(m == 30);
        }
        Ok(end.is_some())
    }

    /// `G51 A50 E0.02`: corners may be rounded by E. A and B are of the accelerations and of the angles
    /// that the control looks at.
    fn look_ahead(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        let error = rest.contour_error.take();
        rest.g.retain(|g| g.value != 51);
        (rest.axes[3], rest.axes[4]) = (None, None);
        if rest != BlockWords::default() {
            return Err(Diagnostic::error(span, "G51 stands alone in its block")
                .help("write G51 E0.02: E is the greatest contour error"));
        }
        let tolerance = match error {
            Some(error) => Some(self.control.tolerance(error.value, error.span)?),
            None => None,
        };
        self.control.note("the look-ahead of G51", span);
        self.control.continuous_path(tolerance, span)?;
        self.control.apply_states(false);
        Ok(())
    }

    /// `G4 K100`: hundredths of a second.
    fn dwell(&mut self, words: &BlockWords, once: &OneShot, span: Span) -> Done {
        let Some(hundredths) = words.centre[2] else {
            return Err(Diagnostic::error(span, "G4 needs a time")
                .help("G4 K250 waits 2.5 seconds: K is in hundredths"));
        };
        let mut rest = words.clone();
        rest.centre[2] = None;
        let begins = once.compensation.filter(|g| g.value != Compensation::Off);
        let tool = begins.map(|g| g.span).or(once.length.map(|g| g.span));
        let place = once.preset.or(once.machine_coordinates).or(tool);
        let function = once.beside_axes().map(|g| g.span).or(place);
        if let Some(other) = rest.first_word().or(function) {
            return Err(Diagnostic::error(other, "G4 stands alone in its block")
                .help("put axes, F, S, T, D and M functions in another block"));
        }
        self.control.dwell(seconds(hundredths)?, span)
    }

    /// The coordinates of a block: a preset, a motion, a canned cycle.
    fn place(
        &mut self,
        words: &BlockWords,
        once: &OneShot,
        form: Option<Form>,
        block: Span,
    ) -> Done {
        if let Some(span) = once.preset {
            refuse_beside_axes(92, words, once)?;
            self.refuse_shift_in_cycle(&words.g, At { value: 92, span })?;
            return self.preset(words, span);
        }
        if let Some(span) = once.machine_coordinates {
            refuse_beside_axes(53, words, once)?;
            return self.machine_move(words, span);
        }
        if self.is_thread(words, once) {
            return self.thread(words, once, block);
        }
        if let Some(pitch) = words.pitch {
            return Err(Diagnostic::error(
                pitch.span,
                "L is the pitch of a thread, and there is none",
            )
            .help("write G33 Z-20 L1.5"));
        }
        self.refuse_path_of_cycle(once)?;
        if let Some(cycle) = once.cycle {
            return self.define_cycle(words, cycle, form, block);
        }
        if !words.names_a_place() {
            return match once.of_path() {
                Some(g) => Err(Diagnostic::error(
                    g.span,
                    format!("G{} needs a motion in its block", g.value),
                )
                .help(format!("write G{} beside the axes", g.value))),
                None => Ok(()),
            };
        }
        if self.cycle.is_some() {
            return self.cycle_block(words, once, block);
        }
        self.motion(words, once, block)
    }

    /// Between the places of a canned cycle the tool goes straight or along G2 and G3.
    fn refuse_path_of_cycle(&self, once: &OneShot) -> Done {
        let of_cycle = match (once.cycle, &self.cycle) {
            (Some(_), _) => once.of_path(),
            (None, Some(_)) => once.corner.or(once.arc_form),
            (None, None) => None,
        };
        match of_cycle {
            Some(g) => Err(Diagnostic::error(
                g.span,
                format!("G{} while a canned cycle is in force", g.value),
            )
            .help("end the cycle with G80 before")),
            None => Ok(()),
        }
    }

    /// The planes of a cycle are those of the zero point with which it was defined: under another the tool would go
    /// from hole to hole inside the part. `list`: the G functions of the block.
    pub(super) fn refuse_shift_in_cycle(&self, list: &[At<u32>], shift: At<u32>) -> Done {
        let another = |g: &At<u32>| matches!(g.value, 69 | 80..=89);
        if self.cycle.is_none() || list.iter().any(another) {
            return Ok(());
        }
        Err(
            Diagnostic::error(shift.span, format!("G{} in a canned cycle", shift.value))
                .help("end the cycle with G80 before"),
        )
    }

    /// A motion with the corner at its end.
    pub(super) fn motion(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        let corner = self.corner(words, once)?;
        let mut motion = self.motion_words(words, once)?;
        self.check_absolute_centre(words, once)?;
        let own_feed = words.feed.is_some();
        let kind = self.control.modal.motion;
        let span = motion.first_axis().unwrap_or(block);
        match once.arc_form {
            None => {
                self.resolve_polar(words, &mut motion, kind)?;
                self.resolve_helix(&mut motion, kind)?;
                if matches!(kind, Some(Motion::Rapid | Motion::Line)) && motion.radius.is_some() {
                    // R beside axes is no polar radius.
                    let at = motion.radius.map_or(span, |radius| radius.span);
                    return Err(Diagnostic::error(at, "R beside axes belongs to arcs")
                        .help("write G2 or G3, or R and Q for a place in polar coordinates"));
                }
                self.control.motion(&motion, block, own_feed, false)?;
            }
            Some(form) => {
                self.resolve_polar(words, &mut motion, Some(Motion::Line))?;
                let [first, second, _] = self.control.modal.plane.axes();
                let middle = [motion.centre[first], motion.centre[second]];
                let mut ends = motion;
                ends.centre = [None; 3];
                ends.radius = None;
                if form.value == 8 {
                    if let Some(centre) = middle.into_iter().flatten().next() {
                        return Err(
                            Diagnostic::error(centre.span, "a tangent arc has no centre")
                                .help("G8 needs the end point only"),
                        );
                    }
                    self.control.tangent_arc(&ends, own_feed, span)?;
                } else {
                    self.control.arc_through(&ends, middle, own_feed, span)?;
                }
            }
        }
        if let (Some(corner), Some(Action::Move(path))) = (corner, self.control.actions.last_mut())
        {
            path.corner = Some(corner);
        }
        Ok(())
    }

    /// G6 needs an arc with a centre.
    fn check_absolute_centre(&self, words: &BlockWords, once: &OneShot) -> Done {
        let arc = match once.arc_form {
            Some(form) => form.value == 9,
            None => matches!(
                self.control.modal.motion,
                Some(Motion::Clockwise | Motion::Counterclockwise)
            ),
        };
        match once.absolute_centre {
            Some(span) if !arc || words.centre.iter().all(Option::is_none) => {
                Err(Diagnostic::error(span, "G6 without an arc and its centre")
                    .help("write G6 G2 X10 Y0 I5 J0; the centre is I and J"))
            }
            _ => Ok(()),
        }
    }

    /// G36 R, G39 R.
    fn corner(&mut self, words: &BlockWords, once: &OneShot) -> Result<Option<Corner>, Diagnostic> {
        let Some(g) = once.corner else {
            return Ok(None);
        };
        let Some(radius) = words.corner_radius.filter(|radius| radius.value > 0.0) else {
            return Err(
                Diagnostic::error(g.span, format!("G{} needs R above 0", g.value)).help(format!(
                    "write G{} R5; the R of an arc stands behind it",
                    g.value
                )),
            );
        };
        let length = radius.value * self.control.modal.length_factor;
        match g.value {
            36 => Ok(Some(Corner::Round(length))),
            39 => Ok(Some(Corner::ChamferFrom(length))),
            37 => Ok(Some(Corner::TangentialEntry(length))),
            _ => Ok(Some(Corner::TangentialExit(length))),
        }
    }

    /// The words of a motion as the shared code has them.
    pub(super) fn motion_words(
        &self,
        words: &BlockWords,
        once: &OneShot,
    ) -> Result<MotionWords, Diagnostic> {
        let mut motion = MotionWords {
            radius: words.radius,
            ..MotionWords::default()
        };
        for (axis, word) in words.axes.iter().enumerate() {
            let Some(word) = word else {
                continue;
            };
            let letter = AXES[axis].chars().next().unwrap_or('X');
            let value = word.value.ok_or_else(|| missing(letter, word.span))?;
            motion.axes[axis] = Some(At {
                value: (value, Dimension::Modal),
                span: word.span,
            });
        }
        let dimension = match once.absolute_centre {
            Some(_) => Dimension::Absolute,
            None => Dimension::Modal,
        };
        motion.centre = words.centre.map(|word| {
            word.map(|word| At {
                value: (word.value, dimension),
                span: word.span,
            })
        });
        let [first, second, _] = self.control.modal.plane.axes();
        let given = [first, second].map(|axis| motion.centre[axis]);
        if let ([Some(word), None] | [None, Some(word)], true) =
            (given, once.absolute_centre.is_some())
        {
            return Err(Diagnostic::error(
                word.span,
                "an absolute centre (G6) needs both coordinates",
            )
            .help("write I and J"));
        }
        Ok(motion)
    }

    /// G53: in its block only, without tool length.
    fn machine_move(&mut self, words: &BlockWords, span: Span) -> Done {
        if words.first_axis().is_none() {
            return Err(Diagnostic::error(span, "G53 needs axes in its block")
                .help("it moves in coordinates of the machine; G54 to G57 choose a part zero"));
        }
        if self.thread.is_some() {
            return Err(Diagnostic::error(span, "G53 while G33 is in force")
                .help("write G0 or G1 in this block"));
        }
        let motion = self.motion_words(words, &OneShot::default())?;
        if self.control.modal.incremental {
            return Err(
                Diagnostic::error(span, "an increment in machine coordinates")
                    .help("write G90 in this block"),
            );
        }
        let factors = std::mem::replace(&mut self.control.modal.axis_factors, [1.0; 9]);
        let done = self
            .control
            .machine_move(&motion, span, false, words.feed.is_some());
        self.control.modal.axis_factors = factors;
        done
    }

    /// G92: not mirrored; what it would mean under a scale or a rotation is not said by the manual.
    fn preset(&mut self, words: &BlockWords, span: Span) -> Done {
        if self.transforms.rotates() || self.transforms.scales() {
            return Err(
                Diagnostic::error(span, "G92 while a scale or a rotation is in force")
                    .help("end them with G72 S1 and G73 before, and set them again after"),
            );
        }
        let motion = self.motion_words(words, &OneShot::default())?;
        self.control.preset(&motion, span)?;
        self.preset = true;
        Ok(())
    }
}

/// The time of a K in seconds. A fraction is that of a control whose K counts in seconds, where it is a
/// hundred times as long.
pub(super) fn seconds(hundredths: At<f64>) -> Result<f64, Diagnostic> {
    let At { value, span } = hundredths;
    if (value - value.round()).abs() > ROUNDING {
        return Err(Diagnostic::error(
            span,
            "the time K is no whole number: it is in hundredths of a second here",
        )
        .help("K150 is 1.5 seconds; where the program was made for a control with K in seconds, write a hundred times as much"));
    }
    Ok(value.round() / 100.0)
}

/// G53 and G92 take axes, and nothing that belongs to a path.
fn refuse_beside_axes(code: u32, words: &BlockWords, once: &OneShot) -> Done {
    let function = once.beside_axes().map(|g| g.span);
    match function.or(words.beside_axes()) {
        Some(other) => Err(Diagnostic::error(
            other,
            format!("this does not belong beside G{code}, which takes axes only"),
        )
        .help("put it into the block of a motion")),
        None => Ok(()),
    }
}
