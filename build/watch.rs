// A part of both build scripts.

/// Has this run again for another LinuxCNC: its headers are newer, or `make modules` has noticed that they differ (those
/// of another release may be older than what was built with the last one's).
fn watch(include: &str) {
    println!("cargo:rerun-if-changed={include}");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    // OUT_DIR is target/PROFILE/build/PACKAGE/out
    let noticed = out
        .ancestors()
        .nth(4)
        .map(|target| target.join("modules/built-for"));
    if let Some(noticed) = noticed.filter(|file| file.exists()) {
        println!("cargo:rerun-if-changed={}", noticed.display());
    }
}
