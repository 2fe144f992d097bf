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

/// The line that tells blendtp of inches.
pub fn inch_line() -> String {
    "setp blendtp.millimetre 0.0393700787".to_owned()
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
    let others = [
        "millimetre",
        "rotary-tolerance",
        "default-tolerance",
        "version",
    ];
    axis_of_pin(pin).is_some()
        || pin
            .strip_prefix("blendtp.")
            .is_some_and(|name| others.contains(&name))
}

/// Less than this makes blendtp refuse every move: a fifth of the acceleration.
pub fn least_jerk(acceleration: f64) -> f64 {
    acceleration / 5.0
}
