//! framekins: its nets, its other pins, its place in the servo thread, and frame_guard.

/// Where motion reads the type of the kinematics.
pub const MOTION_TYPE: &str = "motion.switchkins-type";
/// Where framekins does, before the kinematics of another module.
pub const INNER_TYPE: &str = "framekins.inner-type";

/// A frame takes this many analog outputs in a row, and motmod has at most so many.
pub const OUTPUTS: u32 = 9;
/// Of motmod.
pub const MOST_OUTPUTS: u32 = 64;
/// Of motmod, where `num_aio` does not say otherwise.
pub const USUAL_OUTPUTS: u32 = 4;
/// What the samples give to motmod.
pub const SAMPLE_OUTPUTS: u32 = 16;
/// The output by which G43.4 chooses the type of the kinematics behind framekins: that of LinuxCNC's samples.
pub const USUAL_TYPE_OUTPUT: u32 = 3;

/// The line behind which motion's positions are those of the period.
pub const ADD_FUNCTION: &str = "addf framekins servo-thread";

/// Where a net comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// An analog output, counted from `[FRAMEPATH]ANALOG_OUTPUT`.
    Output(u32),
    /// A pin.
    Pin(&'static str),
}

/// A net that has to be there.
#[derive(Clone, Copy, Debug)]
pub struct Net {
    /// The name of the signal in the samples.
    pub signal: &'static str,
    /// What writes.
    pub source: Source,
    /// What reads.
    pub pin: &'static str,
    /// What goes wrong without it.
    pub loss: &'static str,
}

impl Net {
    /// The pin that writes, where frames begin at this analog output.
    pub fn source_pin(&self, first_output: u32) -> String {
        match self.source {
            Source::Output(number) => format!("motion.analog-out-{:02}", first_output + number),
            Source::Pin(pin) => pin.to_owned(),
        }
    }

    /// The line of the samples.
    pub fn line(&self, first_output: u32) -> String {
        format!(
            "net {} {} => {}",
            self.signal,
            self.source_pin(first_output),
            self.pin
        )
    }
}

const fn net(signal: &'static str, source: Source, pin: &'static str, loss: &'static str) -> Net {
    Net {
        signal,
        source,
        pin,
        loss,
    }
}

const REFUSED: &str = "every frame is refused, since what arrives is not what was sent";
const TOOL: &str = "a frame takes the tool for one without length";

use Source::{Output, Pin};

/// Those of every machine.
pub const NETS: [Net; 18] = [
    net(
        "frame-command",
        Output(0),
        "framekins.command",
        "no frame command arrives",
    ),
    net("frame-value-1", Output(1), "framekins.value.1", REFUSED),
    net("frame-value-2", Output(2), "framekins.value.2", REFUSED),
    net("frame-value-3", Output(3), "framekins.value.3", REFUSED),
    net(
        "frame-work-x",
        Output(4),
        "framekins.work-offset.x",
        REFUSED,
    ),
    net(
        "frame-work-y",
        Output(5),
        "framekins.work-offset.y",
        REFUSED,
    ),
    net(
        "frame-work-z",
        Output(6),
        "framekins.work-offset.z",
        REFUSED,
    ),
    net(
        "frame-work-r",
        Output(7),
        "framekins.work-offset.rotation",
        REFUSED,
    ),
    net("frame-check", Output(8), "framekins.check", REFUSED),
    net(
        "frame-tool-x",
        Pin("motion.tooloffset.x"),
        "framekins.tool-offset.x",
        TOOL,
    ),
    net(
        "frame-tool-y",
        Pin("motion.tooloffset.y"),
        "framekins.tool-offset.y",
        TOOL,
    ),
    net(
        "frame-tool-z",
        Pin("motion.tooloffset.z"),
        "framekins.tool-offset.z",
        TOOL,
    ),
    net(
        "motion-in-position",
        Pin("motion.in-position"),
        "framekins.in-position",
        "no frame is taken",
    ),
    net(
        "motion-teleop",
        Pin("motion.teleop-mode"),
        "framekins.teleop",
        "a frame that changes in teleop mode moves the joints",
    ),
    net(
        "motion-on",
        Pin("motion.motion-enabled"),
        "framekins.enabled",
        "a frame does not go when the machine is switched off",
    ),
    net(
        "frame-switch",
        Pin("framekins.switchkins-type"),
        MOTION_TYPE,
        "motion never switches to a frame",
    ),
    net(
        "frame-hold",
        Pin("framekins.hold"),
        "motion.feed-inhibit",
        "a program may start before a frame is gone, and nothing holds the machine if frame_guard ends",
    ),
    net(
        "frame-guarded",
        Pin("framekins.guarded"),
        "motion.enable",
        "nothing stops the machine if frame_guard ends",
    ),
];

/// Of a machine with a tilting table.
pub const TABLE_NET: Net = net(
    "frame-tool-z",
    Pin("motion.tooloffset.z"),
    "framekins.tool-offset",
    "the tool centre point does not know the tool's length",
);

/// The net with which a program asks for the tool centre point.
pub const TOOL_CENTRE_POINT: Net = net(
    "tool-centre-point",
    Pin("motion.digital-out-00"),
    "framekins.tool-centre-point",
    "M64 P0 does not ask for the tool centre point",
);

/// How framekins is told of the external offset of this axis, and what it is linked to where it has one: `axis.y.eoffset`.
pub fn external_offset(letter: char) -> [String; 2] {
    let letter = letter.to_ascii_lowercase();
    [
        format!("framekins.external-offset.{letter}"),
        format!("axis.{letter}.eoffset"),
    ]
}

