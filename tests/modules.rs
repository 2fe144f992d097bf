//! The two modules as `make modules` leaves them: what they export, and what they must not contain.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

const MOTMOD: &str = "/usr/lib/linuxcnc/modules/motmod.so";

/// A module built by `make modules`.
fn module(name: &str) -> PathBuf {
    let folder = std::env::var_os("FRAMEPATH_MODULES").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("target/modules"),
        PathBuf::from,
    );
    let path = folder.join(name);
    assert!(
        path.exists(),
        "{} is missing: run `make modules` first",
        path.display()
    );
    path
}

/// The dynamic symbols of an object, by nm's own selection.
fn dynamic_symbols(path: &Path, which: &str) -> BTreeSet<String> {
    let output = Command::new("nm")
        .args(["-D", which, "--format=just-symbols"])
        .arg(path)
        .output()
        .expect("nm runs");
    assert!(
        output.status.success(),
        "nm: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(|line| line.split('@').next().unwrap_or(line).to_string())
        .collect()
}

/// What motmod wants of somebody else, among names that begin like this.
fn motmod_imports(prefixes: &[&str]) -> BTreeSet<String> {
    dynamic_symbols(Path::new(MOTMOD), "--undefined-only")
        .into_iter()
        .filter(|name| prefixes.iter().any(|prefix| name.starts_with(prefix)))
        .collect()
}

#[test]
fn blendtp_exports_what_motmod_imports() {
    let imports = motmod_imports(&["tp", "tcq"]);
    assert!(imports.len() > 20, "motmod imports a planner: {imports:?}");
    let exports = dynamic_symbols(&module("blendtp.so"), "--defined-only");
    let missing: Vec<_> = imports.difference(&exports).collect();
    assert!(missing.is_empty(), "blendtp.so lacks {missing:?}");
}

#[test]
fn framekins_exports_what_motmod_imports() {
    let imports = motmod_imports(&["kinematics"]);
    assert!(imports.len() >= 5, "motmod imports kinematics: {imports:?}");
    let exports = dynamic_symbols(&module("framekins.so"), "--defined-only");
    let missing: Vec<_> = imports.difference(&exports).collect();
    assert!(missing.is_empty(), "framekins.so lacks {missing:?}");
}

#[test]
fn the_modules_export_nothing_else() {
    for name in ["blendtp.so", "framekins.so"] {
        let foreign: Vec<_> = dynamic_symbols(&module(name), "--defined-only")
            .into_iter()
            .filter(|symbol| {
                !["tp", "tcq", "kinematics", "rtapi_", "framekins"]
                    .iter()
                    .any(|prefix| symbol.starts_with(prefix))
            })
            .collect();
        assert!(
            foreign.is_empty(),
            "{name} exports {foreign:?}, which could collide with another module"
        );
    }
}

#[test]
fn the_modules_can_neither_panic_nor_allocate() {
    for name in ["blendtp.so", "framekins.so"] {
        let output = Command::new("nm")
            .arg("-C")
            .arg(module(name))
            .output()
            .expect("nm runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(text.contains("rtapi_app_main"), "nm reads {name}");
        let forbidden = [
            "panic",
            "unwind",
            "__rust_alloc",
            "__rdl_",
            " malloc",
            " calloc",
            " realloc",
            " free",
            "__tls",
        ];
        let found: Vec<_> = text
            .lines()
            .filter(|line| forbidden.iter().any(|word| line.contains(word)))
            .collect();
        assert!(found.is_empty(), "{name}: {found:?}");
    }
}

/// The tool has that of Rust's library, whose last digit is another one.
#[test]
fn the_modules_take_no_cube_root_from_the_c_library() {
    for name in ["blendtp.so", "framekins.so"] {
        let imports = dynamic_symbols(&module(name), "--undefined-only");
        assert!(!imports.contains("cbrt"), "{name} calls cbrt");
    }
}
