//! What speaks for this dialect. Most of its words are those of newer Fagor controls too, where G261 has to do with
//! the centres of arcs, G92 with presets and D with the offsets of a tool.

use crate::dialects::guess::{Evidence, without_comments};

/// The controls that share most words.
const SHARED_WITH: &str = "the Fagor 8060, 8065 and 8070";

const STATEMENTS: [&str; 9] = [
    "$IF", "$FOR", "$WHILE", "$DO", "$SWITCH", "$GOTO", "$ENDIF", "$ENDFOR", "$REPEAT",
];

const COMMANDS: [&str; 8] = [
    "#HSC",
    "#CS",
    "#MSG",
    "#SLOPE",
    "#SET",
    "#CONTOUR",
    "#VAR",
    "#ROTATION",
];

const FUNCTIONS: [&str; 6] = ["G161", "G162", "G261", "G351", "V.P.", "V.L."];

/// First words of blocks that no Fagor control has.
const OWN_COMMANDS: [&str; 4] = ["#CONTOUR", "#VAR", "#ROTATION", "$REPEAT"];

/// Words elsewhere in a block that no Fagor control has.
const OWN_WORDS: [&str; 6] = ["G351", "V.L.", "V.E.", "OPMODE", "PATH_DEV", "SLOPE PROFIL"];

/// What speaks for this dialect; see [`crate::dialects::guess`].
pub fn evidence(lines: &[String]) -> Evidence {
    let mut evidence = Evidence::default();
    let mut is_own = false;
    for (index, line) in lines.iter().enumerate() {
        let line = without_comments(line.split(';').next().unwrap_or(""), |_| false);
        let code = line.strip_prefix('N').map_or(line.as_str(), |rest| {
            rest.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim_start()
        });
        let word = code
            .split(|c: char| c.is_whitespace() || c == '[')
            .next()
            .unwrap_or("");
        let calls = code.starts_with("LL ") || line.starts_with("%L ");
        if calls || STATEMENTS.contains(&word) || COMMANDS.contains(&word) {
            evidence.add(100, index);
        } else if FUNCTIONS.iter().any(|known| code.contains(known)) {
            evidence.add(40, index);
        }
        is_own |= OWN_COMMANDS.contains(&word) || has_own_words(code, word);
    }
    if !is_own {
        evidence.share(SHARED_WITH);
    }
    evidence
}

/// Whether a block has words that no Fagor control has: those above, mirrors, and a coordinate system by its six
/// numbers without a mode. What stands in quotation marks is a text.
fn has_own_words(code: &str, command: &str) -> bool {
    let code = code.split('"').next().unwrap_or("");
    let mirrors = code.split("G2").skip(1).any(|rest| {
        let number = rest.strip_prefix(['1', '2', '3']);
        number.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
    });
    let system = command == "#CS" && code.matches(',').count() == 5 && !code.contains("MODE");
    mirrors || system || OWN_WORDS.iter().any(|word| code.contains(word))
}
