//! `CALL "NAME"` and `EXTCALL "NAME"`: subprograms that are called by a text, which may hold the folder and the
//! ending of a file.

use super::interpreter::Interpreter;
use super::routine::Routine;
use super::syntax::{Block, Call};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Expression, Value};
use crate::dialects::run::Next;
use std::rc::Rc;

/// A subprogram as a text names it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Named {
    /// The folders, the outermost first; that of a drive is one of them.
    folders: Vec<String>,
    /// The name in upper case.
    name: String,
    /// The ending of its file, in upper case.
    extension: Option<String>,
}

/// Reads `POCKET`, `JOB/POCKET.SPF`, `LOCAL_DRIVE:\JOB\POCKET.SPF`, `/_N_WKS_DIR/_N_JOB_WPD/_N_POCKET_SPF`.
fn named(text: &str) -> Option<Named> {
    let upper = text.trim().to_ascii_uppercase();
    let parts = upper.split(['/', '\\', ':']);
    let mut parts: Vec<&str> = parts
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .collect();
    let file = parts.pop().filter(|file| !file.starts_with('.'))?;
    let (name, extension) = match archived(file, &["_SPF", "_MPF"]) {
        Some((name, extension)) => (name, Some(extension)),
        None => match file.rsplit_once('.') {
            Some((name, extension)) => (name, Some(extension)),
            None => (file, None),
        },
    };
    let folder = |part: &str| {
        let bare = archived(part, &["_WPD", "_DIR"]).map_or(part, |(name, _)| name);
        bare.strip_suffix(".WPD").unwrap_or(bare).to_string()
    };
    (!name.is_empty()).then(|| Named {
        folders: parts
            .into_iter()
            .filter(|part| *part != "..")
            .map(folder)
            .collect(),
        name: name.to_string(),
        extension: extension.map(str::to_string),
    })
}

/// The two parts of `_N_POCKET_SPF`.
fn archived<'a>(part: &'a str, endings: &[&str]) -> Option<(&'a str, &'a str)> {
    let name = part.strip_prefix("_N_")?;
    let ending = endings.iter().find(|ending| name.ends_with(**ending))?;
    let (name, ending) = name.split_at(name.len() - ending.len());
    Some((name, ending.trim_start_matches('_')))
}

impl Interpreter<'_> {
    /// Runs the subprogram that a text names.
    pub(super) fn call_by_text(&mut self, text: &Expression, block: &Block, at: usize) -> Next {
        let called = self
            .find_by_text(text)
            .and_then(|(call, routine)| self.run_call(&call, &routine, block));
        self.after_call(called, at)
    }

    fn find_by_text(&mut self, text: &Expression) -> Result<(Call, Rc<Routine>), Diagnostic> {
        let named = match text.evaluate(&self.variables)? {
            Value::Text(text) => named(&text),
            Value::Number(_) => None,
        };
        let Some(named) = named else {
            return Err(
                Diagnostic::error(text.span, "this is not the name of a subprogram")
                    .help("write EXTCALL \"POCKET\" or EXTCALL \"JOB/POCKET.SPF\""),
            );
        };
        let call = Call {
            name: named.name.clone(),
            span: text.span,
            arguments: Vec::new(),
            passes: None,
        };
        let (sources, diagnostics) = (&mut *self.control.sources, &mut *self.control.diagnostics);
        let library = &mut self.library;
        let extension = named.extension.as_deref();
        let mut found = None;
        if extension.is_some() || !named.folders.is_empty() {
            found = library.find_file(&named.folders, &named.name, extension, sources, diagnostics);
        }
        let found = found.or_else(|| library.find(&named.name, sources, diagnostics));
        match found {
            Some(routine) => Ok((call, routine)),
            None => Err(missing(&named, &call)),
        }
    }
}

fn missing(named: &Named, call: &Call) -> Diagnostic {
    let name = &named.name;
    let file = name.to_ascii_lowercase();
    let looked_for = match &named.extension {
        Some(extension) => format!("{file}.{}", extension.to_ascii_lowercase()),
        None => format!("{file}.spf or {file}.mpf"),
    };
    Diagnostic::error(call.span, format!("the subprogram {name} was not found")).help(format!(
            "it is looked for as a section %_N_{name}_SPF of this file, and as {looked_for} beside it and in \
             the folders of --subprograms, and in those of its path there"
        ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subprograms_are_named_in_many_ways() {
        for (text, folders, name, extension) in [
            ("Pocket", &[][..], "POCKET", None),
            ("pocket.spf", &[], "POCKET", Some("SPF")),
            ("JOB/A.B.MPF", &["JOB"], "A.B", Some("MPF")),
            (
                "LOCAL_DRIVE:/job\\pocket.spf",
                &["LOCAL_DRIVE", "JOB"],
                "POCKET",
                Some("SPF"),
            ),
            (
                "/_N_WKS_DIR/_N_JOB_WPD/_N_POCKET_SPF",
                &["WKS", "JOB"],
                "POCKET",
                Some("SPF"),
            ),
            ("job.wpd/POCKET", &["JOB"], "POCKET", None),
            ("//R:/../POCKET", &["R"], "POCKET", None),
        ] {
            let wanted = Named {
                folders: folders.iter().map(|folder| folder.to_string()).collect(),
                name: name.to_string(),
                extension: extension.map(str::to_string),
            };
            assert_eq!(named(text), Some(wanted), "{text}");
        }
        for text in ["", " ", "/", "JOB/..", ".spf"] {
            assert_eq!(named(text), None, "{text}");
        }
    }
}
