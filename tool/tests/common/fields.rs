//! The fields of the JSON that a command prints are those of `docs/json.md`, no more and no less.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// Fields by their paths, `axes[].peaks[].limit`: those with a value, and those that were only seen
/// without one.
#[derive(Default)]
struct Seen {
    with_value: BTreeSet<String>,
    without: BTreeSet<String>,
}

impl Seen {
    fn note(&mut self, path: &str, value: &Value) {
        match value {
            Value::Null => drop(self.without.insert(path.to_owned())),
            Value::Object(fields) => {
                for (name, value) in fields {
                    let point = if path.is_empty() { "" } else { "." };
                    self.note(&format!("{path}{point}{name}"), value);
                }
            }
            Value::Array(elements) => {
                let path = format!("{path}[]");
                self.without.insert(path.clone());
                for element in elements {
                    self.note(&path, element);
                }
            }
            _ => drop(self.with_value.insert(path.to_owned())),
        }
    }

    /// All of them; what is missing here and an object or a list elsewhere counts as that.
    fn fields(self) -> BTreeSet<String> {
        let inside = |outer: &str, inner: &str| {
            let rest = inner.strip_prefix(outer);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        let all: BTreeSet<String> = self.with_value.union(&self.without).cloned().collect();
        let is_field = |path: &&String| {
            self.with_value.contains(*path) || !all.iter().any(|other| inside(path, other))
        };
        all.iter().filter(is_field).cloned().collect()
    }
}

/// What the page has under the heading of a command, and of all commands.
fn documented(command: &str) -> BTreeSet<String> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/json.md");
    let page = std::fs::read_to_string(page).expect("docs/json.md");
    let mut found = BTreeSet::new();
    for section in page.split("\n## ").skip(1) {
        let (heading, text) = section.split_once('\n').expect("a text");
        if heading != command && heading != "All commands" {
            continue;
        }
        let rows = text.lines().filter(|line| line.starts_with("| `"));
        for row in rows {
            let cells: Vec<&str> = row.split('|').collect();
            assert_eq!(cells.len(), 5, "field, unit and meaning: {row}");
            let names = cells[1].split('`').skip(1).step_by(2);
            for name in names {
                assert!(found.insert(name.to_owned()), "{name} stands there twice");
            }
        }
    }
    found
}

/// Asserts that these outputs of a command together have the fields that the page names.
#[track_caller]
pub fn assert_documented(command: &str, outputs: &[Value]) {
    let mut seen = Seen::default();
    for output in outputs {
        assert_eq!(output["framepath"]["command"], command);
        assert_eq!(output["framepath"]["format"], 1);
        seen.note("", output);
    }
    let (seen, documented) = (seen.fields(), documented(command));
    let printed: Vec<_> = seen.difference(&documented).collect();
    assert!(printed.is_empty(), "not in docs/json.md: {printed:#?}");
    let named: Vec<_> = documented.difference(&seen).collect();
    assert!(named.is_empty(), "not printed: {named:#?}");
}
