//! Blanks and fillers mean the same in all dialects.

use framepath_tool::diagnostics::Diagnostics;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::dialects::{Dialect, evaluate};
use framepath_tool::source::Sources;
use std::path::Path;

const DIALECTS: [Dialect; 5] = [
    Dialect::Sinumerik,
    Dialect::Fagor,
    Dialect::Mefi,
    Dialect::Isg,
    Dialect::Fanuc,
];

/// How many errors a program with this character between its words has.
fn errors(dialect: Dialect, character: char) -> usize {
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    let program = format!("{character}G0{character}X1 Y2{character}\nM30\n");
    sources.add("part.nc".to_string(), program);
    let path = Path::new("/nonexistent/part.nc");
    let settings = Settings::default();
    evaluate(dialect, path, &settings, &mut sources, &mut diagnostics);
    diagnostics.errors()
}

#[test]
fn what_looks_like_a_blank_is_one() {
    for character in "\t \u{a0}\u{1680}\u{2003}\u{200a}\u{202f}\u{205f}\u{3000}\u{feff}".chars() {
        for dialect in DIALECTS {
            assert_eq!(errors(dialect, character), 0, "{dialect:?} {character:?}");
        }
    }
}

#[test]
fn what_looks_like_the_end_of_a_line_or_like_nothing_is_refused() {
    for character in "\u{b}\u{c}\u{85}\u{2028}\u{2029}\u{200b}\u{7f}\u{1}".chars() {
        for dialect in DIALECTS {
            assert!(errors(dialect, character) > 0, "{dialect:?} {character:?}");
        }
    }
}
