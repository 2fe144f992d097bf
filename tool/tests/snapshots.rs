//! Each snapshot belongs to a test.

use std::fs;
use std::path::{Path, PathBuf};

/// All snapshots below a folder.
fn snapshots(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            snapshots(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "snap") {
            found.push(path);
        }
    }
}

#[test]
fn no_snapshot_is_left_behind() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for folder in ["src", "tests"] {
        snapshots(&root.join(folder), &mut found);
    }
    assert!(found.len() >= 5, "the snapshots are found: {found:?}");
    for path in found {
        let text = fs::read_to_string(&path).expect("a text");
        let source = text.lines().find_map(|line| line.strip_prefix("source: "));
        let source = source.expect("where it comes from");
        let source = root.join("..").join(source);
        let source = fs::read_to_string(&source).unwrap_or_default();
        let name = path.file_stem().expect("a name").to_string_lossy();
        let name = name.rsplit("__").next().unwrap_or_default();
        assert!(
            source.contains(&format!("assert_snapshot!(\"{name}\"")),
            "no test takes {}",
            path.display()
        );
    }
}
