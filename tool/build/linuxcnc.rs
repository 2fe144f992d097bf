//! Compiles what `framepath plan` and `framepath compare` start in processes of their own and keep in the executable:
//! the program that runs LinuxCNC's interpreter (C++, src/canon/interpreter), and what stands where
//! HAL stands for a planner module (C, src/loaded/stubs.c).

use std::env;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio, exit};

include!("../../build/headers.rs");

/// Where Debian's linuxcnc-uspace has its modules.
const INSTALLED_MODULES: &str = "/usr/lib/linuxcnc/modules";

/// Asks the C compiler what LinuxCNC's headers have, as for the modules.
const LINUXCNC_HAS: &str = "../hal-component/linuxcnc-has";

/// What C++ compiles since 2.10, whose canonical calls differ from those before.
const SCOPED_PLANES: &str = "#include \"canon.hh\"\nCANON_PLANE plane = CANON_PLANE::XY;\n";

/// And with what its interpreter asks for pins of HAL there.
const HAL_QUERIES: &str = "#define ULAPI\n#include <hal.h>\nhal_query_t query;\n";

pub fn build() {
    println!("cargo:rerun-if-changed=src/canon/interpreter");
    println!("cargo:rerun-if-changed=src/loaded/stubs.c");
    println!("cargo:rerun-if-changed={LINUXCNC_HAS}");
    println!("cargo:rustc-check-cfg=cfg(linuxcnc_move_jerk)");
    let include = headers("interp_base.hh");
    if has_move_jerk(&include) {
        println!("cargo:rustc-cfg=linuxcnc_move_jerk");
    }
    let modules = in_place().map(|folder| folder.join("rtlib"));
    let modules = modules.unwrap_or_else(|| INSTALLED_MODULES.into());
    println!("cargo:rustc-env=LINUXCNC_MODULES={}", modules.display());
    println!("cargo:rustc-env=FRAMEPATH_BUILT_FOR={}", version(&include));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    compile_interpreter(&include, &out.join("interpreter"));
    compile_stubs(&include, &out.join("stubs.so"));
}

/// The folder of a LinuxCNC that is run in place, `None` for the installed one.
fn in_place() -> Option<PathBuf> {
    println!("cargo:rerun-if-env-changed=LINUXCNC_IN_PLACE");
    env::var_os("LINUXCNC_IN_PLACE").map(PathBuf::from)
}

/// The version of the LinuxCNC whose headers these are, as hal-component/Makefile finds it: no header has it, the script
/// beside them does. Empty where there is none.
fn version(include: &[String]) -> String {
    println!("cargo:rerun-if-env-changed=LINUXCNC_VERSION");
    if let Ok(version) = env::var("LINUXCNC_VERSION") {
        return version.trim().to_owned();
    }
    let scripts = include.iter().flat_map(|folder| {
        ["../../bin/linuxcnc", "../scripts/linuxcnc"].map(|script| Path::new(folder).join(script))
    });
    let text = scripts
        .filter_map(|script| fs::read(script).ok())
        .map(|text| String::from_utf8_lossy(&text).into_owned())
        .next()
        .unwrap_or_default();
    let version = text
        .lines()
        .find_map(|line| line.strip_prefix("LINUXCNCVERSION=\"")?.split('"').next());
    version.unwrap_or_default().to_owned()
}

/// Whether LinuxCNC gives a limit of jerk with each move.
fn has_move_jerk(include: &[String]) -> bool {
    let answer = Command::new(LINUXCNC_HAS)
        .arg(cc::Build::new().get_compiler().path())
        .args(["-DRTAPI", "-DUSPACE"])
        .args(include.iter().flat_map(|folder| ["-isystem", folder]))
        .output();
    answer.is_ok_and(|answer| String::from_utf8_lossy(&answer.stdout).contains("HAS_MOVE_JERK"))
}

/// Whether a text compiles as C++.
fn compiles(compiler: &cc::Tool, include: &[String], text: &str) -> bool {
    let mut child = match compiler
        .to_command()
        .args(["-std=c++17", "-w", "-fsyntax-only"])
        .args(include.iter().flat_map(|folder| ["-isystem", folder]))
        .args(["-x", "c++", "-"])
        .stdin(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
    {
        Ok(child) => child,
        // what is compiled in earnest says why
        Err(_) => return false,
    };
    let written = child
        .stdin
        .take()
        .map(|mut input| input.write_all(text.as_bytes()));
    written.is_some_and(|written| written.is_ok())
        && child.wait().is_ok_and(|status| status.success())
}

/// An executable, linked with LinuxCNC's interpreter.
fn compile_interpreter(include: &[String], output: &Path) {
    let folder = Path::new("src/canon/interpreter");
    let cpp = cc::Build::new().cpp(true).opt_level(2).get_compiler();
    let mut compiler = cpp.to_command();
    for (text, has) in [
        (SCOPED_PLANES, "-DLINUXCNC_HAS_SCOPED_PLANES"),
        (HAL_QUERIES, "-DLINUXCNC_HAS_HAL_QUERIES"),
    ] {
        if compiles(&cpp, include, text) {
            compiler.arg(has);
        }
    }
    if let Some(folder) = in_place() {
        let libraries = folder.join("lib").display().to_string();
        compiler.args([format!("-L{libraries}"), format!("-Wl,-rpath,{libraries}")]);
    }
    compiler
        .arg("-std=c++17")
        .arg("-I")
        .arg(folder)
        .args(include.iter().flat_map(|folder| ["-isystem", folder]))
        .args([
            folder.join("main.cc"),
            folder.join("calls.cc"),
            folder.join("answers.cc"),
            folder.join("hal_pins.cc"),
            folder.join("inputs.cc"),
            folder.join("python.cc"),
            folder.join("settings.cc"),
        ])
        .args(["-rdynamic", "-lrs274", "-lpyplugin", "-ldl"])
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
        .arg("src/loaded/stubs.c")
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
