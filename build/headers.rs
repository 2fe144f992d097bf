// A part of both build scripts.

/// Where Debian's linuxcnc-uspace-dev puts the headers.
const DEFAULT_INCLUDE: &str = "/usr/include/linuxcnc";

/// The folder of LinuxCNC's headers, in which this one has to be. Without it the build ends.
fn headers(needed: &str) -> String {
    println!("cargo:rerun-if-env-changed=LINUXCNC_INCLUDE");
    let include = env::var("LINUXCNC_INCLUDE").unwrap_or_else(|_| DEFAULT_INCLUDE.to_owned());
    if !Path::new(&include).join(needed).exists() {
        eprintln!(
            "error: LinuxCNC's header {needed} is not in {include}\n\
             help: apt-get install linuxcnc-uspace-dev, or name the folder in LINUXCNC_INCLUDE"
        );
        exit(1);
    }
    watch(&include);
    include
}

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
