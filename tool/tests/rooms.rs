//! The rooms of the tool, which are the folders and files of its sources, in their order: each imports
//! only those before it, so that there is no circle among them, and no command imports another.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What the commands share, and what each is for.
const ROOMS: [(&str, &str); 25] = [
    (
        "arguments",
        "what the commands share in reading their arguments",
    ),
    ("output", "files that are there whole or not at all"),
    ("signals", "being asked to stop"),
    ("json", "the one form of all JSON that is printed"),
    ("memory_file", "files in memory, for programs to be started"),
    (
        "generated",
        "programs that show what a planner does, and random numbers",
    ),
    ("encoding", "bytes to characters"),
    ("source", "texts, places in them"),
    ("diagnostics", "what is wrong, and where"),
    ("machine", "INI files, limits of joints and axes"),
    ("hal", "HAL files, and what is there when they have run"),
    (
        "wiring",
        "what the modules need in INI and HAL files, line by line",
    ),
    (
        "program",
        "a part program as blocks without a dialect; its contour",
    ),
    (
        "path",
        "segments and pieces of a path, rates of change along it",
    ),
    (
        "loaded",
        "modules of LinuxCNC's in a process that is none of it",
    ),
    ("joints", "joints behind kinematics, and their limits"),
    ("format", "numbers as text"),
    ("page", "pages with drawings"),
    ("dialects", "the languages of other controls, to blocks"),
    ("write", "blocks to LinuxCNC's language"),
    (
        "part_program",
        "a part program of any dialect: opened, traced, refused",
    ),
    (
        "canon",
        "a program as LinuxCNC's interpreter reads it: canonical calls",
    ),
    (
        "layer",
        "canonical calls to what the task controller hands over",
    ),
    ("optimum", "the least time on a path, and in a tolerance"),
    ("host", "planner modules in processes of their own"),
];

/// Each imports rooms only, and nothing but `main.rs` imports them.
const COMMANDS: [&str; 9] = [
    "completions",
    "filter",
    "generate",
    "record",
    "report",
    "plan",
    "compare",
    "check",
    "configure",
];

/// Holds the rooms together.
const FRAME: [&str; 2] = ["lib", "main"];

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// All Rust files, with the names of their modules: `src/layer/mod.rs` is `layer`.
fn modules(folder: &Path, names: &[String], found: &mut Vec<(Vec<String>, String)>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let file = entry.expect("an entry").path();
        let stem = file.file_stem().expect("a name").to_string_lossy();
        let mut names = names.to_vec();
        if stem != "mod" {
            names.push(stem.into_owned());
        }
        if file.is_dir() {
            modules(&file, &names, found);
        } else if file.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&file).expect("a text");
            found.push((names, text));
        }
    }
}

/// The name that `text` begins with, or the names of a group in braces.
fn first_names(text: &str) -> BTreeSet<String> {
    let name = |text: &str| -> String {
        let is_part = |c: &char| c.is_alphanumeric() || *c == '_';
        text.trim_start().chars().take_while(is_part).collect()
    };
    let Some(group) = text.strip_prefix('{') else {
        return BTreeSet::from([name(text)]);
    };
    let (mut depth, mut names, mut start) = (0, BTreeSet::new(), 0);
    for (at, character) in group.char_indices() {
        match character {
            '{' => depth += 1,
            ',' if depth == 0 => {
                names.insert(name(&group[start..]));
                start = at + 1;
            }
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            _ => {}
        }
    }
    names.insert(name(&group[start..]));
    // Behind the last comma is none.
    names.remove("");
    names
}

/// The top-level modules that a module's text names, by `crate::`, `framepath_tool::` or enough
/// `super::`.
fn named(module: &[String], text: &str) -> BTreeSet<String> {
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let mut found = BTreeSet::new();
    for root in ["crate::", "framepath_tool::"] {
        for (at, _) in code.match_indices(root) {
            let goes_on = code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
            if !goes_on {
                found.extend(first_names(&code[at + root.len()..]));
            }
        }
    }
    // As many as the module is deep lead out of its room, and one more from within its tests; from there
    // the names of rooms count, all others are its own.
    for (at, _) in code.match_indices(&"super::".repeat(module.len())) {
        let names = first_names(code[at..].trim_start_matches("super::"));
        let rooms = ROOMS.iter().map(|room| room.0).chain(COMMANDS);
        let rooms: BTreeSet<String> = rooms.map(str::to_owned).collect();
        found.extend(names.intersection(&rooms).cloned());
    }
    found
}

/// Each room with the rooms that it imports.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let mut found = Vec::new();
    modules(&sources(), &[], &mut found);
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, text) in found {
        let room = module.first().expect("a module").clone();
        let names = named(&module, &text);
        imports.entry(room).or_default().extend(names);
    }
    imports
}

#[test]
fn the_list_has_every_room() {
    let rooms = ROOMS.iter().map(|room| room.0);
    let known: BTreeSet<&str> = rooms.chain(COMMANDS).chain(FRAME).collect();
    let imports = imports();
    let there: BTreeSet<&str> = imports.keys().map(String::as_str).collect();
    assert_eq!(there, known);
}

#[test]
fn rooms_import_only_what_comes_before_them() {
    let imports = imports();
    let order: Vec<&str> = ROOMS.iter().map(|room| room.0).collect();
    let mut back = Vec::new();
    for (room, imported) in &imports {
        let before = match order.iter().position(|name| name == room) {
            Some(place) => &order[..place],
            None => &order[..],
        };
        for other in imported {
            let own = other == room;
            let command = room == "main" && COMMANDS.contains(&other.as_str());
            if !own && !command && !before.contains(&other.as_str()) {
                back.push(format!("{room} imports {other}"));
            }
        }
    }
    assert!(back.is_empty(), "{}", back.join("\n"));
}

#[test]
fn imports_are_found_in_all_their_forms() {
    let module = ["layer".to_owned(), "arc".to_owned()];
    let text = "use crate::canon::Call;\nuse crate::{\n    path::{Position, segment},\n    machine,\n};\n\
                // crate::plan\nfn f() { crate::format::length(0.0); super::super::report::run() }\n\
                mod tests { use super::super::super::host; use super::super::lay; }\n";
    let found: Vec<String> = named(&module, text).into_iter().collect();
    assert_eq!(
        found,
        ["canon", "format", "host", "machine", "path", "report"]
    );
}
