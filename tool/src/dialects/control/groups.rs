//! Which G functions of a block exclude each other, and in which order those that do not are set.

use super::Done;
use super::words::At;
use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The groups of G functions that a block has used; it may hold one function of each.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    used: Vec<(u8, String)>,
}

impl Groups {
    /// A function of this group stands in the block.
    ///
    /// # Errors
    ///
    /// When another one of its group does too.
    pub fn claim(&mut self, group: u8, name: String, span: Span) -> Done {
        if let Some((_, other)) = self.used.iter().find(|(known, _)| *known == group) {
            return Err(Diagnostic::error(
                span,
                format!("{other} and {name} exclude each other"),
            ));
        }
        self.used.push((group, name));
        Ok(())
    }
}

/// The G functions of a block in the order in which they are set, whatever their order in the block:
/// compensation ends before planes and offsets change, and begins after. `one` is how G1 is counted:
/// 10 where numbers have a decimal.
pub fn in_order_of_compensation(functions: &[At<u32>], one: u32) -> Vec<At<u32>> {
    let mut ordered = functions.to_vec();
    ordered.sort_by_key(|function| match function.value {
        off if off == 40 * one => 0,
        on if on == 41 * one || on == 42 * one => 2,
        _ => 1,
    });
    ordered
}
