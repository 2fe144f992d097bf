//! Compiles what `framepath plan` and `framepath compare` start in processes of their own and keep in the executable:
//! the program that runs LinuxCNC's interpreter (C++, src/canon/interpreter), and what stands where
//! HAL stands for a planner module (C, src/host/stubs.c).

use std::env;
use std::path::{Path, PathBuf};
use std::process::exit;

include!("../../build/headers.rs");

pub fn build() {
    println!("cargo:rerun-if-changed=src/canon/interpreter");
    println!("cargo:rerun-if-changed=src/host/stubs.c");
    let include = headers("interp_base.hh");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    compile_interpreter(&include, &out.join("interpreter"));
    compile_stubs(&include, &out.join("stubs.so"));
}

/// An executable, linked with LinuxCNC's interpreter.
fn compile_interpreter(include: &[String], output: &Path) {
    let folder = Path::new("src/canon/interpreter");
    let mut compiler = cc::Build::new()
        .cpp(true)
        .opt_level(2)
        .get_compiler()
        .to_command();
    compiler
        .arg("-std=c++17")
        .arg("-I")
        .arg(folder)
        .args(include.iter().flat_map(|folder| ["-isystem", folder]))
        .args([
            folder.join("main.cc"),
            folder.join("calls.cc"),
            folder.join("answers.cc"),
            folder.join("settings.cc"),
        ])
        .args(["-rdynamic", "-lrs274", "-lpyplugin"])
        // What librs274 needs itself is found when it is loaded.
        .arg("-Wl,--allow-shlib-undefined")
        .arg("-o")
        .arg(output);
    finish(
        compiler,
        "C++ compiler: apt-get install g++ linuxcnc-uspace linuxcnc-uspace-dev",
    );
}

/// A shared object that is loaded before all others.
fn compile_stubs(include: &[String], output: &Path) {
    let mut compiler = cc::Build::new().opt_level(2).get_compiler().to_command();
    compiler
        .args(["-shared", "-fPIC", "-DRTAPI", "-DUSPACE"])
        .args(include.iter().flat_map(|folder| ["-isystem", folder]))
        .arg("src/host/stubs.c")
        .arg("-o")
        .arg(output);
    finish(
        compiler,
        "C compiler: apt-get install gcc linuxcnc-uspace-dev",
    );
}

fn finish(mut compiler: std::process::Command, needed: &str) {
    match compiler.status() {
        Ok(status) if status.success() => {}
        Ok(status) => {
            eprintln!(
                "error: {compiler:?} ended with {status}\nhelp: this needs LinuxCNC and a {needed}"
            );
            exit(1);
        }
        Err(error) => {
            eprintln!("error: {compiler:?} cannot be run: {error}\nhelp: this needs a {needed}");
            exit(1);
        }
    }
}
