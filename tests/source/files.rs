//! The Rust files below a folder.

use std::fs;
use std::path::Path;

/// Their paths from that folder on, `cycle/table.rs`.
pub fn of(root: &Path) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let name = path.strip_prefix(root).expect("inside");
                files.push(name.display().to_string());
            }
        }
    }
    files
}
