//! include/framepath.h is what the C side compiles against: it must say what the Rust side defines.

use std::path::Path;

/// The header as cbindgen writes it from the sources of the interface.
fn generated() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("include/cbindgen.toml"))
        .expect("cbindgen.toml is readable");
    let builder = cbindgen::Builder::new()
        .with_config(config)
        .with_src(root.join("src/abi/mod.rs"));
    let mut text = Vec::new();
    builder
        .generate()
        .expect("the interface can be written in C")
        .write(&mut text);
    String::from_utf8(text).expect("the header is UTF-8")
}

#[test]
fn the_committed_header_is_what_the_interface_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/framepath.h");
    let generated = generated();
    if std::env::var_os("FRAMEPATH_WRITE_HEADER").is_some() {
        std::fs::write(&path, &generated).expect("include/framepath.h is writable");
    }
    let committed = std::fs::read_to_string(&path).expect("include/framepath.h is there");
    assert!(
        committed == generated,
        "include/framepath.h differs from the interface in src/abi: write it anew with `make header` and look at the change"
    );
}
