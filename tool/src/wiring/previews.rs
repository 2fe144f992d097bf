//! The file that makes the preview of a screen follow frames: `[DISPLAY]USER_COMMAND_FILE`.

use super::subject::Subject;
use std::path::Path;

/// A screen that runs such a file.
pub struct Screen {
    /// The first word of `[DISPLAY]DISPLAY`.
    pub command: &'static str,
    /// The file in framepath's folder of previews.
    pub file: &'static str,
    /// The module that a file of the user's own imports instead.
    pub module: &'static str,
}

const SCREENS: [Screen; 3] = [
    Screen {
        command: "axis",
        file: "frame_axis.py",
        module: "axis_frames",
    },
    Screen {
        command: "gmoccapy",
        file: "frame_gmoccapy.py",
        module: "gmoccapy_frames",
    },
    Screen {
        command: "qtvcp",
        file: "frame_qtvcp.py",
        module: "qtvcp_frames",
    },
];

/// The screen of a machine; `None`: its preview cannot follow frames.
pub fn screen(subject: &Subject) -> Option<&'static Screen> {
    let command = subject
        .text("DISPLAY", "DISPLAY")?
        .split_whitespace()
        .next()?;
    SCREENS.iter().find(|screen| screen.command == command)
}

impl Screen {
    /// The value of the key, with the folder of framepath's subroutines, beside which that of previews is.
    pub fn value(&self, subroutines: &str) -> String {
        let folder = Path::new(subroutines).with_file_name("preview");
        folder.join(self.file).display().to_string()
    }
}
