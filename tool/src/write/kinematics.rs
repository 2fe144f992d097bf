//! The backend for machines with the frame kinematics: the moves stay as they were programmed, and
//! each frame command becomes the call of a subroutine that sets the kinematics.
//!
//! The subroutines wait for the motion to end, set the frame, and make the interpreter read its
//! position again. So that nothing depends on what was read, the first move after a change names
//! every coordinate that is known.
//!
//! The kinematics takes the work offset and the tool offset into its map when the frame is set.
//! The frame is therefore taken off before either changes, and before motions in machine
//! coordinates, and set again before the next move that needs it.

use super::blocks::{begin, end};
use super::contour_start::Onto;
use super::line::{Lines, Rank};
use super::machine_move::add_machine_move;
use super::modes::{Modes, Stop};
use super::number::{coordinate, factor, push_coordinate};
use super::tolerance::PathScale;
use super::turns::whole_turns;
use super::words::{
    STOPPING_DWELL, centre_words, common_action, compensation_words, path_control_words,
    push_axis_words, push_spindle_motion, scaled_thread,
};
use super::{SAME_SIZE, WriteSettings, Writer};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::program::frame::{Frame, FrameCommand, FrameOperation, SolidAngles};
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::{Action, Block, Compensation, FeedMode, FrameScope, PathControl, Plane};
use crate::source::{Sources, Span};
use framepath::frame::AffineMap;
use framepath::frame::singular_values::singular_values;
use nalgebra::Vector3;
use std::io;
use std::slice::from_ref;

/// Writes a program for the frame kinematics.
pub struct KinematicsWriter<'a> {
    diagnostics: Diagnostics,
    lines: Lines<'a>,
    /// See [`WriteSettings::diameters_before`].
    diameters_before: bool,
    frame: Frame,
    modes: Modes,
    /// By how much the frame stretches what corners are cut by.
    path_scale: PathScale,
    /// Whether the frame is taken off for the time being.
    suspended: bool,
    /// Which of X Y Z must be named in the next move.
    explicit: [bool; 3],
    scope: FrameScope,
    /// Whether the length of the tool has changed since the kinematics was told.
    length_changed: bool,
    /// How the next motion leads onto a contour, if not as it was programmed.
    onto: Option<Onto>,
}

impl<'a> KinematicsWriter<'a> {
    /// A writer to `out`.
    pub fn new(settings: &WriteSettings, out: &'a mut dyn io::Write) -> KinematicsWriter<'a> {
        let mut lines = Lines::new(out);
        // A program that was aborted may have left its frame.
        lines.raw("o<frame_off> call");
        KinematicsWriter {
            diagnostics: Diagnostics::default(),
            lines,
            diameters_before: settings.diameters_before,
            frame: Frame::default(),
            modes: Modes::new(settings.path_mode),
            path_scale: PathScale::new(),
            suspended: false,
            explicit: [false; 3],
            scope: FrameScope::default(),
            length_changed: false,
            onto: None,
        }
    }
}

impl Writer for KinematicsWriter<'_> {
    fn block(&mut self, block: &Block, scope: FrameScope, sources: &Sources) {
        self.scope = scope;
        if !begin(&mut self.lines, block, sources) {
            return;
        }
        if block.actions.iter().any(needs_no_frame) {
            self.suspend();
        }
        for action in &block.actions {
            self.action(action, block.origin.span);
        }
        self.lines.end_block();
    }

    fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    fn finish(self: Box<Self>) -> io::Result<Diagnostics> {
        self.lines.finish()?;
        Ok(self.diagnostics)
    }
}

