//! What the documents name is there and as they say: names and values change, and documents are forgotten.

use std::path::{Path, PathBuf};

use framepath::planner::Planner;

/// Folders that hold what is named.
const FOLDERS: [&str; 8] = [
    "benches",
    "demo",
    "docs",
    "fuzz",
    "hal-component",
    "src",
    "tests",
    "tool",
];

const ENDINGS: [&str; 7] = [".rs", ".py", ".md", ".c", ".h", ".ini", ".ngc"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below a folder of the project, as paths from its root with `/`.
fn files(folder: &Path, found: &mut Vec<String>) {
    for entry in folder.read_dir().expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() && !path.ends_with("target") {
            files(&path, found);
        } else {
            let inside = path.strip_prefix(root()).expect("inside");
            found.push(inside.display().to_string());
        }
    }
}

fn documents() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    files(&root().join("docs"), &mut pages);
    pages.retain(|name| name.ends_with(".md"));
    ["README.md", "DESIGN.md", "CONTRIBUTING.md"]
        .map(String::from)
        .into_iter()
        .chain(pages)
        .map(|name| root().join(name))
        .collect()
}

/// What stands between backquotes and reads as a file of the project.
fn named(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .flat_map(|line| line.split('`').skip(1).step_by(2))
        .filter(|name| ENDINGS.iter().any(|ending| name.ends_with(ending)))
        .filter(|name| !name.contains([' ', '*', '<', '(', '=']) && !name.starts_with('/'))
}

