//! Indices of numbered variables and of arrays.

use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The number of a parameter, 0 to 32767; `what` names it in messages.
pub fn parameter_number(index: &[f64], what: &str, span: Span) -> Result<u32, Diagnostic> {
    match index {
        [number] if number.fract() == 0.0 && (0.0..=32767.0).contains(number) => Ok(*number as u32),
        _ => Err(Diagnostic::error(
            span,
            format!("the number of {what} is a whole number from 0 to 32767"),
        )),
    }
}

/// Where an element of an array of this size stands when its elements are in one row, the last index
/// running fastest. Indices begin at 0.
pub fn element(size: &[usize], index: &[f64], span: Span) -> Result<usize, Diagnostic> {
    if size.len() != index.len() {
        return Err(Diagnostic::error(
            span,
            format!("this variable has {} indices", size.len()),
        ));
    }
    let mut at = 0;
    for (size, index) in size.iter().zip(index) {
        if index.fract() != 0.0 || *index < 0.0 || *index >= *size as f64 {
            return Err(Diagnostic::error(
                span,
                format!(
                    "the index {index} is outside 0 to {}",
                    size.saturating_sub(1)
                ),
            ));
        }
        at = at * size + *index as usize;
    }
    Ok(at)
}
