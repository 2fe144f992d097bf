//! The folders of `src` stand in one order, and no file of it leads back to itself through what it imports.

#[path = "source/files.rs"]
mod files;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use syn::visit::{self, Visit};
use syn::{Attribute, ItemMod, ItemUse, UseTree, Visibility};

/// No folder imports one that comes behind it. What both modules use; framekins; blendtp; the edge to C.
const ORDER: [&str; 16] = [
    "axes",
    "cube_root",
    "ring",
    "test_room", // both
    "frame",
    "machine",
    "kinematics", // framekins
    "numerical_jet",
    "machine_map",
    "lanes",
    "moves",
    "path",
    "speed",
    "cycle",
    "planner", // blendtp
    "abi",
];

/// What a file names of others, as paths from the root.
#[derive(Default)]
struct Source {
    /// Where it is, and whether it is the head of a folder.
    module: Vec<String>,
    is_head: bool,
    named: BTreeSet<Vec<String>>,
    /// What the head of a folder hands on from its files, by the name it has there.
    handed_on: BTreeMap<String, Vec<String>>,
}

/// All files by their module, `cycle::table`.
struct Sources(BTreeMap<String, Source>);

impl Sources {
    fn parse(files: &[(String, String)]) -> Self {
        let mut sources: BTreeMap<String, Source> = BTreeMap::new();
        let modules: BTreeSet<Vec<String>> =
            files.iter().map(|(path, _)| module_of(path)).collect();
        for (path, text) in files {
            let mut reader = Reader {
                modules: &modules,
                source: Source {
                    module: module_of(path),
                    is_head: path.ends_with("mod.rs") || path == "lib.rs",
                    ..Source::default()
                },
            };
            let file = syn::parse_file(text).unwrap_or_else(|error| panic!("{path}: {error}"));
            reader.visit_file(&file);
            sources.insert(reader.source.module.join("::"), reader.source);
        }
        Self(sources)
    }

    fn of_this_crate() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let text = |name: &String| fs::read_to_string(root.join(name)).expect("text");
        let files: Vec<_> = files::of(&root)
            .into_iter()
            .map(|name| (name.clone(), text(&name)))
            .collect();
        Self::parse(&files)
    }

    /// The file that defines what this path names.
    fn definer(&self, path: &[String]) -> Option<&str> {
        let mut path = path.to_vec();
        // A name may be handed on more than once.
        for _ in 0..8 {
            let length = (0..=path.len())
                .rev()
                .find(|length| self.0.contains_key(&path[..*length].join("::")))?;
            let (name, source) = self.0.get_key_value(&path[..length].join("::"))?;
            match path.get(length).and_then(|item| source.handed_on.get(item)) {
                Some(further) => path
                    .splice(..=length, further.iter().cloned())
                    .for_each(drop),
                None => return Some(name),
            }
        }
        None
    }

    /// Which files each one imports.
    fn imports(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let of = |(name, source): (&'_ String, &'_ Source)| {
            let found = source.named.iter().filter_map(|path| self.definer(path));
            found
                .filter(|other| other != name)
                .map(str::to_owned)
                .collect::<BTreeSet<_>>()
        };
        self.0
            .iter()
            .map(|(name, source)| {
                let imported = of((name, source));
                let known = imported
                    .iter()
                    .filter_map(|other| self.0.get_key_value(other));
                (
                    name.as_str(),
                    known.map(|(other, _)| other.as_str()).collect(),
                )
            })
            .collect()
    }

    /// Imports of a folder that comes later.
    fn back_imports(&self) -> Vec<String> {
        let place = |module: &str| {
            let folder = module.split("::").next().unwrap_or_default();
            ORDER.iter().position(|known| *known == folder)
        };
        let mut found = Vec::new();
        for (file, imported) in self.imports() {
            // lib.rs
            if file.is_empty() {
                continue;
            }
            let here = place(file).unwrap_or_else(|| panic!("{file} has no place in the order"));
            for other in imported {
                if place(other).is_none_or(|there| there > here) {
                    found.push(format!("{file} imports {other}"));
                }
            }
        }
        found
    }

    /// Files that lead back to themselves, with those that they lead to.
    fn circles(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut left = self.imports();
        loop {
            let ends: BTreeSet<&str> = left
                .iter()
                .filter(|(_, others)| others.is_empty())
                .map(|(file, _)| *file)
                .collect();
            if ends.is_empty() {
                return left;
            }
            left.retain(|file, _| !ends.contains(file));
            for others in left.values_mut() {
                others.retain(|other| !ends.contains(other));
            }
        }
    }
}

/// `cycle/table.rs` is `cycle::table`, `cycle/mod.rs` is `cycle`.
fn module_of(path: &str) -> Vec<String> {
    let path = path.trim_end_matches(".rs");
    let parts = path
        .split('/')
        .filter(|part| !["mod", "lib"].contains(part));
    parts.map(str::to_owned).collect()
}

