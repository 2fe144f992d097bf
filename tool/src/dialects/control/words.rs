//! What the words of a motion say, evaluated, before it is known what they mean.

use super::Done;
use crate::diagnostics::Diagnostic;
use crate::source::Span;
use std::fmt::Display;

/// The axes in the order of LinuxCNC.
pub const AXES: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];

/// A value and where its word stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// The word.
    pub span: Span,
}

/// Puts the value of a word into its place; a block may have one of each.
///
/// # Errors
///
/// When there is one already.
pub fn set<T>(place: &mut Option<At<T>>, value: T, span: Span, address: impl Display) -> Done {
    if place.is_some() {
        return Err(Diagnostic::error(
            span,
            format!("{address} is in this block twice"),
        ));
    }
    *place = Some(At { value, span });
    Ok(())
}

/// The names of those words that are there, and where they stand.
pub fn named<'a>(
    words: &'a [(&str, Option<At<f64>>)],
) -> impl Iterator<Item = (String, Span)> + 'a {
    let there =
        |(name, word): &(&str, Option<At<f64>>)| word.map(|word| (name.to_string(), word.span));
    words.iter().filter_map(there)
}

/// Whether a coordinate is absolute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// As G90 and G91 say; for the centre of an arc: from its start.
    Modal,
    /// Absolute whatever G90 and G91 say.
    Absolute,
    /// An increment whatever G90 and G91 say.
    Incremental,
}

/// The words of a motion, in units of the program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionWords {
    /// X Y Z A B C U V W.
    pub axes: [Option<At<(f64, Dimension)>>; 9],
    /// I J K: the centre of an arc.
    pub centre: [Option<At<(f64, Dimension)>>; 3],
    /// The radius of an arc, negative for more than half a circle.
    pub radius: Option<At<f64>>,
    /// Full turns of an arc beyond the first passage of its end.
    pub turns: Option<At<f64>>,
}

impl MotionWords {
    /// I, J and K as far as they are there, and where they stand.
    pub fn named_centre(&self) -> impl Iterator<Item = (String, Span)> {
        let words = ["I", "J", "K"].into_iter().zip(self.centre);
        words.filter_map(|(name, word)| word.map(|word| (name.to_string(), word.span)))
    }

    /// Whether any axis is named.
    pub fn names_an_axis(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Where the first axis word stands.
    pub fn first_axis(&self) -> Option<Span> {
        let spans = self.axes.iter().flatten().map(|axis| axis.span);
        spans.min_by_key(|span| span.start)
    }

    /// Whether a centre or a radius is there.
    pub fn names_a_centre(&self) -> bool {
        self.radius.is_some() || self.centre.iter().any(Option::is_some)
    }

    /// Whether there is anything to move.
    pub fn is_motion(&self) -> bool {
        self.names_an_axis() || self.names_a_centre() || self.turns.is_some()
    }
}
