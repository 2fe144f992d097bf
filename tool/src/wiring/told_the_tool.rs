//! Kinematics that are told the tool's length, and the types of them that it counts for: `tool_types=` of framekins.

use super::subject::Subject;

/// The module, its pin for the tool's length, and which of its types it counts for: without and with
/// `sparm=identityfirst`.
const TOLD: [(&str, &str, [u8; 2]); 9] = [
    ("5axiskins", "5axiskins.pivot-length", [0, 1]),
    ("genhexkins", "genhexkins.tool-offset", [0, 1]),
    ("maxkins", "maxkins.pivot-length", [0, 0]),
    ("pentakins", "pentakins.tool-offset", [0, 0]),
    ("xyzab_tdr_kins", "xyzab_tdr_kins.tool-offset-z", [1, 1]),
    ("xyzac-trt-kins", "xyzac-trt-kins.tool-offset", [0, 1]),
    ("xyzacb_trsrn", "xyzacb_trsrn_kins.tool-offset-z", [1, 1]),
    ("xyzbc-trt-kins", "xyzbc-trt-kins.tool-offset", [0, 1]),
    ("xyzbca_trsrn", "xyzbca_trsrn_kins.tool-offset-z", [1, 1]),
];

/// The pin of this module that is linked, and the type of its kinematics that turns the tool's length; `None`: nothing
/// tells these kinematics of a tool.
pub fn tool_type(subject: &Subject, module: &str) -> Option<(&'static str, u8)> {
    let (_, pin, [usual, identity_first]) = TOLD.iter().find(|(name, _, _)| *name == module)?;
    subject.state.signal_of(pin)?;
    let loaded = subject.state.module(module)?;
    let is_moved = loaded.parameter("sparm") == Some("identityfirst");
    Some((pin, if is_moved { *identity_first } else { *usual }))
}
