//! What holds until the program changes it, as far as the backends have to know.

use crate::program::{Action, FeedMode, PathControl, Plane};

/// The modes in force.
pub struct Modes {
    pub plane: Plane,
    pub path_control: PathControl,
    pub feed_mode: FeedMode,
    /// F as it was programmed in this feed mode.
    pub feed: Option<f64>,
    /// F as it was written last in this feed mode.
    pub written_feed: Option<f64>,
    /// Whether the length of the tool counts, where the program has said so.
    pub tool_length: Option<bool>,
    /// Row of the tool table that G41 and G42 take the radius from, if it is not that of the tool in the
    /// spindle.
    pub radius_row: Option<u32>,
    /// The diameter for G41.1 and G42.1, instead of that of the tool.
    pub cutter_diameter: Option<f64>,
}

impl Modes {
    /// Where a program begins. `path_control`: how corners are passed until it says otherwise.
    pub fn new(path_control: PathControl) -> Modes {
        Modes {
            plane: Plane::Xy,
            path_control,
            feed_mode: FeedMode::PerMinute,
            feed: None,
            written_feed: None,
            tool_length: None,
            radius_row: None,
            cutter_diameter: None,
        }
    }

    /// What an action changes. Feeds are left to the backend: what is written depends on the frame.
    pub fn follow(&mut self, action: &Action) {
        match action {
            Action::Plane(plane) => self.plane = *plane,
            Action::PathControl(control) => self.path_control = *control,
            Action::FeedMode(mode) => {
                self.feed_mode = *mode;
                self.feed = None;
                self.written_feed = None;
            }
            Action::ToolLength(on) => {
                self.tool_length = Some(*on);
                self.radius_row = None;
                self.cutter_diameter = None;
            }
            Action::ToolOffset(row) => {
                self.tool_length = Some(true);
                self.radius_row = Some(*row);
                self.cutter_diameter = None;
            }
            Action::CutterDiameter(diameter) => self.cutter_diameter = *diameter,
            Action::RadiusRow(row) => self.radius_row = *row,
            Action::ToolChange => {
                self.radius_row = None;
                self.cutter_diameter = None;
            }
            _ => {}
        }
    }
}
