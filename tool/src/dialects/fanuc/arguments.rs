//! The arguments of a macro: which letter gives which local variable.
//!
//! I, J and K may be there up to ten times: the second I is #7, the second J #8 and so on. (Fanuc,
//! Series 30i, User's Manual, "Custom macro: argument specification I and II".)

use super::syntax::Word;
use super::values::{InWord, Lookup, value};
use super::variables::Locals;
use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The letters and their variables, but for I, J and K.
const VARIABLES: [(char, u32); 18] = [
    ('A', 1),
    ('B', 2),
    ('C', 3),
    ('D', 7),
    ('E', 8),
    ('F', 9),
    ('H', 11),
    ('M', 13),
    ('Q', 17),
    ('R', 18),
    ('S', 19),
    ('T', 20),
    ('U', 21),
    ('V', 22),
    ('W', 23),
    ('X', 24),
    ('Y', 25),
    ('Z', 26),
];

/// How often I, J and K may be there.
const MOST_POINTS: u32 = 10;

/// The local variables of a call with these words. `increments`: numbers without a point are not what
/// they seem.
pub fn locals(words: &[Word], lookup: &dyn Lookup, increments: bool) -> Result<Locals, Diagnostic> {
    let mut locals = Locals::new();
    // How many I, J, K are complete, and which of them comes next at the earliest.
    let (mut points, mut next) = (0, 0);
    for word in words {
        let span = word.span;
        let number = match "IJK".find(word.letter) {
            Some(place) => {
                if (place as u32) < next {
                    points += 1;
                }
                next = place as u32 + 1;
                4 + 3 * points + place as u32
            }
            None => VARIABLES
                .iter()
                .find(|(letter, _)| *letter == word.letter)
                .map(|(_, number)| *number)
                .filter(|_| !word.comma)
                .ok_or_else(|| no_argument(word.letter, span))?,
        };
        if points >= MOST_POINTS {
            return Err(Diagnostic::error(span, "I, J and K can be there ten times"));
        }
        if increments && word.pointless.is_some() && !"DEHMST".contains(word.letter) {
            return Err(Diagnostic::error(
                span,
                format!("the argument {} has no decimal point", word.letter),
            )
            .help(format!(
                "write {}10. instead of {}10",
                word.letter, word.letter
            )));
        }
        let value = value(&word.value, &InWord { lookup, step: None })?;
        if locals.insert(number, value).is_some() {
            return Err(
                Diagnostic::error(span, format!("#{number} gets a second value")).help(
                    "each letter gives a variable of its own; the second I, J, K are #7, #8, #9",
                ),
            );
        }
    }
    Ok(locals)
}

fn no_argument(letter: char, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("{letter} is no argument of a macro"))
        .help("arguments are A to F, H to K, M and Q to Z; G65 stands before them")
}
