//! The codes for the frame commands: lines `REMAP` of ours.

use crate::check::finding::{Findings, Remedy, add, replace};
use crate::machine::ini::Entry;
use crate::wiring::codes::{CODES, Code, Remap, code_of};
use crate::wiring::subject::Subject;

const SECTION: &str = "[RS274NGC]";

pub fn look(subject: &Subject, findings: &mut Findings) {
    let entries = subject.all("RS274NGC", "REMAP");
    let remaps: Vec<(&Entry, Remap)> = entries
        .into_iter()
        .map(|entry| (entry, Remap::parse(&entry.value)))
        .collect();
    for (index, (entry, remap)) in remaps.iter().enumerate() {
        ours(entry, remap, findings);
        if remaps[..index]
            .iter()
            .any(|(_, other)| other.code == remap.code)
        {
            let found = format!("{} is remapped twice", remap.code);
            findings.error(&entry.place, found, Remedy::Remove);
        }
    }
    missing(subject, &remaps, findings);
}

fn ours(entry: &Entry, remap: &Remap, findings: &mut Findings) {
    let subroutine = remap.subroutine.as_deref().unwrap_or("");
    let Some(code) = code_of(subroutine, &remap.code) else {
        return;
    };
    let wanted = Remap::parse(&code.value());
    let line = format!("REMAP = {}", code.value());
    if wanted.code != remap.code {
        let found = format!(
            "{} calls {}, which belongs to {}",
            remap.code, code.subroutine, code.code
        );
        findings.warning(&entry.place, found, replace(line));
    } else if wanted != *remap {
        let found = format!(
            "{}: {} does not get the words that it looks at",
            remap.code, code.subroutine
        );
        findings.error(&entry.place, found, replace(line));
    }
}

fn missing(subject: &Subject, remaps: &[(&Entry, Remap)], findings: &mut Findings) {
    let is_missing = |code: &&Code| !remaps.iter().any(|(_, remap)| remap.code == code.code);
    let codes: Vec<&Code> = CODES
        .iter()
        .filter(|code| code.code != "M6")
        .filter(is_missing)
        .collect();
    let place = subject.place_of("RS274NGC", "REMAP");
    if !codes.is_empty() {
        let names: Vec<&str> = codes.iter().map(|code| code.code).collect();
        let found = format!(
            "no remap, so that frames are called by o<..> call only: {}",
            names.join(" ")
        );
        let lines = codes
            .iter()
            .map(|code| format!("REMAP = {}", code.value()))
            .collect();
        let into = SECTION.to_owned();
        findings.note(&place, found, Remedy::Add { into, lines });
    }
    let change = CODES
        .iter()
        .find(|code| code.code == "M6")
        .filter(is_missing);
    let Some(change) = change else {
        return;
    };
    let line = format!("REMAP = {}", change.value());
    let moves = [
        "TOOL_CHANGE_POSITION",
        "TOOL_CHANGE_AT_G30",
        "TOOL_CHANGE_QUILL_UP",
    ];
    let moves = moves
        .into_iter()
        .find(|key| subject.text("EMCIO", key).is_some());
    match moves {
        Some(key) => {
            let found = format!("M6 moves by [EMCIO]{key}, through the frame that is active");
            findings.warning(&subject.place_of("EMCIO", key), found, add(SECTION, line));
        }
        None => {
            let found = "M6 is not remapped: it leaves the frame on while the tool is changed";
            findings.note(&place, found, add(SECTION, line));
        }
    }
}
