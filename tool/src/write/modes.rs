//! What holds until the program changes it, as far as the backends have to know.

use crate::program::moves::Move;
use crate::program::{Action, Compensation, FeedMode, PathControl, Plane};

/// The modes in force.
pub struct Modes {
    pub plane: Plane,
    pub path_control: PathControl,
    /// Cutter compensation, as the program has it.
    pub compensation: Compensation,
    pub feed_mode: FeedMode,
    /// F as it was programmed in this feed mode.
    pub feed: Option<f64>,
    /// F as it was written last in this feed mode.
    pub written_feed: Option<f64>,
    /// Whether the length of the tool counts, where the program has said so.
    pub tool_length: Option<bool>,
    /// Whether the length that counts is that of the tool in the spindle.
    pub length_of_spindle: bool,
    /// T as it was named last, and the tool that M6 has put into the spindle, as far as the program has named it.
    named_tool: Option<u32>,
    tool_in_spindle: Option<u32>,
    /// Row of the tool table that G41 and G42 take the radius from, if it is not that of the tool in the
    /// spindle.
    pub radius_row: Option<u32>,
    /// The diameter for G41.1 and G42.1, instead of that of the tool.
    pub cutter_diameter: Option<f64>,
}

/// The exact stop of one motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// G61.1 for this motion alone.
    Mode,
    /// A dwell of no time behind it: LinuxCNC waits until the machine rests. Under cutter compensation it
    /// cannot change the mode.
    Dwell,
}

impl Modes {
    /// Where a program begins. `path_control`: how corners are passed until it says otherwise.
    pub fn new(path_control: PathControl) -> Modes {
        Modes {
            plane: Plane::Xy,
            path_control,
            compensation: Compensation::Off,
            feed_mode: FeedMode::PerMinute,
            feed: None,
            written_feed: None,
            tool_length: None,
            length_of_spindle: true,
            named_tool: None,
            tool_in_spindle: None,
            radius_row: None,
            cutter_diameter: None,
        }
    }

    /// How a motion comes to rest that does not by the mode in force; `None` where nothing is to be done.
    pub fn stop(&self, motion: &Move) -> Option<Stop> {
        match self.compensation {
            _ if !motion.exact_stop || self.path_control == PathControl::ExactStop => None,
            Compensation::Off => Some(Stop::Mode),
            Compensation::Left | Compensation::Right => Some(Stop::Dwell),
        }
    }

    /// What an action changes. Feeds are left to the backend: what is written depends on the frame.
    pub fn follow(&mut self, action: &Action) {
        match action {
            Action::Plane(plane) => self.plane = *plane,
            Action::PathControl(control) => self.path_control = *control,
            Action::Compensation(compensation) => self.compensation = *compensation,
            Action::FeedMode(mode) => {
                self.feed_mode = *mode;
                self.feed = None;
                self.written_feed = None;
            }
            Action::ToolLength(on) => {
                self.tool_length = Some(*on);
                self.length_of_spindle = true;
                self.radius_row = None;
                self.cutter_diameter = None;
            }
            Action::ToolOffset(row) => {
                self.tool_length = Some(true);
                self.length_of_spindle = self.tool_in_spindle == Some(*row);
                self.radius_row = Some(*row);
                self.cutter_diameter = None;
            }
            Action::CutterDiameter(diameter) => self.cutter_diameter = *diameter,
            Action::RadiusRow(row) => self.radius_row = *row,
            Action::Tool(tool) => self.named_tool = Some(*tool),
            Action::ToolChange => {
                // The length of the tool before stays in force until G43 or G49.
                self.tool_in_spindle = self.named_tool;
                self.length_of_spindle = false;
                self.radius_row = None;
                self.cutter_diameter = None;
            }
            _ => {}
        }
    }
}
