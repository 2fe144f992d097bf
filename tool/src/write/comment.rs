//! Comments that LinuxCNC cannot take for anything else.

/// Longest text of a comment, bytes: a line has at most 255 with its other words.
const LONGEST: usize = 160;

/// A comment in parentheses.
///
/// Parentheses inside become brackets. A first word with a comma (`MSG,`, `DEBUG,`, `PY,`) would be
/// a command to LinuxCNC; its comma becomes a semicolon.
pub fn comment(text: &str) -> String {
    format!("({})", harmless(text))
}

/// A message to the operator.
pub fn message(text: &str) -> String {
    format!("(MSG, {})", plain(text))
}

fn harmless(text: &str) -> String {
    let text = plain(text);
    let first = text.trim_start();
    let word = first
        .find(|c: char| !c.is_alphanumeric() && c != '_')
        .unwrap_or(first.len());
    match first[word..].trim_start().starts_with(',') {
        true => text.replacen(',', ";", 1),
        false => text,
    }
}

/// With brackets for parentheses, without control characters. `#` stays: only in the commands that
/// [`comment`] takes away it would be a parameter.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for character in text.trim().chars() {
        let character = match character {
            '(' => '[',
            ')' => ']',
            c if c.is_control() => ' ',
            c => c,
        };
        if plain.len() + character.len_utf8() > LONGEST {
            plain.push_str("...");
            break;
        }
        plain.push(character);
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_comment_is_obeyed() {
        assert_eq!(comment("a (b) c"), "(a [b] c)");
        assert_eq!(comment("MSG, hello"), "(MSG; hello)");
        assert_eq!(comment(" debug , #5420"), "(debug ; #5420)");
        assert_eq!(comment("py,import os"), "(py;import os)");
        assert_eq!(comment("line\u{7}end"), "(line end)");
    }

    #[test]
    fn comments_end_in_time() {
        assert!(comment(&"ñ".repeat(300)).len() < 170);
    }
}
