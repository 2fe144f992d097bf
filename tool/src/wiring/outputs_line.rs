//! The line that says how many analog outputs motmod has: one of the INI file where that file says what is loaded, else
//! the line of the HAL file.

use super::subject::Subject;
use crate::hal::Module;
use crate::machine::place::Place;

/// A line with enough of them.
pub enum OutputsLine {
    /// A key under `[EMCMOT]`.
    Ini {
        /// Where it is now, else where its section is.
        place: Place,
        /// Its name.
        key: &'static str,
        /// What it is to be.
        value: String,
    },
    /// What loads motmod, in the HAL file.
    Hal(String),
}

impl OutputsLine {
    /// The line that gives motmod so many outputs.
    pub fn new(subject: &Subject, motion: &Module, outputs: u32) -> OutputsLine {
        let line = &motion.statement.text;
        let names = |key: &str| {
            line.contains(&format!("[EMCMOT]{key}")) || line.contains(&format!("[EMCMOT]({key})"))
        };
        let ini = |key, value| OutputsLine::Ini {
            place: subject.place_of("EMCMOT", key),
            key,
            value,
        };
        if names("NUM_AIO") {
            return ini("NUM_AIO", outputs.to_string());
        }
        if line.contains("num_aio=") || !names("EMCMOT") {
            return OutputsLine::Hal(with_outputs(line, outputs));
        }
        let words = subject.text("EMCMOT", "EMCMOT").unwrap_or("motmod");
        ini("EMCMOT", with_outputs(words, outputs))
    }
}

/// The words that load motmod, with so many outputs in place of what they say of them.
fn with_outputs(words: &str, outputs: u32) -> String {
    let words = words.split_whitespace();
    let others: Vec<&str> = words.filter(|word| !word.starts_with("num_aio=")).collect();
    format!("{} num_aio={outputs}", others.join(" "))
}
