//! No function of `src`, and no file, is so long that it cannot be taken in at once.

#[path = "source/files.rs"]
mod files;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Block, ImplItemFn, ItemFn, Signature, TraitItemFn};

/// Lines from the first one of the signature to the closing brace.
const MOST_LINES: usize = 60;

/// Lines of a file.
const MOST_LINES_OF_A_FILE: usize = 500;

/// Folders with files of source.
const FOLDERS: [&str; 8] = [
    "benches",
    "build",
    "demo",
    "fuzz",
    "hal-component",
    "src",
    "tests",
    "tool",
];

/// Longer ones, as `file: function`, each with the reason why it is not split.
const LONGER: &[(&str, &str)] = &[];

/// The functions of a file that are too long, with their lines.
#[derive(Default)]
struct Long(Vec<(String, usize)>);

impl Long {
    fn of(text: &str) -> Vec<(String, usize)> {
        let mut long = Self::default();
        long.visit_file(&syn::parse_file(text).expect("Rust"));
        long.0
    }

    fn look(&mut self, signature: &Signature, block: &Block) {
        let line = |span: Span| (span.start().line, span.end().line);
        let lines = line(block.span()).1 + 1 - line(signature.span()).0;
        if lines > MOST_LINES {
            self.0.push((signature.ident.to_string(), lines));
        }
    }
}

impl<'a> Visit<'a> for Long {
    fn visit_item_fn(&mut self, item: &'a ItemFn) {
        self.look(&item.sig, &item.block);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'a ImplItemFn) {
        self.look(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'a TraitItemFn) {
        if let Some(block) = &item.default {
            self.look(&item.sig, block);
        }
        visit::visit_trait_item_fn(self, item);
    }
}

/// The functions of `src` that are too long.
fn found() -> BTreeMap<String, usize> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut long = BTreeMap::new();
    for path in files::of(&root) {
        let text = fs::read_to_string(root.join(&path)).expect("text");
        for (name, lines) in Long::of(&text) {
            long.insert(format!("{path}: {name}"), lines);
        }
    }
    long
}

#[test]
fn no_function_is_longer_than_60_lines_without_a_reason() {
    let mut found = found();
    for (function, reason) in LONGER {
        assert!(!reason.is_empty(), "{function}: no reason");
        assert!(
            found.remove(*function).is_some(),
            "{function} is not that long any more"
        );
    }
    assert!(
        found.is_empty(),
        "longer than {MOST_LINES} lines, to be split, or listed with the reason: {found:#?}"
    );
}

#[test]
fn no_file_is_longer_than_500_lines() {
    let mut count = 0;
    let mut long = Vec::new();
    for folder in FOLDERS {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for path in files::with_endings(&root, &["rs", "py", "c", "h", "cc", "hh"]) {
            let text = fs::read_to_string(root.join(&path)).expect("text");
            count += 1;
            if text.lines().count() > MOST_LINES_OF_A_FILE {
                long.push(format!("{folder}/{path}"));
            }
        }
    }
    assert!(long.is_empty(), "to be split: {long:#?}");
    assert!(count > 900, "{count} files: are they found at all?");
}

#[test]
fn what_is_too_long_is_found() {
    let long = |lines: usize| "x();\n".repeat(lines - 2);
    let text = format!(
        "fn short() {{\n{}}}\nfn long() {{\n{}}}\nstruct A;\nimpl A {{ fn inside(\n) {{\n{}}} }}\n\
         #[cfg(test)] mod tests {{ fn of_tests() {{\n{}}} }}",
        long(60),
        long(61),
        long(60),
        long(70),
    );
    let found: Vec<_> = Long::of(&text).into_iter().collect();
    assert_eq!(
        found,
        [("long", 61), ("inside", 61), ("of_tests", 70)]
            .map(|(name, lines)| (name.to_owned(), lines))
    );
}
