//! Tools by their names, and what the tool table says of the tool in the spindle.

use super::{Control, Done};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::tools::ToolBook;
use crate::program::Action;
use crate::source::Span;

/// Which tool is where.
#[derive(Clone, Debug, Default)]
pub(super) struct ToolState {
    /// T.
    selected: Option<u32>,
    /// The tool that M6 changed to.
    in_spindle: Option<u32>,
    /// Read when it is asked for the first time; `Err` with what was wrong, until that has been reported.
    book: Option<Result<ToolBook, Diagnostics>>,
}

impl ToolState {
    /// M6.
    pub(super) fn change(&mut self) {
        self.in_spindle = self.selected;
    }
}

impl Control<'_> {
    /// T by its name, with the number that the settings or the lists of tools give it.
    pub fn named_tool(&mut self, name: &str, span: Span) -> Done {
        let set = self.settings.tool_names.get(&name.trim().to_uppercase());
        let number = match set {
            Some(number) => *number,
            None => match self.tool_book() {
                Some(book) => book.number(name, span)?,
                None => return Ok(()),
            },
        };
        self.select_tool(number);
        Ok(())
    }

    pub(super) fn select_tool(&mut self, number: u32) {
        self.tools.selected = Some(number);
        self.actions.push(Action::Tool(number));
    }

    /// Number and diameter of the tool in the spindle, or of another row of the tool table, machine
    /// units; `None` where the lists of tools cannot be read, which has been reported. `what` needs it: for
    /// messages.
    ///
    /// # Errors
    ///
    /// The program has selected no tool, or its diameter is not known.
    pub fn tool_diameter(
        &mut self,
        what: &str,
        row: Option<u32>,
        span: Span,
    ) -> Result<Option<(u32, f64)>, Diagnostic> {
        let Some(number) = row.or(self.tools.in_spindle).or(self.tools.selected) else {
            return Err(Diagnostic::error(
                span,
                format!(
                    "{what} needs the diameter of the tool, and the program has changed to none"
                ),
            )
            .help("select and change the tool before: T3 M6"));
        };
        let Some(book) = self.tool_book() else {
            return Ok(None);
        };
        match book.diameter(number) {
            Some(diameter) if diameter > 0.0 => Ok(Some((number, diameter))),
            _ => {
                let help = match book.without_table() {
                    Some(reason) => {
                        format!("{reason}: --ini FILE names the INI file of the machine")
                    }
                    None => format!("write D with its diameter into the line of T{number}"),
                };
                Err(Diagnostic::error(
                    span,
                    format!(
                        "{what} needs the diameter of T{number}, and LinuxCNC's tool table has none"
                    ),
                )
                .help(help))
            }
        }
    }

    /// The axes that another tool offset moves: Z, and all where LinuxCNC's tool table is not known or has offsets in
    /// others, as on lathes. What is wrong in the lists is no matter of a program that names no tool.
    pub(super) fn axes_of_tool_offsets(&mut self) -> [bool; 9] {
        match self.read_tools() {
            Ok(book) if book.offsets_move_z_only() => std::array::from_fn(|axis| axis == 2),
            _ => [true; 9],
        }
    }

    fn tool_book(&mut self) -> Option<&ToolBook> {
        if let Err(wrong) = self.read_tools() {
            let wrong = std::mem::take(wrong);
            self.diagnostics.append(wrong);
        }
        self.tools.book.as_ref()?.as_ref().ok()
    }

    fn read_tools(&mut self) -> &mut Result<ToolBook, Diagnostics> {
        let read = || ToolBook::read(&self.settings.tool_files, self.sources);
        self.tools.book.get_or_insert_with(read)
    }
}
