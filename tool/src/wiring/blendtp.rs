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

/// Whether blendtp has this pin.
pub fn has_pin(pin: &str) -> bool {
    let Some(name) = pin.strip_prefix("blendtp.") else {
        return false;
    };
    axis_of_pin(pin).is_some() || OTHERS.contains(&name) || is_limit(name)
}

/// The pins that are there once.
const OTHERS: [&str; 20] = [
    "millimetre",
    "rotary-tolerance",
    "default-tolerance",
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
const LIMITS: [&str; 12] = [
    "axis",
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

/// Less than this makes blendtp refuse every move: a fifth of the acceleration.
pub fn least_jerk(acceleration: f64) -> f64 {
    acceleration / 5.0
}
