//! TWOPASS, with which LinuxCNC runs the HAL files twice: what they load comes first, all of one module in one line.

use super::edits::Edits;
use crate::machine::place::Place;
use crate::machine::text_file;
use crate::wiring::subject::Subject;
use std::collections::BTreeMap;
use std::path::Path;

/// What HAL files in Tcl call that are made for it, as `::tp::passnumber`: without it the name is unknown, and LinuxCNC does not start.
const CALLED: &str = "::tp::";

/// Refuses it, since frames need to know what is loaded when, and what would not run without it.
pub fn refuse(subject: &Subject, edits: &mut Edits) {
    if subject.text("HAL", "TWOPASS").is_none() {
        return;
    }
    let place = subject.place_of("HAL", "TWOPASS");
    let help = format!(
        "remove TWOPASS, and load each module by one loadrt line{}, since LinuxCNC joins several with TWOPASS only; or do without \
         --frames",
        loaded_twice(subject)
    );
    edits.refuse(&place, "with TWOPASS HAL files run in another order", help);
    let unread = subject.script.unread.iter();
    let in_tcl = unread.filter_map(|unread| unread.tcl.as_ref());
    for file in subject.script.files.iter().chain(in_tcl) {
        if let Some(place) = call(file) {
            let help =
                "write it without this call before TWOPASS is removed, or do without --frames";
            edits.refuse(&place, format!("{CALLED} is there with TWOPASS only"), help);
        }
    }
}

/// The modules that several lines load, as far as the HAL files were read.
fn loaded_twice(subject: &Subject) -> String {
    let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for module in &subject.state.modules {
        let place = module.statement.place.to_string();
        places.entry(&module.name).or_default().push(place);
    }
    places.retain(|_, places| places.len() > 1);
    let named = |(module, places): (&str, Vec<String>)| format!("{module} ({})", places.join(", "));
    let named: Vec<String> = places.into_iter().map(named).collect();
    match named.is_empty() {
        true => String::new(),
        false => format!(": {}", named.join(", ")),
    }
}

/// The first call in a file, comments aside; one that cannot be read is refused elsewhere.
fn call(file: &Path) -> Option<Place> {
    let text = text_file::read(file).ok()?;
    let mut lines = text.lines().enumerate();
    let is_code = |line: &str| !line.trim_start().starts_with('#');
    let (index, line) = lines.find(|(_, line)| is_code(line) && line.contains(CALLED))?;
    let before = line.split(CALLED).next().unwrap_or("");
    Some(Place {
        line: index + 1,
        column: before.chars().count() + 1,
        ..Place::file(file)
    })
}