struct Reader<'a> {
    modules: &'a BTreeSet<Vec<String>>,
    source: Source,
}

impl Reader<'_> {
    /// The path from the root; `None` for what belongs to other crates, or to the file itself.
    fn absolute(&self, path: &[String]) -> Option<Vec<String>> {
        let here = &self.source.module;
        let up = path.iter().take_while(|part| *part == "super").count();
        let (base, rest) = match path.first()?.as_str() {
            "crate" => (&here[..0], &path[1..]),
            "self" => (&here[..], &path[1..]),
            "super" => (&here[..here.len().checked_sub(up)?], &path[up..]),
            child => {
                let child = [here.as_slice(), &[child.to_owned()]].concat();
                self.modules.contains(&child).then_some((&here[..], path))?
            }
        };
        Some([base, rest].concat())
    }

    fn names(&mut self, path: &[String]) {
        self.source.named.extend(self.absolute(path));
    }

    fn uses(&mut self, before: &[String], tree: &UseTree, handed_on: bool) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        let (path, name) = match tree {
            UseTree::Path(path) => return self.uses(&with(&path.ident), &path.tree, handed_on),
            UseTree::Group(group) => {
                return group
                    .items
                    .iter()
                    .for_each(|tree| self.uses(before, tree, handed_on));
            }
            UseTree::Name(name) if name.ident == "self" => (before.to_vec(), None),
            UseTree::Name(name) => (with(&name.ident), Some(name.ident.to_string())),
            UseTree::Rename(rename) => (with(&rename.ident), Some(rename.rename.to_string())),
            UseTree::Glob(_) => (before.to_vec(), None),
        };
        match (handed_on, name, self.absolute(&path)) {
            (true, Some(name), Some(path)) => drop(self.source.handed_on.insert(name, path)),
            _ => self.names(&path),
        }
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    let mut conditions = attributes
        .iter()
        .filter(|attribute| attribute.path().is_ident("cfg"));
    conditions.any(|attribute| {
        attribute
            .parse_args::<syn::Ident>()
            .is_ok_and(|ident| ident == "test")
    })
}

impl<'a> Visit<'a> for Reader<'_> {
    fn visit_item_mod(&mut self, item: &'a ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_use(&mut self, item: &'a ItemUse) {
        if !is_test(&item.attrs) {
            let handed_on = self.source.is_head && !matches!(item.vis, Visibility::Inherited);
            self.uses(&[], &item.tree, handed_on);
        }
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        let parts: Vec<String> = path
            .segments
            .iter()
            .map(|part| part.ident.to_string())
            .collect();
        if parts.len() > 1 {
            self.names(&parts);
        }
        visit::visit_path(self, path);
    }
}

#[test]
fn no_folder_imports_one_that_comes_behind_it() {
    assert_eq!(
        Sources::of_this_crate().back_imports(),
        Vec::<String>::new()
    );
}

#[test]
fn no_file_leads_back_to_itself() {
    let sources = Sources::of_this_crate();
    assert!(sources.0.len() > 100, "the files are found");
    let circles = sources.circles();
    assert!(circles.is_empty(), "{circles:#?}");
}

#[test]
fn what_is_wrong_is_found() {
    let of = |files: &[(&str, &str)]| {
        let files: Vec<_> = files
            .iter()
            .map(|(path, text)| (path.to_string(), text.to_string()))
            .collect();
        Sources::parse(&files)
    };
    let back = of(&[
        ("path/mod.rs", "mod leg; pub use leg::Leg;"),
        ("path/leg.rs", "pub struct Leg;"),
        ("moves/mod.rs", "mod queue;"),
        (
            "moves/queue.rs",
            "use crate::path::Leg; #[cfg(test)] mod tests { use crate::abi::Pose; }",
        ),
        (
            "abi/mod.rs",
            "pub struct Pose; fn f() -> crate::moves::Move { todo() }",
        ),
    ]);
    assert_eq!(back.back_imports(), ["moves::queue imports path::leg"]);
    assert!(back.circles().is_empty());
    // Through the head of a folder, a path in an expression, and a name that is handed on.
    let circle = of(&[
        (
            "cycle/mod.rs",
            "mod table; mod cap; mod rows; pub use table::Table;",
        ),
        ("cycle/table.rs", "fn f() { super::cap::greatest(); }"),
        ("cycle/cap.rs", "use super::rows::Rows;"),
        ("cycle/rows.rs", "use crate::{axes, cycle::{Table as T}};"),
        ("axes.rs", "pub struct Axes;"),
    ]);
    let found: Vec<&str> = circle.circles().keys().copied().collect();
    assert_eq!(found, ["cycle::cap", "cycle::rows", "cycle::table"]);
    assert_eq!(circle.back_imports(), Vec::<String>::new());
}
