//! The backend for any machine: the frame is worked into the coordinates, and LinuxCNC gets an
//! ordinary program.
//!
//! Arcs stay arcs where the frame keeps circles of their plane; a mirror exchanges G2 with G3 and G41
//! with G42. Under unequal scales an arc becomes chords. A frame that tilts the plane would need
//! tilted arcs and a tilted tool length: that is for the frame kinematics.

use super::blocks::{begin, end};
use super::contour_start::Onto;
use super::line::{Lines, Rank};
use super::machine_move::add_machine_move;
use super::modes::{Modes, Stop};
use super::number::{coordinate, push_coordinate};
use super::turns::{Apart, whole_turns};
use super::words::{
    STOPPING_DWELL, centre_words, common_action, compensation_words, path_control_words,
    push_axis_words, push_spindle_motion, scaled_thread,
};
use super::{WriteSettings, Writer};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::program::contour_start::ContourStart;
use crate::program::frame::Frame;
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::program::position::apply_partly;
use crate::program::trace::frame_arc;
use crate::program::{Action, Block, Compensation, FeedMode, FrameScope, Plane};
use crate::source::{Sources, Span};
use framepath::frame::Handedness;
use nalgebra::Vector3;
use std::io;
use std::slice::from_ref;

/// How many chords one arc may become.
const CHORD_LIMIT: f64 = 10_000.0;

/// Entries of the map that are smaller, relative to the largest, are rounding.
const NOTHING: f64 = 1e-14;

/// Writes a program with its frames worked into the coordinates.
pub struct RewriteWriter<'a> {
    settings: WriteSettings<'a>,
    diagnostics: Diagnostics,
    lines: Lines<'a>,
    frame: Frame,
    modes: Modes,
    scope: FrameScope,
    /// How the next motion leads onto a contour, if not as it was programmed.
    onto: Option<Onto>,
}

impl<'a> RewriteWriter<'a> {
    /// A writer to `out`.
    pub fn new(settings: &WriteSettings<'a>, out: &'a mut dyn io::Write) -> RewriteWriter<'a> {
        RewriteWriter {
            settings: *settings,
            diagnostics: Diagnostics::default(),
            lines: Lines::new(out),
            frame: Frame::default(),
            modes: Modes::new(settings.path_mode),
            scope: FrameScope::default(),
            onto: None,
        }
    }
}

