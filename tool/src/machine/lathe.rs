//! Whether a machine is a lathe.

use super::ini::Ini;

/// LinuxCNC shows it as one, or it has no Y.
pub(crate) fn is_lathe(ini: &Ini) -> bool {
    let shown = ini.text("DISPLAY", "LATHE").unwrap_or("0");
    let off = ["", "0", "NO", "FALSE", "OFF"];
    let has_y = |axes: &str| axes.contains(['Y', 'y']);
    let mill = ini.text("TRAJ", "COORDINATES").is_none_or(has_y);
    !mill || !off.contains(&shown.trim().to_ascii_uppercase().as_str())
}