impl KinematicsWriter<'_> {
    fn action(&mut self, action: &Action, span: Span) {
        self.modes.follow(action);
        self.length_changed |= matches!(
            action,
            Action::ToolLength(_) | Action::ToolOffset(_) | Action::ToolChange
        );
        let common = match action {
            Action::PathControl(_) => &Action::PathControl(self.written_path_control()),
            other => other,
        };
        if common_action(common, &mut self.lines) {
            return;
        }
        match action {
            Action::Feed(feed) => self.set_feed(*feed),
            Action::Compensation(compensation) => self.compensation(*compensation, span),
            Action::Frame(command) => self.frame_command(*command, span),
            Action::ContourStart(start) => {
                match Onto::begin(start, self.modes.plane, &mut self.lines, span) {
                    Ok(onto) => self.onto = Some(onto),
                    Err(diagnostic) => self.diagnostics.push(diagnostic),
                }
            }
            Action::Move(motion) => self.motion(motion, span),
            Action::ToolNormal => {
                self.resume();
                self.lines.flush();
                self.lines.line("o<tool_normal> call");
                self.explicit = [true; 3];
            }
            Action::RotaryZero => {
                self.suspend();
                self.tell_length();
                self.lines.flush();
                self.lines.line("o<rotary_zero> call");
                self.explicit = [true; 3];
            }
            Action::Retract(place) => {
                // The tool stands normal to the frame that is in force.
                self.resume();
                self.tell_length();
                self.lines.flush();
                let place = coordinate(*place);
                self.lines.line(&format!("o<retract> call [{place}]"));
                self.explicit = [true; 3];
            }
            Action::End { rewind } => {
                self.lines.flush();
                self.suspend();
                end(&mut self.lines, *rewind, self.diameters_before);
            }
            _ => {}
        }
    }

    /// Kinematics that turn a table hold the machine until they are told of another length of the tool.
    fn tell_length(&mut self) {
        // The frames of other scopes need no table.
        if std::mem::take(&mut self.length_changed) && self.scope == FrameScope::Machine {
            self.lines.flush();
            self.lines.line("o<frame_refresh> call");
        }
    }

    /// How corners are passed, with the tolerance in coordinates of the program, as it is now written.
    fn written_path_control(&mut self) -> PathControl {
        let frame_is_off = self.frame_is_off();
        self.path_scale
            .in_frame(self.modes.path_control, frame_is_off)
    }

    /// Writes the tolerance again where the one that is in force belongs to another scale.
    fn renew_tolerance(&mut self) {
        let rounds = matches!(self.modes.path_control, PathControl::Continuous { .. });
        if rounds && self.path_scale.has_changed(self.frame_is_off()) {
            self.lines.flush();
            let control = self.written_path_control();
            self.lines.raw(&path_control_words(control));
        }
    }

    fn frame_is_off(&self) -> bool {
        self.suspended || self.frame.is_empty()
    }

    fn set_feed(&mut self, feed: f64) {
        self.modes.feed = Some(feed);
        // Under a scale the number depends on the move: it is written there.
        if self.modes.feed_mode == FeedMode::InverseTime || !self.frame.has_scale() {
            self.lines.add(Rank::Feed, format!("F{}", coordinate(feed)));
            self.modes.written_feed = Some(feed);
        }
    }

    fn compensation(&mut self, compensation: Compensation, span: Span) {
        if compensation != Compensation::Off {
            if self.frame.has_scale() {
                self.diagnostics.push(
                    Diagnostic::error(
                        span,
                        "cutter compensation under SCALE: the kinematics would scale the offset too",
                    )
                    .help("use --backend program, which scales the contour only"),
                );
            }
            self.resume();
        }
        self.lines.add(
            Rank::Compensation,
            compensation_words(compensation, &self.modes),
        );
    }

    fn frame_command(&mut self, command: FrameCommand, span: Span) {
        let Ok(frame) = self.frame.after(command) else {
            self.diagnostics
                .push(Diagnostic::error(span, "too many frame commands"));
            return;
        };
        match command {
            FrameCommand::Additive(_) | FrameCommand::DropScales => self.resume(),
            FrameCommand::Cancel | FrameCommand::Absolute(_) => self.suspended = false,
        }
        if self.scope == FrameScope::Block && !frame.map().keeps_plane(Plane::Xy.into()) {
            self.diagnostics.push(
                Diagnostic::error(span, "the kinematics would tilt the tool with this frame")
                    .help("use --backend program, which turns the coordinates only"),
            );
        }
        self.lines.flush();
        self.frame = frame;
        self.length_changed = false;
        self.explicit = [true; 3];
        let call = match command {
            FrameCommand::Cancel => "o<frame_off> call".to_string(),
            FrameCommand::DropScales => "o<ascale_off> call".to_string(),
            FrameCommand::Absolute(operation) => call(&operation, false, self.modes.plane),
            FrameCommand::Additive(operation) => call(&operation, true, self.modes.plane),
        };
        self.lines.line(&call);
        self.path_scale.set_frame(&self.frame);
        self.renew_tolerance();
    }

    /// Takes the frame off until it is needed again.
    fn suspend(&mut self) {
        if self.frame_is_off() {
            return;
        }
        self.lines.flush();
        self.lines.line("o<frame_off> call");
        self.suspended = true;
        self.renew_tolerance();
    }

    /// Sets the frame again as it was.
    fn resume(&mut self) {
        if !self.suspended {
            return;
        }
        self.suspended = false;
        self.length_changed = false;
        self.explicit = [true; 3];
        self.lines.flush();
        for (index, operation) in self.frame.operations().iter().enumerate() {
            // The plane may be another one by now: rotations are written about their axis.
            let operation = match operation {
                FrameOperation::RotateInPlane(plane, angle) => about_normal(*plane, *angle),
                other => *other,
            };
            self.lines
                .raw(&call(&operation, index > 0, self.modes.plane));
        }
        self.renew_tolerance();
    }

    fn motion(&mut self, motion: &Move, span: Span) {
        if matches!(motion.kind, MoveKind::Machine { .. }) {
            self.tell_length();
            add_machine_move(&mut self.lines, motion, &self.modes);
            return;
        }
        self.resume();
        self.tell_length();
        self.path_scale.follow(motion);
        self.renew_tolerance();
        let stop = self.modes.stop(motion);
        if stop == Some(Stop::Mode) {
            self.lines.add(Rank::PathControl, "G61.1");
        }
        let control = match stop {
            Some(Stop::Mode) => PathControl::ExactStop,
            _ => self.written_path_control(),
        };
        match whole_turns(motion, &self.modes, (control, 1.0), span) {
            Ok(parts) => {
                for part in parts.as_ref().map_or(from_ref(motion), |parts| parts) {
                    self.add_motion(part, span);
                }
            }
            Err(diagnostic) => self.diagnostics.push(diagnostic),
        }
        let behind = match stop {
            None => return,
            Some(Stop::Mode) => path_control_words(self.written_path_control()),
            Some(Stop::Dwell) => STOPPING_DWELL.to_string(),
        };
        self.lines.flush();
        self.lines.line(&behind);
    }

    /// The words of a motion, with its feed.
    fn add_motion(&mut self, motion: &Move, span: Span) {
        let mut targets = motion.target;
        for (axis, target) in targets.iter_mut().enumerate() {
            *target = self.written_target(motion, axis);
        }
        let feed = match motion.kind {
            MoveKind::Line | MoveKind::Arc(_) => self.feed_for(motion),
            _ => None,
        };
        let plane = self.modes.plane;
        if motion.follows_spindle() {
            if self.frame.has_scale() || self.frame.has_stretch() {
                self.diagnostics.push(scaled_thread(span));
            }
            // LinuxCNC takes no other word that concerns the feed beside it.
            self.lines.flush();
        }
        let code = match &motion.kind {
            MoveKind::Rapid | MoveKind::Machine { .. } => "G0",
            MoveKind::Line | MoveKind::Thread { .. } | MoveKind::Tap { .. } => "G1",
            MoveKind::Arc(arc) if arc.clockwise => "G2",
            MoveKind::Arc(_) => "G3",
        };
        let onto = self.onto.take();
        self.lines.add_with(Rank::Motion, |line| {
            if push_spindle_motion(line, &motion.kind, &targets) {
                return;
            }
            line.push_str(code);
            match &onto {
                Some(onto) => onto.push_axis_words(line, &targets),
                None => push_axis_words(line, &targets),
            }
            if let MoveKind::Arc(arc) = &motion.kind {
                line.push(' ');
                line.push_str(&centre_words(arc.centre, arc.extra_turns, plane));
            }
            if let Some(feed) = feed {
                line.push_str(" F");
                push_coordinate(line, feed);
            }
        });
        if let Some(onto) = onto {
            onto.end(code, &mut self.lines);
        }
    }

    /// The target of an axis with coordinates that the program left out and that must be explicit.
    fn written_target(&mut self, motion: &Move, axis: usize) -> Coordinate {
        let target = motion.target[axis];
        let in_plane = self.modes.plane.axes()[..2].contains(&axis);
        let is_arc = matches!(motion.kind, MoveKind::Arc(_));
        let wanted = match self.explicit.get_mut(axis) {
            // A third coordinate would make a helix of the arc.
            Some(explicit) if !is_arc || in_plane => std::mem::take(explicit) || is_arc,
            _ => false,
        };
        match (target, motion.start[axis]) {
            (Coordinate::Keep, Some(start)) if wanted => Coordinate::At(start),
            _ => target,
        }
    }

    /// The feed to be written with a move, if it differs from the last one. The kinematics stretches
    /// the move, so the feed in the frame is the programmed one divided by the stretch.
    fn feed_for(&mut self, motion: &Move) -> Option<f64> {
        if self.modes.feed_mode == FeedMode::InverseTime {
            return None;
        }
        let feed = match self.frame.has_scale() {
            true => self.modes.feed? / stretch(self.frame.block_map(), motion, self.modes.plane),
            false => self.modes.feed?,
        };
        let same = self
            .modes
            .written_feed
            .is_some_and(|old| (old - feed).abs() <= SAME_SIZE * feed);
        if same {
            return None;
        }
        self.modes.written_feed = Some(feed);
        Some(feed)
    }
}