impl Writer for RewriteWriter<'_> {
    fn block(&mut self, block: &Block, scope: FrameScope, sources: &Sources) {
        self.scope = scope;
        if !begin(&mut self.lines, block, sources) {
            return;
        }
        for action in &block.actions {
            if let Err(diagnostic) = self.action(action, block.origin.span) {
                self.diagnostics.push(diagnostic);
            }
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

impl RewriteWriter<'_> {
    fn action(&mut self, action: &Action, span: Span) -> Result<(), Diagnostic> {
        self.modes.follow(action);
        if common_action(action, &mut self.lines) {
            return Ok(());
        }
        match action {
            Action::Feed(feed) => {
                self.modes.feed = Some(*feed);
                // Under factors for the finished path the number depends on the move.
                if !self.frame.has_stretch() {
                    self.write_feed(*feed);
                }
            }
            Action::Compensation(compensation) => self.set_compensation(*compensation, span)?,
            Action::Frame(command) => {
                // The interpreter has carried out the same command: it cannot fail here.
                if let Ok(frame) = self.frame.after(*command) {
                    self.frame = frame;
                }
                self.check_tilt(span)?;
            }
            Action::ContourStart(start) => self.contour_start(start, span)?,
            Action::Move(motion) => self.motion(motion, span)?,
            Action::ToolNormal => {
                return Err(
                    Diagnostic::error(span, "the tool is set normal to a turned plane")
                        .help("use --backend kinematics on a machine with the frame kinematics"),
                );
            }
            Action::RotaryZero => self.rotary_zero(),
            Action::Retract(place) => self
                .lines
                .add(Rank::Motion, format!("G53 G0 Z{}", coordinate(*place))),
            Action::End { rewind } => {
                end(&mut self.lines, *rewind, self.settings.diameters_before);
            }
            _ => {}
        }
        Ok(())
    }

    /// Turns those rotary axes to zero of the machine that are not there: which ones the machine has, is
    /// not known, and one that it does not have is at zero.
    fn rotary_zero(&mut self) {
        self.lines.flush();
        for (axis, letter) in ["A", "B", "C"].into_iter().enumerate() {
            let label = self.lines.condition();
            // In coordinates of the program, and what work offset, G92 and tool offset add to them.
            let [position, offset, preset, tool] = [5423, 5204, 5214, 5404].map(|row| row + axis);
            let place = format!("#{position}+#[{offset}+20*#5220]+#5210*#{preset}+#{tool}");
            self.lines
                .line(&format!("o{label} if [ABS[{place}] GT 0.000001]"));
            self.lines.line(&format!("G53 G0 {letter}0"));
            self.lines.line(&format!("o{label} endif"));
        }
    }

    fn check_tilt(&self, span: Span) -> Result<(), Diagnostic> {
        if self.scope == FrameScope::Block || self.frame.map().keeps_plane(Plane::Xy.into()) {
            return Ok(());
        }
        Err(Diagnostic::error(span, "this frame tilts the tool axis")
            .help("use --backend kinematics on a machine with the frame kinematics"))
    }

    fn mirrors_plane(&self) -> bool {
        self.frame
            .map()
            .handedness_in_plane(self.modes.plane.into())
            == Some(Handedness::Left)
    }

    fn write_feed(&mut self, feed: f64) {
        self.lines.add_with(Rank::Feed, |line| {
            line.push('F');
            push_coordinate(line, feed);
        });
        self.modes.written_feed = Some(feed);
    }

    /// Writes the feed of a move whose path the frame stretches together with its feed, or that of the
    /// first move that it no longer stretches.
    fn stretched_feed(&mut self, motion: &Move, span: Span) -> Result<(), Diagnostic> {
        let mut delta = Vector3::zeros();
        let kinds = [0, 1, 2].map(|axis| (motion.target[axis], motion.start[axis]));
        for (delta, kind) in delta.iter_mut().zip(kinds) {
            *delta = match kind {
                (Coordinate::Keep, _) => 0.0,
                (Coordinate::By(step), _) => step,
                (Coordinate::At(end), Some(start)) => end - start,
                (Coordinate::At(_), None) if self.frame.has_stretch() => {
                    return Err(Diagnostic::error(
                        span,
                        "the feed is scaled along this move, and its start is not known ahead \
                             of time",
                    )
                    .help("program all axes with G0 before it"));
                }
                (Coordinate::At(_), None) => 0.0,
            };
        }
        self.feed_along(&delta);
        Ok(())
    }

    /// Writes the feed for a move along `delta` of the frame if it is another one than that in force.
    fn feed_along(&mut self, delta: &Vector3<f64>) {
        let Some(feed) = self
            .modes
            .feed
            .filter(|_| self.modes.feed_mode != FeedMode::InverseTime)
        else {
            return;
        };
        let block = self.frame.block_map().apply_to_vector(delta).norm();
        let wanted = match self.frame.has_stretch() && block > 0.0 {
            true => feed * self.frame.map().apply_to_vector(delta).norm() / block,
            false => feed,
        };
        let same = |written: f64| (written - wanted).abs() <= 1e-9 * wanted;
        if !self.modes.written_feed.is_some_and(same) {
            self.write_feed(wanted);
        }
    }

    fn set_compensation(
        &mut self,
        compensation: Compensation,
        span: Span,
    ) -> Result<(), Diagnostic> {
        if compensation != Compensation::Off && self.frame.has_stretch() {
            return Err(Diagnostic::error(
                span,
                "factors for the finished path act after cutter compensation",
            )
            .help("use --backend kinematics on a machine with the frame kinematics"));
        }
        if compensation != Compensation::Off
            && !self.frame.map().keeps_plane(self.modes.plane.into())
        {
            return Err(Diagnostic::error(
                span,
                "cutter compensation in a plane that the frame tilts",
            )
            .help("use --backend kinematics on a machine with the frame kinematics"));
        }
        let written = match (compensation, self.mirrors_plane()) {
            (Compensation::Left, true) => Compensation::Right,
            (Compensation::Right, true) => Compensation::Left,
            (other, _) => other,
        };
        self.lines
            .add(Rank::Compensation, compensation_words(written, &self.modes));
        Ok(())
    }

    fn contour_start(&mut self, start: &ContourStart, span: Span) -> Result<(), Diagnostic> {
        let left = start.left != self.mirrors_plane();
        let plane = self.modes.plane;
        let start = start.seen_from(self.frame.map(), plane, left);
        self.onto = Some(Onto::begin(&start, plane, &mut self.lines, span)?);
        Ok(())
    }

    fn motion(&mut self, motion: &Move, span: Span) -> Result<(), Diagnostic> {
        if add_machine_move(&mut self.lines, motion, &self.modes) {
            return Ok(());
        }
        if motion.kind == MoveKind::Line {
            self.stretched_feed(motion, span)?;
        }
        let stop = self.modes.stop(motion);
        if stop == Some(Stop::Mode) {
            self.lines.add(Rank::PathControl, "G61.1");
        }
        let apart = self.apart(motion, stop, span)?;
        for part in apart.as_ref().map_or(from_ref(motion), |parts| parts) {
            self.shape(part, span)?;
        }
        let behind = match stop {
            None => return Ok(()),
            Some(Stop::Mode) => path_control_words(self.modes.path_control),
            Some(Stop::Dwell) => STOPPING_DWELL.to_string(),
        };
        self.lines.flush();
        self.lines.line(&behind);
        Ok(())
    }

    fn shape(&mut self, motion: &Move, span: Span) -> Result<(), Diagnostic> {
        match &motion.kind {
            MoveKind::Arc(arc) => self.arc(arc, motion, span)?,
            kind if motion.follows_spindle() => {
                if self.frame.has_scale() || self.frame.has_stretch() {
                    return Err(scaled_thread(span));
                }
                let targets = self.targets(motion, span)?;
                // LinuxCNC takes no other word that concerns the feed beside it.
                self.lines.flush();
                self.lines.add_with(Rank::Motion, |line| {
                    push_spindle_motion(line, kind, &targets);
                });
            }
            kind => {
                let code = if *kind == MoveKind::Rapid { "G0" } else { "G1" };
                let targets = self.targets(motion, span)?;
                self.add_motion(code, &targets, "");
            }
        }
        Ok(())
    }

    /// See [`whole_turns`]; an arc that becomes chords has all its turns.
    fn apart(&self, motion: &Move, stop: Option<Stop>, span: Span) -> Result<Apart, Diagnostic> {
        let map = self.frame.map();
        match map.is_similarity_of_plane(self.modes.plane.into()) {
            Some(scale) if stop != Some(Stop::Mode) => {
                whole_turns(motion, &self.modes, (self.modes.path_control, scale), span)
            }
            _ => Ok(None),
        }
    }

    /// Where each axis goes in coordinates of the work offset.
    fn targets(&self, motion: &Move, span: Span) -> Result<[Coordinate; 9], Diagnostic> {
        let mut targets = motion.target;
        if !self.frame.is_empty() {
            let linear = self.work_targets(motion, span)?;
            targets[..3].copy_from_slice(&linear);
        }
        Ok(targets)
    }

    /// Adds a motion; `centre`: the words of an arc.
    fn add_motion(&mut self, code: &str, targets: &[Coordinate; 9], centre: &str) {
        let onto = self.onto.take();
        self.lines.add_with(Rank::Motion, |line| {
            line.push_str(code);
            match &onto {
                Some(onto) => onto.push_axis_words(line, targets),
                None => push_axis_words(line, targets),
            }
            if !centre.is_empty() {
                line.push(' ');
                line.push_str(centre);
            }
        });
        if let Some(onto) = onto {
            onto.end(code, &mut self.lines);
        }
    }

    fn work_targets(&self, motion: &Move, span: Span) -> Result<[Coordinate; 3], Diagnostic> {
        let map = self.frame.map();
        let ends = [0, 1, 2].map(|axis| motion.reached(axis));
        let end = apply_partly(map, ends);
        let largest = map.linear().amax();
        let mut targets = [Coordinate::Keep; 3];
        for (row, target) in targets.iter_mut().enumerate() {
            let moving = (0..3).filter(|&column| {
                motion.target[column] != Coordinate::Keep
                    && map.linear()[(row, column)].abs() > NOTHING * largest
            });
            let moving: Vec<usize> = moving.collect();
            if moving.is_empty() {
                continue;
            }
            let steps: Option<f64> = moving
                .iter()
                .map(|&column| {
                    match (motion.target[column], motion.start[column]) {
                        (Coordinate::By(step), _) => Some(step),
                        (Coordinate::At(end), Some(start)) => Some(end - start),
                        _ => None,
                    }
                    .map(|step| step * map.linear()[(row, column)])
                })
                .sum();
            *target = match (end[row], steps) {
                (Some(end), _) => Coordinate::At(end),
                (None, Some(step)) => Coordinate::By(step),
                (None, None) => {
                    let unknown = (0..3)
                        .find(|&column| motion.end(column).is_none())
                        .map_or("an axis", |column| super::words::LETTERS[column]);
                    return Err(Diagnostic::error(
                        span,
                        format!("where {unknown} is in this frame is not known ahead of time"),
                    )
                    .help(
                        "program all axes that the frame turns into each other in the first \
                             block after a change of frame, tool or work offset",
                    ));
                }
            };
        }
        Ok(targets)
    }

    fn arc(&mut self, arc: &Arc, motion: &Move, span: Span) -> Result<(), Diagnostic> {
        let map = self.frame.map();
        if !map.keeps_plane(self.modes.plane.into()) {
            return Err(
                Diagnostic::error(span, "an arc in a plane that the frame tilts")
                    .help("use --backend kinematics on a machine with the frame kinematics"),
            );
        }
        let Some(scale) = map.is_similarity_of_plane(self.modes.plane.into()) else {
            return self.chords(arc, motion, span);
        };
        let [first, second, _] = self.modes.plane.axes();
        let (map, plane) = (*map, self.modes.plane);
        let turned = |a: f64, b: f64| {
            let image = map.apply_to_vector(&plane.vector([a, b]));
            [image[first], image[second]]
        };
        self.feed_along(&self.modes.plane.vector([1.0, 0.0]));
        let centre = match arc.centre {
            Centre::Offset([a, b]) => Centre::Offset(turned(a, b)),
            Centre::Radius(radius) => Centre::Radius(radius * scale),
            Centre::Point(point) if self.frame.is_empty() => Centre::Point(point),
            Centre::Point(_) => {
                return Err(Diagnostic::error(span, "an absolute centre, and the start of this arc is not known ahead of time")
                        .help("program the start of the arc in a block of its own, or give I, J, K from the start"));
            }
        };
        let clockwise = arc.clockwise != self.mirrors_plane();
        let targets = self.targets(motion, span)?;
        let centre = centre_words(centre, arc.extra_turns, self.modes.plane);
        self.add_motion(if clockwise { "G2" } else { "G3" }, &targets, &centre);
        Ok(())
    }

    /// An arc that the frame makes an ellipse.
    fn chords(&mut self, arc: &Arc, motion: &Move, span: Span) -> Result<(), Diagnostic> {
        if self.modes.compensation != Compensation::Off {
            return Err(Diagnostic::error(
                span,
                "an arc under unequal scales with cutter compensation",
            )
            .help("use equal factors for the axes of the plane, or program the tool centre"));
        }
        if self.modes.feed_mode == FeedMode::InverseTime {
            return Err(Diagnostic::error(
                span,
                "an arc under unequal scales with feed in inverse time",
            )
            .help("use G94"));
        }
        if motion.target[3..]
            .iter()
            .any(|target| *target != Coordinate::Keep)
        {
            return Err(Diagnostic::error(
                span,
                "an arc under unequal scales together with further axes",
            ));
        }
        let known = |value: [Option<f64>; 3]| match value {
            [Some(x), Some(y), Some(z)] => Some(Vector3::new(x, y, z)),
            _ => None,
        };
        let start = known([0, 1, 2].map(|axis| motion.start[axis]));
        let end = known([0, 1, 2].map(|axis| motion.end(axis)));
        let (Some(start), Some(end)) = (start, end) else {
            return Err(Diagnostic::error(
                span,
                "an arc under unequal scales, and its start is not known ahead of time",
            )
            .help("program X, Y and Z before the arc"));
        };
        let shape = frame_arc(
            arc,
            start,
            end,
            self.modes.plane,
            self.settings.arc_tolerance,
        )
        .map_err(|_| Diagnostic::error(span, "this arc has no centre"))?;
        let map = *self.frame.map();
        // A chord over the angle a is off the ellipse by at most (1 - cos(a / 2)) times the larger
        // half axis, which is no longer than the longer of these two conjugate radii times sqrt 2.
        let radius = std::f64::consts::SQRT_2
            * map
                .apply_to_vector(&shape.u)
                .norm()
                .max(map.apply_to_vector(&shape.v).norm());
        let off = (self.settings.chord_tolerance / radius).min(1.0);
        let count = (shape.sweep / (2.0 * (1.0 - off).acos())).ceil().max(1.0);
        if count > CHORD_LIMIT {
            return Err(Diagnostic::error(
                span,
                format!("this arc would need more than {CHORD_LIMIT} chords"),
            )
            .help("give a larger --chord-tolerance"));
        }
        for index in 1..=count as u32 {
            let point = map.apply(&shape.point(f64::from(index) / count));
            let mut targets = motion.target;
            for axis in 0..3 {
                targets[axis] = Coordinate::At(point[axis]);
            }
            let before = shape.point(f64::from(index - 1) / count);
            self.feed_along(&(shape.point(f64::from(index) / count) - before));
            self.add_motion("G1", &targets, "");
        }
        Ok(())
    }
}
