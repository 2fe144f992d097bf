//! `[FILTER]`: which part programs `framepath filter` translates, and with which arguments.

use super::FilterCheck;
use crate::check::finding::{Findings, Remedy, add, advice, replace};
use crate::machine::ini::Entry;
use crate::wiring::subject::Subject;
use std::path::Path;

const SECTION: &str = "FILTER";
const EXTENSIONS: &str = "PROGRAM_EXTENSION";

/// Endings of other controls, which LinuxCNC does not read itself.
const FOREIGN: [(&str, &str); 3] = [("mpf", "sinumerik"), ("spf", "sinumerik"), ("pim", "fagor")];

pub fn look(subject: &Subject, check: FilterCheck, findings: &mut Findings) {
    let entries = subject.ini.entries().iter();
    let filters: Vec<&Entry> = entries
        .filter(|entry| entry.section == SECTION && entry.key != EXTENSIONS && entry.is_read)
        .filter(|entry| program(&entry.value) == "framepath")
        .collect();
    for (index, filter) in filters.iter().enumerate() {
        line(subject, filter, check, findings);
        if filters[..index].iter().any(|other| other.key == filter.key) {
            let found = format!(
                "[{SECTION}]{} stands there before, and that one counts",
                filter.key
            );
            findings.warning(&filter.place, found, Remedy::Remove);
        }
    }
    endings(subject, &filters, findings);
}

/// The name of the program of a filter.
fn program(value: &str) -> &str {
    let path = value.split_whitespace().next().unwrap_or("");
    path.rsplit('/').next().unwrap_or("")
}

/// A line `mpf = framepath filter --dialect sinumerik`.
fn line(subject: &Subject, filter: &Entry, check: FilterCheck, findings: &mut Findings) {
    let place = &filter.place;
    if filter.raw != filter.value {
        let found =
            "the comment takes the name of the program away from the shell that runs this line";
        findings.error(
            place,
            found,
            replace(format!("{} = {}", filter.key, filter.value)),
        );
    }
    if let Some(ending) = filter.key.strip_prefix('.') {
        let found = format!("LinuxCNC looks for the ending without its point, {ending}");
        findings.error(
            place,
            found,
            replace(format!("{ending} = {}", filter.value)),
        );
    }
    let words: Vec<String> = filter.value.split_whitespace().map(str::to_owned).collect();
    let Some((name, arguments)) = words.split_first() else {
        return;
    };
    if !is_there(subject, name) {
        let found = format!("the program {name} is not found");
        findings.error(
            place,
            found,
            advice("make install puts it into /usr/bin; or write where it is"),
        );
    }
    match arguments.split_first() {
        Some((command, options)) if command == "filter" => {
            let mut all = vec!["filter".to_owned()];
            all.extend_from_slice(options);
            all.push("program".to_owned());
            if let Err(problem) = check(&all) {
                findings.error(
                    place,
                    format!("framepath refuses these arguments: {problem}"),
                    advice("man framepath has all of them"),
                );
            }
        }
        _ => {
            let found = "a filter is `framepath filter`, with options if need be";
            findings.error(
                place,
                found,
                replace(format!("{} = framepath filter", filter.key)),
            );
        }
    }
}

/// Whether the script `linuxcnc` would find a program: beside the INI file in `bin`, in `/usr/bin`, in `PATH`.
fn is_there(subject: &Subject, name: &str) -> bool {
    if name.contains('/') {
        return subject.path(name).is_file();
    }
    let own = [
        subject.folder().join("bin"),
        Path::new("/usr/bin").to_owned(),
    ];
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = own.into_iter().chain(std::env::split_paths(&path));
    folders
        .into_iter()
        .any(|folder| folder.join(name).is_file())
}

/// Endings that the screen offers, and those that are translated.
fn endings(subject: &Subject, filters: &[&Entry], findings: &mut Findings) {
    let offers = subject.all(SECTION, EXTENSIONS);
    let offered = |entry: &Entry| -> Vec<String> {
        let (list, _) = entry
            .value
            .split_once(char::is_whitespace)
            .unwrap_or((&entry.value, ""));
        list.split(',')
            .map(|ending| ending.trim().trim_start_matches('.').to_owned())
            .collect()
    };
    let is_offered = |ending: &str| {
        offers
            .iter()
            .any(|entry| offered(entry).iter().any(|known| known == ending))
    };
    let lost: Vec<&&Entry> = filters
        .iter()
        .filter(|filter| !is_offered(filter.key.trim_start_matches('.')))
        .collect();
    if let Some(first) = lost.first() {
        let list: Vec<String> = lost
            .iter()
            .map(|filter| format!(".{}", filter.key.trim_start_matches('.')))
            .collect();
        let found = format!(
            "the screen does not offer programs with the ending {}",
            list.join(", ")
        );
        let line = format!("{EXTENSIONS} = {} part program", list.join(","));
        findings.warning(&first.place, found, add(format!("[{SECTION}]"), line));
    }
    other_case(subject, filters, findings);
    for entry in offers {
        untranslated(subject, entry, &offered(entry), filters, findings);
    }
}

/// LinuxCNC looks for an ending as it is written, and programs come with capitals and without.
fn other_case(subject: &Subject, filters: &[&Entry], findings: &mut Findings) {
    for filter in filters {
        let own = filter.key.trim_start_matches('.');
        for ending in [own.to_ascii_lowercase(), own.to_ascii_uppercase()] {
            if ending == own || subject.text(SECTION, &ending).is_some() {
                continue;
            }
            let found = format!(
                "nothing translates programs with the ending .{ending}, which is not .{own} to LinuxCNC: it reads them as its own"
            );
            let line = format!("{ending} = {}", filter.value);
            findings.warning(&filter.place, found, add(format!("[{SECTION}]"), line));
        }
    }
}

/// Endings beside those that are translated, and endings of other controls.
fn untranslated(
    subject: &Subject,
    entry: &Entry,
    offered: &[String],
    filters: &[&Entry],
    findings: &mut Findings,
) {
    let is_ours = |ending: &String| {
        filters
            .iter()
            .any(|filter| filter.key.trim_start_matches('.') == ending)
    };
    let beside = offered.iter().find(|ending| is_ours(ending));
    for ending in offered {
        let foreign = FOREIGN.iter().find(|(known, _)| known == ending);
        if subject.text(SECTION, ending).is_some() || (beside.is_none() && foreign.is_none()) {
            continue;
        }
        // The same ending in the other case has been told of.
        let is_ending = |filter: &&Entry| {
            let key = filter.key.trim_start_matches('.');
            key.eq_ignore_ascii_case(ending)
        };
        if filters.iter().any(is_ending) {
            continue;
        }
        let value = match foreign {
            Some((_, dialect)) => format!("framepath filter --dialect {dialect}"),
            None => {
                let other = filters.iter().find(|filter| Some(&filter.key) == beside);
                other.map_or_else(String::new, |filter| filter.value.clone())
            }
        };
        let found = format!(
            "nothing translates programs with the ending .{ending}, and LinuxCNC reads them as its own"
        );
        findings.warning(
            &entry.place,
            found,
            add(format!("[{SECTION}]"), format!("{ending} = {value}")),
        );
    }
}