/// A dimension of a tilting table, or a limit of an axis that turns the tool.
#[derive(Clone, Debug, PartialEq)]
pub struct TablePin {
    /// The pin.
    pub pin: String,
    /// What the samples set it to.
    pub value: String,
    /// What is taken without it.
    pub without: &'static str,
}

/// What has to be set on a machine whose table is tilted by this axis, `A` or `B`. `joints` has the letter of each
/// joint.
pub fn table_pins(tilt: char, joints: &[char]) -> Vec<TablePin> {
    let moved = if tilt == 'A' { "y" } else { "x" };
    let named = |name: &str| TablePin {
        pin: format!("framekins.{name}"),
        value: format!("[TABLE]{}", name.to_ascii_uppercase().replace('-', "_")),
        without: "0 is taken",
    };
    let mut pins = vec![
        named("x-rot-point"),
        named("y-rot-point"),
        named("z-rot-point"),
        named(&format!("{moved}-offset")),
        named("z-offset"),
    ];
    for (name, letter) in [("tilt", tilt), ("rotary", 'C')] {
        let joint = joints.iter().position(|known| *known == letter);
        for end in ["MIN", "MAX"] {
            let number = joint.unwrap_or_default();
            pins.push(range_pin(name, end, format!("[JOINT_{number}]{end}_LIMIT")));
        }
    }
    pins
}

/// One end, `MIN` or `MAX`, of the range of the axis that is named so, `tilt` or `rotary`.
pub fn range_pin(name: &str, end: &str, value: String) -> TablePin {
    TablePin {
        pin: format!("framekins.{name}-{}", end.to_ascii_lowercase()),
        value,
        without: "o<tool_normal> knows no limit",
    }
}

/// Pins that only a machine with a tilting table has.
const TABLE_ONLY: [&str; 9] = [
    "x-rot-point",
    "y-rot-point",
    "z-rot-point",
    "x-offset",
    "y-offset",
    "z-offset",
    "tool-offset",
    "conventional-directions",
    "tool-centre-point",
];

/// Pins that a machine has whose axes turn the tool: with a tilting table, and before the kinematics of another module.
const RANGES: [&str; 4] = ["tilt-min", "tilt-max", "rotary-min", "rotary-max"];

/// Pins that are there before the kinematics of another module only.
const INNER_ONLY: [&str; 3] = ["inner-type", "inner-type-active", "inner-refusal"];

/// All others that are not in [`NETS`].
const OTHERS: [&str; 52] = [
    "map.xx",
    "map.xy",
    "map.xz",
    "map.x",
    "map.yx",
    "map.yy",
    "map.yz",
    "map.y",
    "map.zx",
    "map.zy",
    "map.zz",
    "map.z",
    "mirror.a",
    "mirror.b",
    "mirror.c",
    "mirror.u",
    "mirror.v",
    "mirror.w",
    "tool-length-machine",
    "acknowledged",
    "active",
    "slot",
    "operations",
    "refusal",
    "tool-centre-point-active",
    "frame-tool-offset.x",
    "frame-tool-offset.y",
    "frame-tool-offset.z",
    "parameters-pending",
    "tilt-axis",
    "normal-refusal",
    "normal-tilt",
    "normal-rotary",
    "normal-tilt-axis",
    "normal-rotary-axis",
    "version",
    "release-on-abort",
    "release",
    "releases-seen",
    "heartbeat",
    "releasing",
    "releases",
    "guard.active",
    "guard.parameters-pending",
    "guard.tool-length-matters",
    "guard.operations",
    "guard.command",
    "guard.acknowledged",
    "guard.work-offset.rotation",
    "time",
    "tmax",
    "tmax-increased",
];

/// Whether framekins has this pin on a machine with a tilting table.
pub fn needs_table(pin: &str) -> bool {
    pin.strip_prefix("framekins.")
        .is_some_and(|name| TABLE_ONLY.contains(&name))
}

/// Whether framekins has this pin with a tilting table or before the kinematics of another module.
pub fn needs_turning_axes(pin: &str) -> bool {
    pin.strip_prefix("framekins.")
        .is_some_and(|name| RANGES.contains(&name))
}

/// Three rows of the map of a frame.
const MAP: [&str; 12] = [
    "xx", "xy", "xz", "x", "yx", "yy", "yz", "y", "zx", "zy", "zz", "z",
];

/// Whether framekins has this pin before the kinematics of another module.
pub fn needs_inner(pin: &str) -> bool {
    pin.strip_prefix("framekins.")
        .is_some_and(|name| INNER_ONLY.contains(&name))
}

/// Pins that are there for each of some axes.
const OF_AXES: [(&str, &str); 3] = [
    ("external-offset.", "xyzabcuvw"),
    ("position.", "xyzabcuvw"),
    ("turned-tool.", "xyz"),
];

fn is_of_axis(name: &str, start: &str, letters: &str) -> bool {
    let axis = name.strip_prefix(start);
    axis.is_some_and(|axis| axis.len() == 1 && letters.contains(axis))
}

/// Whether framekins has this pin on some machine.
pub fn has_pin(pin: &str) -> bool {
    let in_net = |net: &Net| net.pin == pin || matches!(net.source, Pin(name) if name == pin);
    let others = |name: &str| {
        OTHERS.contains(&name)
            || TABLE_ONLY.contains(&name)
            || RANGES.contains(&name)
            || INNER_ONLY.contains(&name)
            || name.starts_with("guard.work-offset.")
            || OF_AXES
                .iter()
                .any(|(start, letters)| is_of_axis(name, start, letters))
            || name.starts_with("guard.frame-tool-offset.")
            || name
                .strip_prefix("frame.")
                .is_some_and(|of| MAP.contains(&of))
    };
    NETS.iter().any(in_net) || pin.strip_prefix("framekins.").is_some_and(others)
}
