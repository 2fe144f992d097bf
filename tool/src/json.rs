//! The one form of all JSON that the commands print: the fields of the command behind one that says what
//! they are. `docs/json.md` has every field.

use serde::Serialize;
use std::io::{self, Write};

/// Number of the form; it rises when a field goes away or changes its meaning, not when one is added.
pub(crate) const FORMAT: u32 = 1;

/// Who has printed it, and in which form.
#[derive(Serialize)]
struct Origin<'a> {
    version: &'static str,
    command: &'a str,
    format: u32,
}

#[derive(Serialize)]
struct Printed<'a, T> {
    framepath: Origin<'a>,
    #[serde(flatten)]
    content: &'a T,
}

/// Writes the figures of a command, which have to be fields with names, and a line feed.
///
/// # Errors
/// Those of `output`.
pub(crate) fn write(
    mut output: impl Write,
    command: &str,
    content: &impl Serialize,
) -> io::Result<()> {
    let framepath = Origin {
        version: env!("CARGO_PKG_VERSION"),
        command,
        format: FORMAT,
    };
    let printed = Printed { framepath, content };
    let mut text = serde_json::to_vec_pretty(&printed)?;
    text.push(b'\n');
    output.write_all(&text)?;
    output.flush()
}
