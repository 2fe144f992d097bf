//! Reads LinuxCNC's headers, so that the shared structures always have the layout of the LinuxCNC
//! that the modules are built for, and compiles the C compiler's own view of that layout for the
//! tests to compare with.

use std::env;
use std::path::{Path, PathBuf};
use std::process::exit;

/// What LinuxCNC's headers want to know about the platform: a user-space build of a real-time part.
const DEFINES: [&str; 2] = ["RTAPI", "USPACE"];

include!("headers.rs");

pub fn build() {
    println!("cargo:rerun-if-changed=src/abi/linuxcnc.h");
    println!("cargo:rerun-if-changed=src/abi/layout.c");
    let include = headers("tp.h");
    let structures = types(&include)
        .allowlist_type("TP_STRUCT")
        .allowlist_type("EmcPose")
        .allowlist_type("PmCartesian")
        .allowlist_type("state_tag_t")
        .allowlist_type("emcmot_(status|config|error|internal)_t")
        .allowlist_type(
            "(tp_err|cmd_code_t|tc_term_cond|tc_direction|KINEMATICS_TYPE|StateField|StateFlag).*",
        )
        .allowlist_var("EMCMOT_(MAX|TERM_COND|MOTION)_.*")
        .allowlist_var("(SS|FS|AF|FH)_ENABLED")
        .allowlist_var("DEFAULT_TC_QUEUE_SIZE")
        .allowlist_function("tp[A-Z].*|tcqFull|kinematics[A-Z].*");
    write(structures, "linuxcnc.rs");
    write(
        types(&include).allowlist_type("state_tag_t"),
        "state_tag.rs",
    );
    compile_layout(&include);
}

/// Rust types for what motmod shares with its modules, so far of nothing.
fn types(include: &[String]) -> bindgen::Builder {
    let folders = include.iter().map(|folder| format!("-I{folder}"));
    let defines = DEFINES.iter().map(|define| format!("-D{define}"));
    bindgen::Builder::default()
        .header("src/abi/linuxcnc.h")
        .clang_args(folders.chain(defines))
        .default_enum_style(bindgen::EnumVariation::ModuleConsts)
        .derive_default(false)
        .derive_debug(false)
        .layout_tests(false)
        .merge_extern_blocks(true)
        .wrap_unsafe_ops(true)
        .rust_target(bindgen::RustTarget::stable(90, 0).unwrap_or_default())
}

/// Writes these types into a file of cargo's output folder.
fn write(types: bindgen::Builder, file: &str) {
    let bindings = match types.generate() {
        Ok(bindings) => bindings,
        Err(error) => {
            eprintln!(
                "error: bindgen cannot read LinuxCNC's headers: {error}\n\
                 help: apt-get install libclang-dev linuxcnc-uspace-dev"
            );
            exit(1);
        }
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    bindings
        .write_to_file(out.join(file))
        .expect("OUT_DIR is writable");
}

/// The same structures as the C compiler lays them out.
fn compile_layout(include: &[String]) {
    let mut build = cc::Build::new();
    build
        .file("src/abi/layout.c")
        .includes(include)
        .warnings(false);
    for define in DEFINES {
        build.define(define, None);
    }
    build.compile("framepath_layout");
}