#[test]
fn files_that_are_named_exist() {
    let mut there = Vec::new();
    for folder in FOLDERS {
        files(&root().join(folder), &mut there);
    }
    let exists = |name: &str| {
        root().join(name).exists()
            || there
                .iter()
                .any(|path| path == name || path.ends_with(&format!("/{name}")))
    };
    let mut count = 0;
    let mut missing = Vec::new();
    for document in documents() {
        let text = std::fs::read_to_string(&document).expect("a text");
        for name in named(&text) {
            count += 1;
            if !exists(name) {
                missing.push(format!("{}: {name}", document.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
    assert!(
        count > 100,
        "{count} files are named: are they found at all?"
    );
}

/// The links that a text defines for the names in it, `[name]: target`.
fn definitions(text: &str) -> Vec<(&str, &str)> {
    text.lines()
        .filter_map(|line| line.strip_prefix('[')?.split_once("]: "))
        .collect()
}

/// The names of headings in links.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let name = line.trim_start_matches('#').trim().to_lowercase();
            let kept = name
                .chars()
                .filter(|c| c.is_alphanumeric() || "-_ ".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// Whether a link leads from a page in this folder to a file that is there and, where it names one, to a heading of it.
/// DESIGN and CONTRIBUTING are pages of the book by files that include them.
fn leads_somewhere(folder: &Path, own_text: &str, link: &str) -> bool {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let text = match file.rsplit('/').next() {
        Some("") => return anchors(own_text).iter().any(|name| name == anchor),
        Some("design.md") => root().join("DESIGN.md"),
        Some("contributing.md") => root().join("CONTRIBUTING.md"),
        _ => folder.join(file),
    };
    if !folder.join(file).exists() {
        return false;
    }
    let is_named = |text: String| anchors(&text).iter().any(|name| name == anchor);
    anchor.is_empty() || std::fs::read_to_string(text).is_ok_and(is_named)
}

/// CONTRIBUTING is a page of the book, too, as if it was in docs. DESIGN has its links from the root.
#[test]
fn links_lead_to_pages_and_their_headings() {
    let mut dead = Vec::new();
    let mut count = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).expect("a text");
        let folder = if document.ends_with("CONTRIBUTING.md") {
            root().join("docs")
        } else {
            document.parent().expect("a folder").to_owned()
        };
        let inside = text.split("](").skip(1);
        let inside = inside.filter_map(|behind| behind.split(')').next());
        let defined = definitions(&text).into_iter().map(|(_, link)| link);
        for link in inside.chain(defined) {
            count += 1;
            if !link.starts_with("http") && !leads_somewhere(&folder, &text, link) {
                dead.push(format!("{}: {link}", document.display()));
            }
        }
    }
    assert!(dead.is_empty(), "{dead:#?}");
    assert!(count > 100, "{count} links: are they found at all?");
}

/// In the book the links of DESIGN are those that docs/design.md defines before it includes it: the first definition holds.
#[test]
fn design_has_the_same_links_in_the_book() {
    let [design, page] = ["DESIGN.md", "docs/design.md"]
        .map(|name| std::fs::read_to_string(root().join(name)).expect("a text"));
    let defined = definitions(&design);
    let from_docs: Vec<_> = defined
        .iter()
        .map(|(name, link)| (*name, link.strip_prefix("docs/").expect("a page of docs")))
        .collect();
    assert_eq!(from_docs, definitions(&page));
    let used = design.split("][").skip(1);
    let used: Vec<_> = used.filter_map(|behind| behind.split(']').next()).collect();
    for (name, _) in &defined {
        assert!(used.contains(name), "{name} is defined and not used");
    }
    for name in used {
        assert!(
            defined.iter().any(|(there, _)| *there == name),
            "{name} is not defined"
        );
    }
}

/// Every page of docs is in the book.
#[test]
fn the_book_has_every_page() {
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md")).expect("a summary");
    let mut pages = Vec::new();
    files(&root().join("docs"), &mut pages);
    for page in pages.iter().filter(|page| page.ends_with(".md")) {
        let name = page.trim_start_matches("docs/");
        let is_there = summary.contains(&format!("]({name})"));
        assert!(
            is_there || name == "SUMMARY.md",
            "{name} is not in docs/SUMMARY.md"
        );
    }
}

/// The value that a file of the core gives a constant.
fn value_of(constant: &str, file: &str) -> Option<String> {
    let text = std::fs::read_to_string(root().join("src").join(file)).ok()?;
    let (_, declared) = text.split_once(&format!("const {constant}: "))?;
    let (_, value) = declared.split_once(';')?.0.split_once(" = ")?;
    Some(value.to_owned())
}

#[test]
fn constants_that_tune_have_the_values_of_their_page() {
    let page = std::fs::read_to_string(root().join("docs/tuning.md")).expect("docs/tuning.md");
    let mut count = 0;
    for line in page.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, constant, file, value, _, measured @ ..] = &cells[..] else {
            panic!("a row of another shape: {line}");
        };
        let [constant, file] = [constant, file].map(|cell| cell.trim_matches('`'));
        assert_eq!(value_of(constant, file).as_deref(), Some(*value), "{line}");
        assert!(
            measured[..4].iter().all(|cell| !cell.is_empty()),
            "not measured: {line}"
        );
        count += 1;
    }
    assert!(count > 10, "{count} constants");
}

#[cfg(target_pointer_width = "64")]
#[test]
fn the_planner_is_as_large_as_is_said() {
    let said = format!("{:.0} MB", size_of::<Planner>() as f64 / 1e6);
    for name in ["DESIGN.md", "src/planner/planner.rs", "src/test_room.rs"] {
        let text = std::fs::read_to_string(root().join(name)).expect("a text");
        assert!(text.contains(&said), "{name}: not {said}");
    }
}

/// The numbers that a file of the core names outside of its tests.
fn named_numbers(text: &str) -> Vec<String> {
    const NUMBERS: [&str; 7] = ["f64", "f32", "usize", "u32", "u64", "[f", "RangeInclusive"];
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let declared = code.lines().filter_map(|line| {
        let (visible, declaration) = line.trim_start().split_once("const ")?;
        let (name, kind) = declaration.split_once(": ")?;
        let is_name = name
            .chars()
            .all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
        let is_number = NUMBERS.iter().any(|number| kind.starts_with(number));
        let indented = line.len() - line.trim_start().len();
        let is_item = indented <= 4 && !visible.contains('<');
        (is_item && is_name && is_number).then(|| name.to_owned())
    });
    declared.collect()
}

#[test]
fn every_named_number_of_the_planner_has_its_kind() {
    let page = std::fs::read_to_string(root().join("docs/tuning.md")).expect("docs/tuning.md");
    let mut listed = Vec::new();
    for line in page
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains(".rs | "))
    {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        for name in cells[2..].join(" ").split_whitespace() {
            listed.push(format!("{} {}", cells[1], name.trim_matches('`')));
        }
    }
    let mut all = Vec::new();
    for folder in ["path", "speed", "planner", "cycle"] {
        let mut files_there = Vec::new();
        files(&root().join("src").join(folder), &mut files_there);
        // What a file of tests names is of the tests.
        files_there.retain(|file| !file.ends_with("/tests.rs"));
        for file in files_there {
            let text = std::fs::read_to_string(root().join(&file)).expect("a text");
            let inside = file.trim_start_matches("src/");
            all.extend(
                named_numbers(&text)
                    .iter()
                    .map(|name| format!("{inside} {name}")),
            );
        }
    }
    listed.sort();
    all.sort();
    let only_in = |some: &[String], others: &[String]| -> Vec<String> {
        let missing = some
            .iter()
            .filter(|name| others.binary_search(name).is_err());
        missing.cloned().collect()
    };
    assert!(
        all.len() > 200,
        "{} numbers: are they found at all?",
        all.len()
    );
    let [new, gone] = [only_in(&all, &listed), only_in(&listed, &all)];
    assert!(
        new.is_empty() && gone.is_empty(),
        "docs/tuning.md, the table of all of them: {new:#?} have no place there, {gone:#?} are no more"
    );
}
