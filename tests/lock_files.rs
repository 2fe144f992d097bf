//! The fuzz targets are workspaces with lock files of their own, with which nothing else is built: a dependency that is new in the
//! core or in the tool has to be in them, too, or `make fuzz` and `make fuzz-filter` refuse to build.

use std::fs;
use std::path::Path;

/// A lock file, a package in it, and the manifest of that package.
const LOCKED: [(&str, &str, &str); 3] = [
    ("fuzz/Cargo.lock", "framepath", "Cargo.toml"),
    ("tool/fuzz/Cargo.lock", "framepath", "Cargo.toml"),
    ("tool/fuzz/Cargo.lock", "framepath-tool", "tool/Cargo.toml"),
];

fn text(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What a package needs whatever its features.
fn needed(manifest: &str) -> Vec<&str> {
    let table = manifest.split("\n[dependencies]\n").nth(1);
    let table = table.expect("dependencies").split("\n[").next();
    let lines = table.expect("a table").lines();
    let always = lines.filter(|line| !line.contains("optional = true"));
    always
        .filter_map(|line| Some(line.split_once(" = ")?.0))
        .filter(|name| !name.starts_with('#'))
        .collect()
}

/// What a lock file has for a package.
fn locked<'a>(lock: &'a str, package: &str) -> Vec<&'a str> {
    let entry = lock
        .split("[[package]]\n")
        .find(|entry| entry.starts_with(&format!("name = \"{package}\"\n")));
    let list = entry.unwrap_or_else(|| panic!("no {package}"));
    let lines = list.lines().filter_map(|line| line.strip_prefix(" \""));
    lines
        .filter_map(|line| line.split(['"', ' ']).next())
        .collect()
}

#[test]
fn fuzz_targets_are_locked_with_all_that_they_need() {
    for (lock_file, package, manifest_file) in LOCKED {
        let (lock, manifest) = (text(lock_file), text(manifest_file));
        let (needed, locked) = (needed(&manifest), locked(&lock, package));
        assert!(needed.contains(&"nalgebra"), "{manifest_file}: {needed:?}");
        let missing: Vec<_> = needed
            .iter()
            .filter(|name| !locked.contains(name))
            .collect();
        assert!(
            missing.is_empty(),
            "{lock_file} lacks {missing:?} of {package}: cargo update --workspace in its folder"
        );
    }
}