/// Whether an action is only allowed, or only right, while no frame is set.
fn needs_no_frame(action: &Action) -> bool {
    match action {
        Action::ToolChange
        | Action::ToolLength(_)
        | Action::ToolOffset(_)
        | Action::WorkOffset(_)
        | Action::SystemValues(_)
        | Action::Preset(_)
        | Action::LocalOffset(_)
        | Action::PresetOff => true,
        Action::Move(motion) => matches!(motion.kind, MoveKind::Machine { .. }),
        _ => false,
    }
}

/// How much longer a move is on the machine than in the frame: of a line, or of an arc that stays one,
/// its own stretch; of other arcs, or where the start is not known, the largest of all directions, so
/// that the feed is never exceeded.
fn stretch(map: &AffineMap, motion: &Move, plane: Plane) -> f64 {
    let largest = singular_values(map.linear()).max();
    if matches!(motion.kind, MoveKind::Arc(_)) {
        let [_, _, normal] = plane.axes();
        let flat = motion.target[normal] == Coordinate::Keep;
        let similar = map.is_similarity_of_plane(plane.into()).filter(|_| flat);
        return similar.unwrap_or(largest);
    }
    let mut delta = Vector3::zeros();
    for axis in 0..3 {
        delta[axis] = match (motion.target[axis], motion.start[axis]) {
            (Coordinate::Keep, _) => 0.0,
            (Coordinate::By(step), _) => step,
            (Coordinate::At(end), Some(start)) => end - start,
            (Coordinate::At(_), None) => return largest,
        };
    }
    let length = delta.norm();
    if length == 0.0 {
        return 1.0;
    }
    map.apply_to_vector(&delta).norm() / length
}

