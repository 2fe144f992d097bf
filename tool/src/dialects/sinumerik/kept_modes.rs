//! What `PROC NAME SAVE` keeps: the modal G functions, the programmable frame and the work offset of before are in
//! force again where the program that called goes on. (Siemens, SINUMERIK 840D sl, Function Manual Basic
//! Functions, "Subprograms with SAVE attribute".)
//!
//! F, S, T, D, RNDM, ADIS and CTOL are no G functions, and the frame of CYCLE800 is one of the system: they stay as
//! the subprogram leaves them.

use super::arc_words::ArcForm;
use super::interpreter::Interpreter;
use super::programmed_offset::ProgrammedOffset;
use super::spindle::{Diameter, SpindleMotion};
use super::spindle_speed::SpeedMode;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::program::frame::FrameOperation;
use crate::program::{Compensation, FeedMode, PathControl, Plane};
use crate::source::Span;

/// The modes at a call.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KeptModes {
    motion: Option<Motion>,
    arc_form: Option<ArcForm>,
    spindle_motion: Option<SpindleMotion>,
    incremental: bool,
    /// Of lengths and of feeds.
    units: [f64; 2],
    plane: Plane,
    compensation: Compensation,
    path_control: PathControl,
    /// G641.
    by_distance: bool,
    feed_mode: FeedMode,
    speed_mode: SpeedMode,
    goes_round: bool,
    approach_side: Option<bool>,
    approach_flat: bool,
    diameter: Diameter,
    system: Option<u8>,
    frame: Vec<FrameOperation>,
    offset: ProgrammedOffset,
}

impl Interpreter<'_> {
    pub(super) fn keep_modes(&self) -> KeptModes {
        let modal = &self.control.modal;
        KeptModes {
            motion: modal.motion,
            arc_form: self.arc_form,
            spindle_motion: self.spindle_motion,
            incremental: modal.incremental,
            units: [modal.length_factor, modal.feed_factor],
            plane: modal.plane,
            compensation: modal.compensation,
            path_control: modal.path_control,
            by_distance: self.smoothing.by_distance,
            feed_mode: modal.feed_mode,
            speed_mode: self.speed.mode,
            goes_round: self.goes_round,
            approach_side: self.approach_side,
            approach_flat: self.approach_flat,
            diameter: self.diameter,
            system: self.system,
            frame: self.programmable_operations().to_vec(),
            offset: self.offset,
        }
    }

    /// Puts the modes of before in force; `span`: the call.
    pub(super) fn restore_modes(&mut self, kept: KeptModes, span: Span) -> Done {
        self.restore_silent_modes(&kept);
        let compensation = self.control.modal.compensation;
        let ends = compensation != Compensation::Off && kept.compensation == Compensation::Off;
        if ends {
            self.control.compensation(Compensation::Off, span)?;
        }
        if self.control.modal.plane != kept.plane {
            self.choose_plane(kept.plane, span)?;
        }
        self.restore_path_control(&kept, span)?;
        self.restore_work_offset(kept.system, span)?;
        self.control.apply_states(compensation != Compensation::Off);
        let mut operations = self.swivelled.clone();
        operations.extend(kept.frame);
        self.control.set_frame(&operations, span)?;
        self.offset = kept.offset;
        if self.control.modal.feed_mode != kept.feed_mode {
            self.control.feed_mode(kept.feed_mode);
        }
        let before = std::mem::replace(&mut self.speed.mode, kept.speed_mode);
        if before != kept.speed_mode {
            self.enter_speed_mode(before, span)?;
        }
        if self.control.modal.compensation != kept.compensation {
            let value = kept.compensation;
            self.control.switch_compensation(At { value, span })?;
            self.control.apply_states(compensation != Compensation::Off);
        }
        Ok(())
    }

    /// Those that only change what later words mean.
    fn restore_silent_modes(&mut self, kept: &KeptModes) {
        self.arc_form = kept.arc_form;
        self.spindle_motion = kept.spindle_motion;
        self.goes_round = kept.goes_round;
        self.approach_side = kept.approach_side;
        self.approach_flat = kept.approach_flat;
        self.diameter = kept.diameter;
        let modal = &mut self.control.modal;
        modal.motion = kept.motion;
        modal.incremental = kept.incremental;
        [modal.length_factor, modal.feed_factor] = kept.units;
    }

    fn restore_path_control(&mut self, kept: &KeptModes, span: Span) -> Done {
        let by_distance = std::mem::replace(&mut self.smoothing.by_distance, kept.by_distance);
        let rounds = |control: PathControl| matches!(control, PathControl::Continuous { .. });
        let now = self.control.modal.path_control;
        match (rounds(now), rounds(kept.path_control)) {
            (true, true) if by_distance == kept.by_distance => Ok(()),
            (_, true) => self.round_corners(span),
            (_, false) if now == kept.path_control => Ok(()),
            (_, false) => self.control.path_control(kept.path_control, span),
        }
    }

    fn restore_work_offset(&mut self, system: Option<u8>, span: Span) -> Done {
        match system {
            _ if self.system == system => Ok(()),
            Some(0) => self.suppress_offset(span),
            Some(system) => self.choose_offset(system, span),
            None => Err(Diagnostic::error(
                span,
                "this subprogram brings back the work offset of before (SAVE), and which one that is, is not \
                 known ahead of time",
            )
            .help("name it before the call: G54")),
        }
    }
}
