//! What stays in force from block to block.

use super::words::Dimension;
use crate::dialects::settings::Settings;
use crate::program::frame::Frame;
use crate::program::position::{Position, displaced_in};
use crate::program::{Compensation, FeedMode, PathControl, Plane, Spindle};
use crate::source::Span;

/// The motion that a block of axis words alone carries on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2.
    Clockwise,
    /// G3.
    Counterclockwise,
}

/// The state of the control while the program is evaluated.
#[derive(Clone, Debug)]
pub struct Modal {
    /// `None` until the program names one.
    pub motion: Option<Motion>,
    /// G91.
    pub incremental: bool,
    /// G17 to G19.
    pub plane: Plane,
    /// Lengths in the program times this are machine units.
    pub length_factor: f64,
    /// Feeds in the program times this are machine units.
    pub feed_factor: f64,
    /// G93 to G95.
    pub feed_mode: FeedMode,
    /// Whether a feed is in force.
    pub has_feed: bool,
    /// F as it was programmed last, in machine units; `None` before the first.
    pub feed: Option<f64>,
    /// S, revolutions per minute.
    pub spindle_speed: Option<f64>,
    /// Whether S of LinuxCNC is a cutting speed (G96).
    pub surface_speed: bool,
    /// Where a constant cutting speed ended without S, until one follows: the control goes on with the speed
    /// that it had there. The feed mode is the one that the end left in force.
    pub kept_speed: Option<(Span, FeedMode)>,
    /// M3 to M5.
    pub spindle: Option<Spindle>,
    /// How it turned when a tool change stopped it, until the program switches it.
    pub spindle_before_change: Option<Spindle>,
    /// Whether the operator's overrides act: M48 and M49 of the program.
    pub overrides: bool,
    /// G40 to G42.
    pub compensation: Compensation,
    /// How corners are passed.
    pub path_control: PathControl,
    /// The programmable frame.
    pub frame: Frame,
    /// Coordinates of A B C U V W times these are those that are written: a mirrored axis has -1. The
    /// entries of X Y Z are not used; their mirrors and scales are in the frame.
    pub axis_factors: [f64; 9],
    /// Where the axes are.
    pub position: Position,
    /// Of each axis that G92 has given a coordinate: how far G52 has shifted it since, machine units.
    pub preset: [Option<f64>; 9],
    /// The axes whose zero G52 has shifted, and not back.
    pub shifted: [bool; 9],
    /// Where G92 stands, while it is in force.
    pub preset_at: Option<Span>,
    /// The work offset that is in force with the values it was selected with, 1 to 9; `None` where that is not known.
    pub work_offset: Option<u8>,
    /// Coordinates from before the first change of the frame, an offset or the tool, for axes that have not
    /// moved since.
    pub carried: [Option<Option<f64>>; 9],
    /// Whether the length of the tool has changed since Z was programmed last, on a control that has a parameter
    /// for whether an increment in Z travels that change too.
    pub length_undecided: bool,
    /// The direction in which the last motion ended, along X Y Z of the frame, if that is known.
    pub tangent: Option<[f64; 3]>,
    /// Whether an increment after a change of the frame, an offset or the tool follows the setting. If not, it
    /// counts from where the tool is.
    pub follows_setting: bool,
}

impl Modal {
    /// As the control is after power on.
    pub fn new(settings: &Settings) -> Modal {
        let mut modal = Modal {
            motion: None,
            incremental: false,
            plane: Plane::Xy,
            length_factor: 1.0,
            feed_factor: 1.0,
            feed_mode: FeedMode::PerMinute,
            has_feed: false,
            feed: None,
            spindle_speed: None,
            surface_speed: false,
            kept_speed: None,
            spindle: None,
            spindle_before_change: None,
            overrides: true,
            compensation: Compensation::Off,
            path_control: settings.path_mode,
            frame: Frame::default(),
            axis_factors: [1.0; 9],
            position: Position::default(),
            preset: [None; 9],
            shifted: [false; 9],
            preset_at: None,
            work_offset: None,
            carried: [None; 9],
            length_undecided: false,
            tangent: None,
            follows_setting: false,
        };
        modal.use_inch(settings.machine_in_inch, true, settings);
        modal
    }

    /// The unit of lengths in the program, and where `feed_too` of feeds.
    pub fn use_inch(&mut self, inch: bool, feed_too: bool, settings: &Settings) {
        let factor = match (inch, settings.machine_in_inch) {
            (true, false) => 25.4,
            (false, true) => 1.0 / 25.4,
            _ => 1.0,
        };
        self.length_factor = factor;
        self.feed_factor = if feed_too { factor } else { 1.0 };
    }

    /// Whether a coordinate counts from where its axis is.
    pub fn is_incremental(&self, dimension: Dimension) -> bool {
        match dimension {
            Dimension::Modal => self.incremental,
            Dimension::Absolute => false,
            Dimension::Incremental => true,
        }
    }

    /// Nothing is known about the coordinates any more.
    pub fn forget_position(&mut self) {
        self.position.forget();
        self.carried = [None; 9];
        self.tangent = None;
        self.work_offset = None;
    }

    /// Work offset 1 to 9. That which is in force already moves nothing, unless G52 or G92 has shifted it.
    pub fn select_work_offset(&mut self, system: u8) {
        let shifted = self.preset_at.is_some() || self.shifted != [false; 9];
        if self.work_offset.replace(system) != Some(system) || shifted {
            self.change_offset([true; 9]);
        }
    }

    /// The tool or an offset changed, which moves these axes of the machine: where they are is not known any more.
    /// What was programmed last is, and increments that follow the setting may count from it.
    pub fn change_offset(&mut self, axes: [bool; 9]) {
        let changed = displaced_in(&self.frame, axes);
        for axis in (0..9).filter(|axis| changed[*axis]) {
            let programmed = self.position.get(axis).filter(|_| self.follows_setting);
            let carried = &mut self.carried[axis];
            *carried = carried.or(programmed.map(Some));
            self.position.set(axis, None);
        }
        self.tangent = None;
    }

    /// Another frame; the tool stays where it is.
    pub fn set_frame(&mut self, frame: Frame) {
        if self.follows_setting {
            for axis in 0..3 {
                let before = self.position.get(axis);
                self.carried[axis].get_or_insert(before);
            }
        }
        self.position.change_frame(&self.frame, &frame);
        self.tangent = None;
        self.frame = frame;
    }
}