fn about_normal(plane: Plane, angle: f64) -> FrameOperation {
    let [_, _, normal] = plane.axes();
    let mut angles = [0.0; 3];
    angles[normal] = angle;
    FrameOperation::Rotate(angles)
}

/// The call that sets one operation.
fn call(operation: &FrameOperation, additive: bool, plane: Plane) -> String {
    let (name, arguments): (&str, Vec<f64>) = match *operation {
        FrameOperation::Translate(shift) => ("trans", shift.to_vec()),
        FrameOperation::Rotate(angles) => ("rot", angles.to_vec()),
        FrameOperation::RotateInPlane(its_plane, angle) if its_plane == plane => {
            ("rot_rpl", vec![angle])
        }
        FrameOperation::RotateInPlane(its_plane, angle) => {
            return call(&about_normal(its_plane, angle), additive, plane);
        }
        FrameOperation::RotateBySolidAngles(which, angles) => (
            match which {
                SolidAngles::XThenY => "rots_xy",
                SolidAngles::ZThenX => "rots_zx",
                SolidAngles::YThenZ => "rots_yz",
            },
            angles.to_vec(),
        ),
        FrameOperation::Scale(factors) | FrameOperation::Stretch(factors) => {
            ("scale", factors.to_vec())
        }
        FrameOperation::Mirror(axes) => (
            "mirror",
            axes.map(|axis| f64::from(u8::from(axis))).to_vec(),
        ),
    };
    let arguments: Vec<String> = arguments
        .into_iter()
        .map(|value| format!("[{}]", factor(value)))
        .collect();
    let prefix = if additive { "a" } else { "" };
    format!("o<{prefix}{name}> call {}", arguments.join(" "))
}
