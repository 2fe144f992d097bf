//! blendtp: its pins, and the values that they may have.

/// Letters of the axes that have a jerk limit, in LinuxCNC's order.
const LETTERS: &str = "xyzabcuvw";

/// The pin with the jerk limit of an axis.
pub fn jerk_pin(letter: char) -> String {
    format!("blendtp.axis.{}.max-jerk", letter.to_ascii_lowercase())
}

/// The line that takes the limit of the INI file to the pin.
pub fn jerk_line(letter: char) -> String {
    let section = letter.to_ascii_uppercase();
    format!("setp {} [AXIS_{section}]MAX_JERK", jerk_pin(letter))
}

/// The line that tells blendtp how long a millimetre is on a machine in inches.
pub fn inch_line() -> String {
    "setp blendtp.millimetre 0.0393700787".to_owned()
}

/// The pin with the tolerance of runs of short moves under G64 without P, machine units.
pub const TOLERANCE_PIN: &str = "blendtp.default-tolerance";

/// The line that gives a machine in inches the tolerance that one in millimetres begins with, 0.02 mm.
pub fn inch_tolerance_line() -> String {
    format!("setp {TOLERANCE_PIN} 0.0008")
}

/// The axis whose jerk limit a pin is.
pub fn axis_of_pin(pin: &str) -> Option<char> {
    let letter = pin
        .strip_prefix("blendtp.axis.")?
        .strip_suffix(".max-jerk")?;
    let mut letters = letter.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) if LETTERS.contains(letter) => Some(letter.to_ascii_uppercase()),
        _ => None,
    }
}

/// How many joints can have limits.
pub const LIMITED_JOINTS: usize = 9;

/// A limit that a joint has.
pub struct JointLimit {
    /// The end of the pin's name.
    name: &'static str,
    /// The key under `[JOINT_n]`.
    key: &'static str,
    /// What happens without it.
    pub without: &'static str,
}

/// What a joint has limits of.
pub const JOINT_LIMITS: [JointLimit; 3] = [
    JointLimit {
        name: "max-velocity",
        key: "MAX_VELOCITY",
        without: "blendtp refuses every move",
    },
    JointLimit {
        name: "max-acceleration",
        key: "MAX_ACCELERATION",
        without: "blendtp refuses every move",
    },
    JointLimit {
        name: "max-jerk",
        key: "MAX_JERK",
        without: "the jerk of the joint is not limited",
    },
];

impl JointLimit {
    /// The pin of a joint.
    pub fn pin(&self, joint: usize) -> String {
        format!("blendtp.joint.{joint}.{}", self.name)
    }

    /// The line that takes the limit of the INI file to the pin.
    pub fn line(&self, joint: usize) -> String {
        format!("setp {} [JOINT_{joint}]{}", self.pin(joint), self.key)
    }
}

fn is_joint_limit(pin: &str) -> bool {
    (0..LIMITED_JOINTS).any(|joint| JOINT_LIMITS.iter().any(|limit| limit.pin(joint) == pin))
}

/// Whether blendtp has this pin.
pub fn has_pin(pin: &str) -> bool {
    let Some(name) = pin.strip_prefix("blendtp.") else {
        return false;
    };
    axis_of_pin(pin).is_some() || is_joint_limit(pin) || OTHERS.contains(&name) || is_limit(name)
}

/// The pins that are there once.
const OTHERS: [&str; 21] = [
    "millimetre",
    "rotary-tolerance",
    "default-tolerance",
    "corners-inside",
    "version",
    "move.number",
    "move.line",
    "move.stands",
    "move.to-go",
    "queued.moves",
    "queued.seconds",
    "ahead.moves",
    "ahead.seconds",
    "clock",
    "program.ends-at",
    "program.said-at",
    "time-left",
    "time-left.whole-program",
    "time-left.minutes",
    "time-left.seconds",
    "limit.kind",
];

/// What `blendtp.limit` has a bit for, besides the axes.
const LIMITS: [&str; 13] = [
    "axis",
    "joint",
    "nothing",
    "rest",
    "hold",
    "spindle",
    "feed",
    "override",
    "path-velocity",
    "velocity",
    "acceleration",
    "jerk",
    "between",
];

fn is_limit(name: &str) -> bool {
    let Some(limit) = name.strip_prefix("limit.") else {
        return false;
    };
    let of_axis = |letter: &str| letter.len() == 1 && LETTERS.contains(letter);
    LIMITS.contains(&limit) || limit.strip_prefix("axis.").is_some_and(of_axis)
}

/// Whether blendtp refuses every move with this limit of jerk of an axis, given the least one that it takes.
pub fn is_refused_jerk(jerk: f64, least: f64) -> bool {
    jerk.is_nan() || jerk < 0.0 || (jerk > 0.0 && jerk < least)
}

/// Less than this makes blendtp refuse every move: a fifth of the acceleration.
pub fn least_jerk(acceleration: f64) -> f64 {
    acceleration / 5.0
}
