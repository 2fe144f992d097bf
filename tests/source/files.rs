//! The files of source below a folder.

use std::fs;
use std::path::Path;

/// The paths of those in Rust from that folder on, `cycle/table.rs`.
pub fn of(root: &Path) -> Vec<String> {
    with_endings(root, &["rs"])
}

/// The same of files with these endings. What cargo has built is none.
pub fn with_endings(root: &Path, endings: &[&str]) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if path.is_dir() {
                folders.extend((!path.ends_with("target")).then_some(path));
            } else if ending.is_some_and(|ending| endings.contains(&ending)) {
                let name = path.strip_prefix(root).expect("inside");
                files.push(name.display().to_string());
            }
        }
    }
    files
}
