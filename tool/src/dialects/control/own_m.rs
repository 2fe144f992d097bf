//! The M functions that LinuxCNC defines itself: passed on from a program of another control they would do
//! something else than is meant.

/// What an M function is to LinuxCNC; `None` for those that are free for the user or unknown.
pub fn linuxcnc_m(number: u32) -> Option<&'static str> {
    Some(match number {
        0 | 1 => "stop",
        2 | 30 => "end of the program",
        3..=5 => "spindle",
        6 => "tool change",
        7..=9 => "coolant",
        19 => "spindle at an angle",
        48 | 49 => "overrides on and off",
        50 => "feed override",
        51 => "spindle override",
        52 => "adaptive feed",
        53 => "feed stop",
        60 => "pallet change",
        61 => "number of the tool in the spindle",
        62..=65 => "digital output",
        66 => "wait for an input",
        67 | 68 => "analog output",
        70..=73 => "saved modes",
        98 | 99 => "subprograms",
        _ => return None,
    })
}
