//! The form of an error text.

/// Fails unless the text shows exactly one error of the program, at this place (`FILE:LINE:COLUMN`),
/// with these words.
pub fn assert_one_error(shown: &str, program: &str, place: &str, words: &str) {
    assert!(shown.contains(&format!("{place}\n")), "{program}\n{shown}");
    assert!(shown.contains(words), "{program}\n{shown}");
    assert!(
        shown.contains("\n1 error: nothing was written"),
        "{program}\n{shown}"
    );
}
